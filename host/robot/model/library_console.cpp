#include "host/robot/model/library_console.hpp"

#include <cstdlib>
#include <optional>
#include <sdf/Console.hh>
#include <string>

namespace verp::model {
namespace {

/// libsdformat creates ~/.sdformat/sdformat.log and complains if it cannot; without HOME it does
/// not try.
void start_without_a_log() {
  std::optional<std::string> home;
  if (const char* value = std::getenv("HOME")) home = value;
  ::unsetenv("HOME");
  sdf::Console::Instance()->SetQuiet(true);  // its messages return as errors, or name no line
  if (home) ::setenv("HOME", home->c_str(), 1);
}

}  // namespace

LibraryConsole::LibraryConsole() : before_(std::cerr.rdbuf(caught_.rdbuf())) {
  start_without_a_log();
}

LibraryConsole::~LibraryConsole() {
  std::cerr.rdbuf(before_);
}

}  // namespace verp::model
