#pragma once
#include <stdexcept>

namespace verp::live {

/// The stream cannot be offered. what() is one line: the port, the problem, the remedy.
class LiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace verp::live
