#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

std::string with_line(const std::string& text, int line, bool twice) {
  std::istringstream in(text);
  std::string out, each;
  for (int number = 1; std::getline(in, each); ++number) {
    const int times = number != line ? 1 : twice ? 2 : 0;
    for (int i = 0; i < times; ++i) out += each + '\n';
  }
  return out;
}

// tinyxml2 names the element's first line.
TEST(MalformedXml, ATagLeftOutOrGivenTwiceIsToldWhereItIs) {
  const std::string folder = VERP_SOURCE_DIR "/tests/host/model/odd_robot/";
  int faults = 0;
  for (const std::string& text :
       {read_text(folder + "odd.urdf"), read_text(robot_file("generic21"))}) {
    std::istringstream in(text);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      const auto at = line.find_first_not_of(' ');
      const std::string tag = at == line.npos ? "" : line.substr(at);
      const bool opens = tag.starts_with("<link name") || tag.starts_with("<joint name");
      const bool whole = tag.find("</") != tag.npos || tag.find("/>") != tag.npos;
      const bool closes = tag == "</link>" || tag == "</joint>";
      if (!closes && (!opens || whole)) continue;
      for (const bool twice : {false, true}) {
        if (opens && twice) continue;
        const TemporaryFile robot("robot.sdf", with_line(text, number, twice));
        const LoadError error = refusal_of(robot.path());
        EXPECT_NEAR(error.line, number, 5)
            << tag << (twice ? " twice: " : " left out: ") << error.what();
        EXPECT_NE(std::string(error.what()).find("malformed XML"), std::string::npos);
        ++faults;
      }
    }
  }
  EXPECT_GT(faults, 150);
}

TEST(MalformedXml, WhatIsMalformedIsToldInWords) {
  const auto said = [](const std::string& text) {
    const TemporaryFile robot("robot.sdf", text);
    return std::string(refusal_of(robot.path()).what());
  };
  EXPECT_NE(said("<sdf version=\"1.9\">\n<model name=\"a>\n</model>\n</sdf>\n")
                .find(":2: malformed XML (the tag <model> has a quote that is not closed)"),
            std::string::npos);
  EXPECT_NE(said("<sdf version=\"1.9\">\n<!-- a > b\n<model name=\"a\"/>\n</sdf>\n")
                .find(":2: malformed XML (what begins here does not end)"),
            std::string::npos);
  EXPECT_NE(said("<sdf version=\"1.9\">\n<model name=\"a\">\n")
                .find(":3: malformed XML (the file ends, and <model> of line 2 is open)"),
            std::string::npos);
  EXPECT_NE(said("<sdf version=\"1.9\">\n<m\x1B\xFF\n<b/>\n")
                .find("(the tag <m?"
                      "?> is not"),
            std::string::npos)
      << "no terminal is shown what is in no tag";
  EXPECT_NE(said("<sdf version=\"1.9\">\n<model name='<'><a b=\"1\" b=\"2\"/></sdf>\n").find(":2:"),
            std::string::npos);
}

}  // namespace
}  // namespace verp::model
