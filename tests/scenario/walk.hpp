#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace verp::scenario {

using nlohmann::json;

struct Walk {
  int status = -1;  ///< -1: killed
  json result;      ///< empty without JSON
};

/// As in seeds.txt.
inline constexpr unsigned long kLastGateSeed = 100;

inline Walk walk(const std::string& arguments) {
  const std::size_t seed = arguments.find("--seed ");
  if (seed != std::string::npos) {
    EXPECT_LE(std::stoul(arguments.substr(seed + 7)), kLastGateSeed) << "seeds.txt";
  }
  const std::string command = std::string(VERP_PROGRAM) + " walk " + arguments + " --json 2>&1";
  Walk walk;
  std::string text;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return walk;
  char buffer[4096];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, pipe)) {
    text.append(buffer, size);
  }
  const int status = ::pclose(pipe);
  walk.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const std::size_t from = text.find('{'), to = text.rfind('}');
  if (from != std::string::npos && to != std::string::npos) {
    walk.result = json::parse(text.substr(from, to - from + 1), nullptr, false);
  }
  if (!walk.result.is_object()) {
    ADD_FAILURE() << "verp walk " << arguments << " gave no JSON:\n" << text;
    walk.result = json::object();
  }
  return walk;
}

inline double number(const Walk& walk, const char* name) {
  return walk.result.value(name, std::numeric_limits<double>::quiet_NaN());
}

inline void expect_walked(const Walk& walk) {
  EXPECT_EQ(walk.status, 0) << walk.result.dump();
  EXPECT_EQ(walk.result.value("fallen", true), false) << walk.result.value("failure", "");
}

/// A result that is too good means that the test has lost its grip.
inline void expect_between(double low, double value, double high, const char* what) {
  EXPECT_GE(value, low) << what;
  EXPECT_LE(value, high) << what;
}

}  // namespace verp::scenario
