#pragma once
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "host/author/action/document.hpp"

namespace verp::action {

/// Words that begin a line; a joint of such a name is written with `joint` before it.
inline constexpr const char* kLineWords[] = {
    "action",     "note",    "robotis", "mirror", "link", "frame", "smooth",
    "cubic",      "balance", "stance",  "over",   "body", "joint", "left_foot",
    "right_foot", "stiff",   "exit",    "repeat", "wait"};

class Words {
 public:
  Words(const std::filesystem::path& file, int line, const std::string& text)
      : file_(file.string()), line_(line) {
    std::string word;
    for (const char c : text + " ") {
      if (c == '#') break;
      if (c != ' ' && c != '\t' && c != '\r') {
        word += c;
      } else if (!word.empty()) {
        words_.push_back(std::exchange(word, {}));
      }
    }
    if (!word.empty()) words_.push_back(word);
  }

  bool done() const { return next_ == words_.size(); }
  int line() const { return line_; }
  const std::string& peek() const {
    static const std::string kNothing;
    return done() ? kNothing : words_[next_];
  }
  bool take(const char* word) {
    if (peek() != word) return false;
    ++next_;
    return true;
  }
  std::string word(const char* what) {
    if (done()) fail("something is missing at the end of the line", std::string("give ") + what);
    return words_[next_++];
  }
  double number(const char* what, double low, double high) {
    const std::string text = word(what);
    const std::optional<double> value = number_in(text);
    if (!value) fail("'" + text + "' is no number", std::string("give ") + what);
    if (*value < low || *value > high) {
      fail(std::string(what) + " " + text + " is out of range",
           "give " + brief(low) + " to " + brief(high));
    }
    return *value;
  }
  void end() {
    if (!done()) fail("'" + peek() + "' is too much", "leave it out");
  }
  [[noreturn]] void fail(const std::string& what, const std::string& fix) const {
    throw model::LoadError(file_, line_, what, fix);
  }

  static std::optional<double> number_in(const std::string& text) {
    double value = 0;
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
    return value;
  }

 private:
  static std::string brief(double value) {
    std::string text = std::to_string(value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
  }

  std::string file_;
  int line_;
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

}  // namespace verp::action
