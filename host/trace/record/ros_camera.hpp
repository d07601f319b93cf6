#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/ros_messages.hpp"

/// ROS 2 messages in CDR. Camera frame: z along the view, x right, y down.
namespace verp::record::ros {

extern const MessageType kCompressedImage;  ///< sensor_msgs/msg/CompressedImage
extern const MessageType kImage;            ///< sensor_msgs/msg/Image
extern const MessageType kCameraInfo;       ///< sensor_msgs/msg/CameraInfo
extern const MessageType kLabelInfo;        ///< vision_msgs/msg/LabelInfo

struct Picture {
  /// "png" or "jpeg": `data` is such a file. Else rows from the top, as sensor_msgs/Image: "rgb8",
  /// "16UC1" (depth, 1 mm per step, 0: nothing) or "mono16" (labels).
  std::string encoding;
  std::uint32_t width = 0, height = 0;
  std::string data;
};
/// CompressedImage for "png" and "jpeg", else Image.
std::string picture(const Picture& picture, std::string_view frame, std::uint64_t time_ns);
/// kCompressedImage or kImage; size 0: only the file knows. nullopt: another message.
std::optional<Picture> read_compressed(std::string_view message);
std::optional<Picture> read_image(std::string_view message);

struct CameraInfo {
  std::uint32_t width = 0, height = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  std::array<double, 5> distortion{};  ///< "plumb_bob": k1, k2, p1, p2, k3
};
/// names[0] is 1; numbers without a name are omitted.
std::string label_info(const std::vector<std::string>& names, std::string_view frame,
                       std::uint64_t time_ns);
std::string camera_info(const CameraInfo& info, std::string_view frame, std::uint64_t time_ns);

}  // namespace verp::record::ros
