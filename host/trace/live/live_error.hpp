#pragma once
#include <stdexcept>

namespace verp::live {

/// A stream that cannot be offered: one line with the port, what is wrong, and how to fix it.
class LiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace verp::live
