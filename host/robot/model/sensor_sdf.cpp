#include "host/robot/model/sensor_sdf.hpp"

#include <cmath>
#include <sdf/Camera.hh>
#include <sdf/ForceTorque.hh>
#include <sdf/Lidar.hh>
#include <sdf/Noise.hh>

#include "host/robot/model/lens.hpp"

namespace verp::model {
namespace {

constexpr double kFastest_hz = 1000;
constexpr double kWidest = 11.5;  // tangent of 85 degrees, half of the widest lens

double rate_of(const sdf::Sensor& sensor, double if_none_hz, const WrongSensor& wrong) {
  const double rate_hz = sensor.UpdateRate() == 0 ? if_none_hz : sensor.UpdateRate();
  if (!(rate_hz > 0 && rate_hz <= kFastest_hz))
    wrong("its <update_rate> is not up to 1000 Hz", "give how often a second it measures");
  return rate_hz;
}

/// A picture's cost grows with its size.
void read_size(const sdf::Camera& lens, CameraSensor& camera, const WrongSensor& wrong) {
  constexpr unsigned kLeast = 8, kMost = 4096;
  if (lens.ImageWidth() < kLeast || lens.ImageWidth() > kMost || lens.ImageHeight() < kLeast ||
      lens.ImageHeight() > kMost)
    wrong("its <image> is not 8 to 4096 pixels each way", "give <width> and <height> in pixels");
  camera.width_px = static_cast<int>(lens.ImageWidth());
  camera.height_px = static_cast<int>(lens.ImageHeight());
}

void read_lens(const sdf::Camera& lens, CameraSensor& camera, const WrongSensor& wrong) {
  const double fov_rad = lens.HorizontalFov().Radian();
  if (!(fov_rad >= 0.01 && fov_rad <= 2.9))
    wrong("its <horizontal_fov> is not 0.01 to 2.9 rad", "give the angle in radians");
  camera.fx_px = camera.fy_px = camera.width_px / (2 * std::tan(fov_rad / 2));
  camera.cx_px = camera.width_px / 2.0 - 0.5;
  camera.cy_px = camera.height_px / 2.0 - 0.5;
  if (lens.HasLensIntrinsics()) {
    camera.fx_px = lens.LensIntrinsicsFx();
    camera.fy_px = lens.LensIntrinsicsFy();
    camera.cx_px = lens.LensIntrinsicsCx();
    camera.cy_px = lens.LensIntrinsicsCy();
    if (lens.LensIntrinsicsSkew() != 0)
      wrong("its <s> is not 0", "skewed pixels are not drawn here");
  }
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (!within(camera.fx_px, 0.1 * camera.width_px, 100 * camera.width_px) ||
      !within(camera.fy_px, 0.1 * camera.width_px, 100 * camera.width_px) ||
      !within(camera.cx_px, 0, camera.width_px) || !within(camera.cy_px, 0, camera.height_px))
    wrong("its <intrinsics> are none of such a picture",
          "give fx and fy of 0.1 to 100 times its width, cx and cy in it, in pixels");
  camera.distortion = {lens.DistortionK1(), lens.DistortionK2(), lens.DistortionP1(),
                       lens.DistortionP2(), lens.DistortionK3()};
  const auto centre = lens.DistortionCenter();
  if (centre.X() != 0.5 || centre.Y() != 0.5)
    wrong("its distortion's <center> is not 0.5 0.5",
          "give the lens' centre as <intrinsics> cx, cy");
  camera.near_m = lens.NearClip();
  camera.far_m = lens.FarClip();
  if (!(camera.near_m >= 1e-3 && camera.far_m > camera.near_m && camera.far_m <= 10000))
    wrong("its <clip> is none", "give <near> of at least 0.001 m and a <far> beyond it");
}

/// Checks the edge, where distortion is strongest.
void check_distortion(const CameraSensor& camera, const WrongSensor& wrong) {
  constexpr int kParts = 64;
  const double right = camera.width_px - 1.0, bottom = camera.height_px - 1.0;
  for (int i = 0; i <= kParts; ++i) {
    const double part = 1.0 * i / kParts;
    for (const Eigen::Vector2d& at :
         {Eigen::Vector2d(part * right, 0), Eigen::Vector2d(part * right, bottom),
          Eigen::Vector2d(0, part * bottom), Eigen::Vector2d(right, part * bottom)}) {
      const auto direction = direction_of(camera, at);
      if (!direction || direction->norm() > kWidest)
        wrong("its <distortion> folds the picture, or makes it wider than 170 degrees",
              "give smaller k1, k2, k3, p1 and p2");
    }
  }
}

void read_noise(const sdf::Noise& noise, CameraSensor& camera, const WrongSensor& wrong) {
  camera.noise_mean = noise.Mean();
  camera.noise_stddev = noise.StdDev();
  if (!(camera.noise_stddev >= 0 && camera.noise_stddev <= 1 && std::abs(camera.noise_mean) <= 1))
    wrong("its <noise> is more than its range",
          "give <mean> and <stddev> in parts of white, 0.01; of a depth camera in m");
}

CameraSensor::Kind kind_of(const sdf::Sensor& sensor) {
  switch (sensor.Type()) {
    case sdf::SensorType::DEPTH_CAMERA:
      return CameraSensor::Kind::kDepth;
    case sdf::SensorType::RGBD_CAMERA:
      return CameraSensor::Kind::kColourAndDepth;
    case sdf::SensorType::SEGMENTATION_CAMERA:
      return CameraSensor::Kind::kLabels;
    default:
      return CameraSensor::Kind::kColour;
  }
}

/// Channel name from the file, without a leading slash.
std::string topic_of(const sdf::Sensor& sensor) {
  const std::string topic = sensor.Topic();
  return topic.starts_with('/') ? topic.substr(1) : topic;
}

}  // namespace

LaserSensor read_laser(const sdf::Sensor& sensor, int node, const Transform& pose,
                       const WrongSensor& wrong) {
  constexpr unsigned kMostRays = 4096;
  const sdf::Lidar& lidar = *sensor.LidarSensor();
  LaserSensor laser{.name = sensor.Name(), .node = node, .pose = pose};
  if (lidar.VerticalScanSamples() > 1) wrong("it scans in one plane here", "leave <vertical> out");
  if (lidar.HorizontalScanSamples() < 1 || lidar.HorizontalScanSamples() > kMostRays)
    wrong("<samples> is not 1 to 4096", "write how many rays a scan has");
  laser.samples = static_cast<int>(lidar.HorizontalScanSamples());
  laser.first_rad = lidar.HorizontalScanMinAngle().Radian();
  laser.last_rad = lidar.HorizontalScanMaxAngle().Radian();
  if (laser.samples > 1 && !(laser.last_rad > laser.first_rad))
    wrong("<max_angle> is not above <min_angle>", "swap them, or give one sample");
  laser.min_m = lidar.RangeMin();
  laser.max_m = lidar.RangeMax();
  if (!(laser.min_m >= 0 && laser.max_m > laser.min_m && laser.max_m <= 1000))
    wrong("its <range> is none", "give <min> and <max> in m, up to 1000");
  laser.resolution_m = lidar.RangeResolution();
  laser.noise_mean_m = lidar.LidarNoise().Mean();
  laser.noise_stddev_m = lidar.LidarNoise().StdDev();
  laser.rate_hz = rate_of(sensor, 10, wrong);
  return laser;
}

bool is_camera(const sdf::Sensor& sensor) {
  switch (sensor.Type()) {
    case sdf::SensorType::CAMERA:
    case sdf::SensorType::DEPTH_CAMERA:
    case sdf::SensorType::RGBD_CAMERA:
    case sdf::SensorType::SEGMENTATION_CAMERA:
      return sensor.CameraSensor() != nullptr;
    default:
      return false;
  }
}

CameraSensor read_camera(const sdf::Sensor& sensor, int node, const Transform& pose,
                         const WrongSensor& wrong) {
  const sdf::Camera& lens = *sensor.CameraSensor();
  CameraSensor camera{.name = sensor.Name(), .kind = kind_of(sensor), .node = node, .pose = pose};
  camera.rate_hz = rate_of(sensor, 30, wrong);
  read_size(lens, camera, wrong);
  read_lens(lens, camera, wrong);
  check_distortion(camera, wrong);
  read_noise(lens.ImageNoise(), camera, wrong);
  return camera;
}

ForceTorqueSensor read_force_torque(const sdf::Sensor& sensor, int node, const Transform& link,
                                    const Transform& pose, const WrongSensor& wrong) {
  constexpr double kMost = 1e4;
  const sdf::ForceTorque& meter = *sensor.ForceTorqueSensor();
  ForceTorqueSensor out{
      .name = sensor.Name(), .topic = topic_of(sensor), .node = node, .pose = pose};
  if (out.topic.empty()) out.topic = out.name;
  out.rate_hz = rate_of(sensor, out.rate_hz, wrong);
  if (node == 0)
    wrong("nothing carries the body, so there is no force to measure",
          "put it into the joint, or onto a link that a joint moves");
  switch (meter.Frame()) {
    case sdf::ForceTorqueFrame::SENSOR:
      break;
    case sdf::ForceTorqueFrame::CHILD:
      out.pose.linear() = link.linear();
      break;
    default:
      wrong("its <frame> is not read here", "write child or sensor");
  }
  out.on_child = meter.MeasureDirection() == sdf::ForceTorqueMeasureDirection::PARENT_TO_CHILD;
  const auto read = [&](const sdf::Noise& noise, double& mean, double& stddev) {
    mean = noise.Mean();
    stddev = noise.StdDev();
    if (!(std::abs(mean) <= kMost && stddev >= 0 && stddev <= kMost))
      wrong("its <noise> is none", "give <mean> and <stddev> in N, of <torque> in N m");
  };
  read(meter.ForceXNoise(), out.force_mean_n.x(), out.force_stddev_n.x());
  read(meter.ForceYNoise(), out.force_mean_n.y(), out.force_stddev_n.y());
  read(meter.ForceZNoise(), out.force_mean_n.z(), out.force_stddev_n.z());
  read(meter.TorqueXNoise(), out.torque_mean_n_m.x(), out.torque_stddev_n_m.x());
  read(meter.TorqueYNoise(), out.torque_mean_n_m.y(), out.torque_stddev_n_m.y());
  read(meter.TorqueZNoise(), out.torque_mean_n_m.z(), out.torque_stddev_n_m.z());
  return out;
}

ContactSensor read_contact(const sdf::Sensor& sensor, int node, const WrongSensor& wrong) {
  ContactSensor out{.name = sensor.Name(), .topic = topic_of(sensor), .node = node};
  out.rate_hz = rate_of(sensor, out.rate_hz, wrong);
  return out;
}

}  // namespace verp::model
