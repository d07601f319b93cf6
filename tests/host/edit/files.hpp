#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "host/author/edit/change.hpp"
#include "host/author/edit/parts.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::edit {

inline std::string read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string robot(const std::string& name) {
  return std::string(VERP_SOURCE_DIR "/common/robots/") + name + "/robot.sdf";
}

inline std::pair<int, int> changed_lines(const std::string& from, const std::string& to) {
  const std::string rows = difference(from, to, "f");
  int less = 0, more = 0;
  for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1) {
    less += rows[at] == '-' && rows.compare(at, 3, "---") != 0;
    more += rows[at] == '+' && rows.compare(at, 3, "+++") != 0;
  }
  return {less, more};
}

constexpr std::pair<int, int> kOneLine = {1, 1};

inline void expect_a_mass_changes_one_line(const std::string& file) {
  Document document = Document::open(file);
  const std::string before = document.text();
  int link = -1;
  for (const int each : document.markup()[document.model()].children) {
    if (document.markup()[each].name == "link" && document.child(each, "inertial") >= 0)
      link = each;
  }
  document.apply(set(document, document.path(link) + "/inertial/mass@value", "0.125"));
  EXPECT_EQ(changed_lines(before, document.text()), kOneLine) << file;
}

}  // namespace verp::edit
