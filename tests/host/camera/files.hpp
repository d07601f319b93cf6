#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host/robot/model/find.hpp"

namespace verp::camera::test {

class Files {
 public:
  Files() {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("verp-camera-") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Files() { std::filesystem::remove_all(folder_); }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// With this `type` and `inner` in <camera>.
  std::string robot(const std::string& type, const std::string& inner) const {
    std::ifstream in(model::find_model("generic21"));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto swap = [&](const std::string& was, const std::string& is) {
      const auto at = text.find(was);
      ASSERT_NE(at, std::string::npos) << was;
      text.replace(at, was.size(), is);
    };
    swap("name=\"camera\" type=\"camera\"", "name=\"camera\" type=\"" + type + "\"");
    swap("<far>20</far></clip>", "<far>20</far></clip>" + inner);
    return write("robot.sdf", text);
  }

  /// The ball of 0.05 m is at `x y z`.
  std::string world(const std::string& ball) const {
    return write("world.sdf", R"(<?xml version="1.0"?>
<sdf version="1.9" xmlns:verp="https://verp.dev/sdf/1"><world name="balls">
  <light name="sun" type="directional"><diffuse>0.9 0.9 0.9 1</diffuse><direction>0.3 0.2 -1</direction></light>
  <model name="ground"><static>true</static><link name="link">
    <collision name="floor"><geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry></collision>
    <visual name="look"><geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry></visual></link></model>
  <model name="ball"><static>true</static><pose>)" +
                                  ball + R"( 0 0 0</pose><link name="link">
    <collision name="shape"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
    <visual name="look"><geometry><sphere><radius>0.05</radius></sphere></geometry><material>
      <ambient>0.9 0 0 1</ambient><diffuse>0.9 0 0 1</diffuse><emissive>0.5 0 0 1</emissive></material></visual></link></model>
</world></sdf>
)");
  }

 private:
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file) << text;
    return file.string();
  }

  std::filesystem::path folder_;
};

}  // namespace verp::camera::test
