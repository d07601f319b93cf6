#pragma once
#include <stdexcept>
#include <string>

namespace verp::board {

/// A board or its link: exit status 3. what() is one line with a remedy.
class BoardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No such emulated board or image; no device is at fault: exit status 2.
class NoSuchBoard : public BoardError {
 public:
  using BoardError::BoardError;
};

}  // namespace verp::board
