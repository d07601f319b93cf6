#pragma once
#include "host/boards/board/board_error.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::board {

/// A new directory of our own, removed with all it holds. Throws BoardError when it can't be made:
/// without one there is no link to a board.
class TemporaryDirectory : public files::TemporaryDirectory {
 public:
  TemporaryDirectory() try : files
    ::TemporaryDirectory() {}
  catch (const files::FileError& error) {
    throw BoardError(error.what());
  }
};

}  // namespace verp::board
