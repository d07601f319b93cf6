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

/// A file that the destructor removes.
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

/// The error of loading `path`. ctest ends a load that never ends.
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

/// True if the third-party models are found; the repository lacks them.
inline bool has_third_party(const std::string& uri) {
  return !resolve_model_uri(uri, ".").empty();
}

#define VERP_NEEDS_THIRD_PARTY(uri)                                                 \
  if (!has_third_party(uri)) {                                                      \
    FAIL() << uri << " is not in " << model_path_text() << ": set VERP_MODEL_PATH"; \
  }

}  // namespace verp::model
