#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/ros_messages.hpp"

/// Camera data as ROS 2 messages in CDR. The camera frame has z along the view, x right and y down
/// in the picture.
namespace verp::record::ros {

extern const MessageType kCompressedImage;  ///< sensor_msgs/msg/CompressedImage
extern const MessageType kImage;            ///< sensor_msgs/msg/Image
extern const MessageType kCameraInfo;       ///< sensor_msgs/msg/CameraInfo
extern const MessageType kLabelInfo;        ///< vision_msgs/msg/LabelInfo

struct Picture {
  /// "png" or "jpeg": `data` is such a file. Otherwise pixels in rows from the top, as in
  /// sensor_msgs/Image: "rgb8", "16UC1" (depth, 1 mm per step, 0: nothing) or "mono16" (labels).
  std::string encoding;
  std::uint32_t width = 0, height = 0;
  std::string data;
};
/// CompressedImage for "png" and "jpeg", else Image.
std::string picture(const Picture& picture, std::string_view frame, std::uint64_t time_ns);
/// Decodes a message of type kCompressedImage or kImage; size 0: only the compressed file knows it.
/// nullopt: not such a message.
std::optional<Picture> read_compressed(std::string_view message);
std::optional<Picture> read_image(std::string_view message);

struct CameraInfo {
  std::uint32_t width = 0, height = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  std::array<double, 5> distortion{};  ///< "plumb_bob": k1, k2, p1, p2, k3
};
/// Names of a label picture's numbers: names[0] is 1. Numbers without a name are omitted.
std::string label_info(const std::vector<std::string>& names, std::string_view frame,
                       std::uint64_t time_ns);
std::string camera_info(const CameraInfo& info, std::string_view frame, std::uint64_t time_ns);

}  // namespace verp::record::ros
