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

}  // namespace verp::board
