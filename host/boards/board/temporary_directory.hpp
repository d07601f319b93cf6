#pragma once
#include "host/boards/board/board_error.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::board {

/// A new directory, removed with its contents. Throws BoardError, because a board's link needs one.
class TemporaryDirectory : public files::TemporaryDirectory {
 public:
  TemporaryDirectory() try : files
    ::TemporaryDirectory() {}
  catch (const files::FileError& error) {
    throw BoardError(error.what());
  }
};

}  // namespace verp::board
