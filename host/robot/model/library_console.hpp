#pragma once
#include <iostream>
#include <sstream>
#include <streambuf>

namespace verp::model {

/// Discards what libraries print to std::cerr while it lives, so that users get only our one line.
class LibraryConsole {
 public:
  LibraryConsole();
  ~LibraryConsole();
  LibraryConsole(const LibraryConsole&) = delete;
  LibraryConsole& operator=(const LibraryConsole&) = delete;

 private:
  std::ostringstream caught_;
  std::streambuf* before_;
};

}  // namespace verp::model
