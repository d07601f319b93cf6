#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"

namespace verp::tool {

/// Results of the checks, a line each: the thing, its state, and the fix, mostly a command to copy.
class Findings {
 public:
  void good(const std::string& check, const std::string& text) { add("good", check, text, ""); }
  /// Only some commands need it.
  void advise(const std::string& check, const std::string& text, const std::string& fix) {
    add("advice", check, text, fix);
  }
  void bad(const std::string& check, const std::string& text, const std::string& fix) {
    add("bad", check, text, fix);
  }
  /// From one line, "what; fix".
  void advise(const std::string& check, const std::string& line) { split("advice", check, line); }
  void bad(const std::string& check, const std::string& line) { split("bad", check, line); }

  std::size_t size() const { return all_.size(); }
  bool any_bad() const;
  std::string text() const;
  cli::Json json() const;

 private:
  struct Finding {
    std::string state, check, text, fix;
  };
  void add(const char* state, const std::string& check, const std::string& text,
           const std::string& fix) {
    all_.push_back({state, check, text, fix});
  }
  void split(const char* state, const std::string& check, const std::string& line);
  std::vector<Finding> all_;
};

}  // namespace verp::tool
