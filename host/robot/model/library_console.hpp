#pragma once
#include <iostream>
#include <sstream>
#include <streambuf>

namespace verp::model {

/// While it lives, what libraries print to std::cerr goes nowhere: users get one line, ours.
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
