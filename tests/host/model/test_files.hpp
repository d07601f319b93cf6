#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"

namespace verp::model {

inline std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(::testing::TempDir() + "/" +
              ::testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() + "_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name) {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string robot_file(const std::string& name) {
  return std::string(VERP_SOURCE_DIR) + "/common/robots/" + name + "/robot.sdf";
}

/// ctest ends an endless load.
inline LoadError refusal_of(const std::string& path) {
  try {
    load_robot(path);
  } catch (const LoadError& error) {
    EXPECT_FALSE(error.fix.empty());
    return error;
  }
  ADD_FAILURE() << "was accepted";
  return {path, 0, "", ""};
}

inline std::string without_element(std::string text, const std::string& start) {
  const auto at = text.find(start);
  EXPECT_NE(at, std::string::npos) << start;
  return at == std::string::npos ? text : text.erase(at, text.find("/>", at) + 2 - at);
}

inline void expect_same_robot(const Entity& one, const Entity& other) {
  ASSERT_EQ(one.nodes.size(), other.nodes.size());
  for (std::size_t n = 0; n < other.nodes.size(); ++n) {
    const Node &a = one.nodes[n], &b = other.nodes[n];
    EXPECT_NEAR(a.mass_kg, b.mass_kg, 1e-5) << b.name;
    EXPECT_LT((a.com_m - b.com_m).norm(), 1e-5) << b.name;
    EXPECT_LT((a.inertia_kg_m2 - b.inertia_kg_m2).norm(), 1e-4 * b.inertia_kg_m2.norm()) << b.name;
  }
  ASSERT_EQ(one.joints.size(), other.joints.size());
  for (std::size_t j = 0; j < other.joints.size(); ++j) {
    const Joint &a = one.joints[j], &b = other.joints[j];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.parent, b.parent) << b.name;
    EXPECT_EQ(a.servo.id, b.servo.id) << b.name;
    EXPECT_EQ(a.servo.p_gain, b.servo.p_gain) << b.name;
    EXPECT_LT((a.origin_m - b.origin_m).norm(), 2e-6) << b.name;
    EXPECT_LT((a.axis - b.axis).norm(), 1e-5) << b.name;
    EXPECT_NEAR(a.lower_rad, b.lower_rad, 1e-4) << b.name;
    EXPECT_NEAR(a.upper_rad, b.upper_rad, 1e-4) << b.name;
    EXPECT_NEAR(a.stand_rad, b.stand_rad, 1e-9) << b.name;
  }
}

}  // namespace verp::model
