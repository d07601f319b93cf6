#pragma once
#include <stdexcept>

namespace verp::live {

/// what() is one line: port, problem, remedy.
class LiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace verp::live
