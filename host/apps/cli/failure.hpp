#pragma once
#include <string>

namespace verp::cli {

/// An exception as the user meets it.
struct Failure {
  int status;  ///< ExitStatus
  std::string line;
};

/// Of the exception that is being handled: call it in a catch block only.
Failure current_failure();

}  // namespace verp::cli
