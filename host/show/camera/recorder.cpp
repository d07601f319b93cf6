#include "host/show/camera/recorder.hpp"

#include <cmath>

#include "host/trace/record/ros_camera.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::camera {
namespace {

namespace ros = record::ros;

/// SDF (x ahead, z up) to optical axes (z ahead, y down).
ros::BodyPose optical(const model::Transform& pose) {
  model::Mat3 turn;
  turn << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond q(pose.linear() * turn);
  const auto& p = pose.translation();
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

std::string frame_of(const model::CameraSensor& camera) {
  return camera.name + "_optical";
}

ros::CameraInfo info_of(const model::CameraSensor& camera) {
  return {.width = static_cast<std::uint32_t>(camera.width_px),
          .height = static_cast<std::uint32_t>(camera.height_px),
          .fx_px = camera.fx_px,
          .fy_px = camera.fy_px,
          .cx_px = camera.cx_px,
          .cy_px = camera.cy_px,
          .distortion = camera.distortion};
}

}  // namespace

Recorder::Recorder(Rig& rig, const model::Entity& entity, const Params& params,
                   record::TraceWriter& trace)
    : rig_(rig), entity_(entity), params_(params), trace_(trace) {
  guarded([this] { place_lenses(); });
}

void Recorder::place_lenses() {
  for (const model::CameraSensor& camera : entity_.cameras) {
    const std::vector<ros::ObjectPose> frame = {{frame_of(camera), optical(camera.pose)}};
    trace_.append("/tf_static", {"tf2_msgs/msg/TFMessage", ros::kTfSchema}, 0,
                  ros::objects(frame, 0, ros::frame_of(params_, camera.node)));
  }
}

void Recorder::guarded(const std::function<void()>& act) {
  if (!failure_.empty()) return;
  try {
    act();
  } catch (const CameraError& error) {
    failure_ = error.what();
  } catch (const record::TraceError& error) {
    failure_ = error.what();
  }
}

void Recorder::exposed(const sim::Exposure& exposure, std::uint64_t stamp_ns) {
  guarded([&] {
    const Moment moment{.time_us = exposure.time_us,
                        .cameras = {exposure.cameras.begin(), exposure.cameras.end()},
                        .link_world = exposure.link_world,
                        .body_world = exposure.body_world,
                        .robot = static_cast<std::uint32_t>(exposure.robot)};
    const std::uint64_t before = rig_.moments();
    rig_.expose(moment);
    if (rig_.moments() > before) stamps_ns_.push_back(stamp_ns);
    for (auto done = rig_.take(); !done.empty(); done = rig_.take()) keep(done);
  });
}

void Recorder::finish() {
  guarded([this] {
    for (auto done = rig_.take_last(); !done.empty(); done = rig_.take_last()) keep(done);
  });
}

void Recorder::keep(const std::vector<Picture>& pictures) {
  const std::uint64_t stamp_ns = stamps_ns_.front();
  stamps_ns_.pop_front();
  const model::CameraSensor* last = nullptr;
  for (const Picture& picture : pictures) {
    const model::CameraSensor& camera = entity_.cameras.at(picture.camera);
    const std::string topic = "/" + camera.name, frame = frame_of(camera);
    const bool colour = picture.encoding == "png";
    const char* kind =
        colour ? "/image/compressed" : (picture.encoding == "16UC1" ? "/depth" : "/labels");
    // The header has the time of exposure; the file's time adds the latency.
    const auto latency_ns = static_cast<std::uint64_t>(std::llround(1e9 * camera.latency_s));
    const std::uint64_t had_ns = stamp_ns + latency_ns;
    trace_.append(topic + kind, colour ? ros::kCompressedImage : ros::kImage, had_ns,
                  ros::picture({picture.encoding, picture.width, picture.height, picture.data},
                               frame, stamp_ns));
    if (!picture.names.empty()) {
      trace_.append(topic + "/label_info", ros::kLabelInfo, had_ns,
                    ros::label_info(picture.names, frame, stamp_ns));
    }
    ++pictures_;
    if (&camera == last) continue;
    last = &camera;
    trace_.append(topic + "/camera_info", ros::kCameraInfo, had_ns,
                  ros::camera_info(info_of(camera), frame, stamp_ns));
  }
}

}  // namespace verp::camera
