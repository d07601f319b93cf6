#include <gtest/gtest.h>

#include "host/trace/record/ros_camera.hpp"

namespace verp::record {
namespace {

TEST(LabelInfo, HasTheNameOfEachNumberThatHasOne) {
  using namespace std::string_literals;
  const std::string bytes = ros::label_info({"a", "", "r1/foot"}, "eye", 3'000'000'007);
  const std::string wanted = "\0\1\0\0"s +                // little-endian
                             "\3\0\0\0\7\0\0\0"s +        // stamp
                             "\4\0\0\0eye\0"s +           // frame
                             "\2\0\0\0"s +                // two classes
                             "\1\0\0\0\2\0\0\0a\0"s +     // 1: a
                             "\3\0\x8\0\0\0r1/foot\0"s +  // no padding before its name's length
                             "\0\0\x80\x3f"s;             // certain
  EXPECT_EQ(bytes, wanted);
  EXPECT_EQ(ros::kLabelInfo.name, "vision_msgs/msg/LabelInfo");
}

}  // namespace
}  // namespace verp::record
