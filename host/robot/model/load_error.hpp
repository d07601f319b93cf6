#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace verp::model {

/// A user's file, with place and remedy. what() is one line: `FILE:LINE: MESSAGE; FIX`, or without
/// `:LINE`.
class LoadError : public std::runtime_error {
 public:
  LoadError(std::string file_name, int line_number, std::string what_is_wrong, std::string remedy)
      : std::runtime_error(one_line(file_name +
                                    (line_number > 0 ? ":" + std::to_string(line_number) : "") +
                                    ": " + shortened(what_is_wrong) + "; " + remedy)),
        file(std::move(file_name)),
        line(line_number),
        message(std::move(what_is_wrong)),
        fix(std::move(remedy)) {}

  std::string file;
  int line;  ///< from 1; 1 also for the whole content; 0: no content
  std::string message;
  std::string fix;

 private:
  // The message quotes the file: remove control bytes that a terminal would obey.
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (c == '\n' || c == '\r' || c == '\t') c = ' ';
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
    }
    return text;
  }
  static std::string shortened(std::string text) {
    constexpr std::size_t kMost = 400;
    if (text.size() > kMost) text = text.substr(0, kMost) + "...";
    return text;
  }
};

}  // namespace verp::model
