#pragma once
#include <string>

namespace verp::cli {

struct Failure {
  int status;  ///< ExitStatus
  std::string line;
};

/// The current exception; call it in a catch block only.
Failure current_failure();

}  // namespace verp::cli
