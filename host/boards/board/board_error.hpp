#pragma once
#include <stdexcept>
#include <string>

namespace verp::board {

/// Error of a real or emulated board or its link: exit status 3. what() is one line that ends with
/// a remedy.
class BoardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is no such emulated board, or no image for it. No device is at fault: exit status 2.
class NoSuchBoard : public BoardError {
 public:
  using BoardError::BoardError;
};

}  // namespace verp::board
