#pragma once
#include <stdexcept>
#include <string>

namespace verp::board {

/// Trouble with a board or its link, real or emulated: exit status 3. what() is one line that ends
/// with a remedy.
class BoardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No such emulated board, or no image for it: nothing is wrong with a device, and exit status 2.
class NoSuchBoard : public BoardError {
 public:
  using BoardError::BoardError;
};

}  // namespace verp::board
