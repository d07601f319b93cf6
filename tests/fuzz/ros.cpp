// Messages of viewers' channels and of the drawing program, as traces and pipes bring them.
#include "host/os/link/rgb.hpp"
#include "host/show/camera/wire.hpp"
#include "host/trace/record/ros_camera.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  const std::uint8_t kind = bytes.byte();
  const std::string_view message = bytes.rest();
  if (kind % 11 == 0) record::ros::read_compressed(message);
  if (kind % 11 == 1) record::ros::read_image(message);
  if (kind % 11 == 2) record::ros::read_objects(message);
  if (kind % 11 == 3) record::ros::read_string(message);
  if (kind % 11 == 4) record::ros::body_pose(message);
  if (kind % 11 == 5) record::ros::read_radio(message);
  if (kind % 11 == 6) camera::unpack_stage(message);
  if (kind % 11 == 7) camera::unpack_moment(message);
  if (kind % 11 == 8) camera::unpack_outside(message);
  if (kind % 11 == 9) camera::unpack_picture(message);
  if (kind % 11 == 10 && message.size() > 4) {
    hal::CameraFrame frame;
    frame.width_px = static_cast<std::uint8_t>(message[0]);
    frame.height_px = static_cast<std::uint8_t>(message[1]);
    frame.stride_bytes = 4U * static_cast<std::uint8_t>(message[2]);
    frame.format = static_cast<hal::PixelFormat>(message[3] & 7);
    const std::string picture(message.substr(4));  // its own memory, whose end is watched
    frame.data = reinterpret_cast<const std::uint8_t*>(picture.data());
    frame.size_bytes = picture.size();
    link::rgb_of(frame);
  }
  return 0;
}
