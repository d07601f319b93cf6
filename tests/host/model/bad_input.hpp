#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/robot/model/load.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {

inline int line_of(const std::string& text, const std::string& part) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

inline std::string edited(const std::string& old_part, const std::string& new_part) {
  std::string text = read_text(robot_file("generic21"));
  const auto at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  if (at != std::string::npos) text.replace(at, old_part.size(), new_part);
  return text;
}

/// One line, at `line_part`'s line, with `message_part`.
inline void expect_refused(const std::string& text, const std::string& line_part,
                           const std::string& message_part) {
  const TemporaryFile file("robot.sdf", text);
  try {
    load_robot(file.path());
    FAIL() << "was accepted; should mention " << message_part;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file, file.path());
    EXPECT_EQ(error.line, line_of(text, line_part)) << error.what();
    EXPECT_NE(std::string(error.what()).find(message_part), std::string::npos) << error.what();
    EXPECT_FALSE(error.fix.empty());
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

}  // namespace verp::model
