#include "host/trace/record/ros_camera.hpp"

#include "host/trace/record/cdr.hpp"
#include "host/trace/record/ros_header.hpp"

namespace verp::record::ros {

const MessageType kCompressedImage = {"sensor_msgs/msg/CompressedImage", R"(std_msgs/Header header
string format
uint8[] data
)" VERP_ROS_HEADER};

const MessageType kImage = {"sensor_msgs/msg/Image", R"(std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
)" VERP_ROS_HEADER};

const MessageType kCameraInfo = {
    "sensor_msgs/msg/CameraInfo",
    R"(std_msgs/Header header
uint32 height
uint32 width
string distortion_model
float64[] d
float64[9] k
float64[9] r
float64[12] p
uint32 binning_x
uint32 binning_y
sensor_msgs/RegionOfInterest roi
)" VERP_ROS_HEADER
    R"(================================================================================
MSG: sensor_msgs/RegionOfInterest
uint32 x_offset
uint32 y_offset
uint32 height
uint32 width
bool do_rectify
)"};

const MessageType kLabelInfo = {
    "vision_msgs/msg/LabelInfo",
    R"(std_msgs/Header header
vision_msgs/VisionClass[] class_map
float32 threshold
)" VERP_ROS_HEADER
    R"(================================================================================
MSG: vision_msgs/VisionClass
uint16 class_id
string class_name
)"};

std::string picture(const Picture& picture, std::string_view frame, std::uint64_t time_ns) {
  Cdr out;
  out.header(time_ns, frame);
  if (picture.encoding == "png" || picture.encoding == "jpeg") {
    out.text(picture.encoding);
  } else {
    const std::uint32_t bytes_of_pixel = picture.encoding == "rgb8" ? 3 : 2;
    out.put(picture.height).put(picture.width).text(picture.encoding);
    out.put(std::uint8_t{0}).put(bytes_of_pixel * picture.width);
  }
  out.put(static_cast<std::uint32_t>(picture.data.size())).bytes(picture.data);
  return out.take();
}

namespace {

void skip_header(CdrReader& in) {
  in.get<std::int32_t>();
  in.get<std::uint32_t>();
  in.text();
}

void read_data(CdrReader& in, Picture& picture) {
  picture.data = in.bytes(in.get<std::uint32_t>());
}

}  // namespace

std::optional<Picture> read_compressed(std::string_view message) {
  CdrReader in(message);
  Picture picture;
  skip_header(in);
  picture.encoding = in.text();
  read_data(in, picture);
  return in.good ? std::optional(picture) : std::nullopt;
}

std::optional<Picture> read_image(std::string_view message) {
  CdrReader in(message);
  Picture picture;
  skip_header(in);
  picture.height = in.get<std::uint32_t>();
  picture.width = in.get<std::uint32_t>();
  picture.encoding = in.text();
  in.get<std::uint8_t>();
  const auto step = in.get<std::uint32_t>();
  read_data(in, picture);
  const bool whole = picture.data.size() == std::size_t{step} * picture.height;
  return in.good && whole ? std::optional(picture) : std::nullopt;
}

std::string camera_info(const CameraInfo& info, std::string_view frame, std::uint64_t time_ns) {
  const auto& i = info;
  Cdr out;
  out.header(time_ns, frame).put(i.height).put(i.width).text("plumb_bob");
  out.put(static_cast<std::uint32_t>(i.distortion.size())).doubles(i.distortion);
  out.doubles(std::array{i.fx_px, 0.0, i.cx_px, 0.0, i.fy_px, i.cy_px, 0.0, 0.0, 1.0});
  out.doubles(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  out.doubles(
      std::array{i.fx_px, 0.0, i.cx_px, 0.0, 0.0, i.fy_px, i.cy_px, 0.0, 0.0, 0.0, 1.0, 0.0});
  for (int unused = 0; unused < 6; ++unused) out.put(std::uint32_t{0});  // binning, region
  out.put(std::uint8_t{0});
  return out.take();
}

std::string label_info(const std::vector<std::string>& names, std::string_view frame,
                       std::uint64_t time_ns) {
  std::uint32_t named = 0;
  for (const std::string& name : names) named += name.empty() ? 0 : 1;
  Cdr out;
  out.header(time_ns, frame).put(named);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) out.put(static_cast<std::uint16_t>(i + 1)).text(names[i]);
  }
  out.put(1.0F);  // confidence: the twin knows what it shows
  return out.take();
}

}  // namespace verp::record::ros
