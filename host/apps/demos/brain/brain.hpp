#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/demos/brain/pose.hpp"

/// Brains decide where robots go. The inputs, several times a second, are only what a computer on
/// the robot's back could know. Code in this folder cannot see the twin (tests/gates/layers.txt).
namespace verp::brain {

/// One revolution of the robot's laser.
struct Scan {
  double time_s = 0;                   ///< of the measurement, by the robot's clock
  Pose odometry;                       ///< at time_s
  double roll_rad = 0, pitch_rad = 0;  ///< at time_s, as the controller estimates them
  double high_m = 0;                   ///< laser above the floor, from the joint angles
  std::vector<float> range_m;          ///< from the first angle on; inf: nothing in range
};

/// One camera picture.
struct Picture {
  double time_s = 0;
  Pose odometry;               ///< at time_s
  double camera_m[3] = {};     ///< from the floor point of `odometry`
  double camera_axes[9] = {};  ///< x ahead, y left, z up; row-major. Both from joint angles and
                               ///< IMU; assume a level floor.
  int width_px = 0, height_px = 0;
  std::string rgb;  ///< rows from the top, three bytes a pixel
};

struct Message {
  int from = 0;
  std::string data;
};

/// A brain's inputs.
struct Senses {
  double now_s = 0;    ///< the robot's own clock
  bool ready = false;  ///< stands or walks, and takes orders
  bool walking = false;
  bool down = false;  ///< fell, is falling or is getting up
  /// Pose since power-on: steps from the joint angles, heading from the gyro. It drifts, by an
  /// unknown amount.
  Pose odometry;
  std::optional<Scan> scan;        ///< empty: no new one
  std::optional<Picture> picture;  ///< empty: no new one
  std::vector<Message> heard;      ///< by radio, since the last call
};

struct ToSay {
  std::string data;
  int to = -1;  ///< a robot's number; -1: all robots
};

struct Orders {
  bool walk = false;  ///< false: stand
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
  double head_pan_rad = 0, head_tilt_rad = 0;  ///< positive: left, down
  std::vector<ToSay> say;
  bool done = false;  ///< this robot believes that its part is over
};

struct About {
  int number = 0, robots = 1;  ///< own number, from 0; number of robots
  Pose placed;                 ///< start pose, as exactly as it was measured
  double laser_first_rad = 0, laser_step_rad = 0, laser_max_m = 0;
  Point laser_m{};                                    ///< from the trunk's centre
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;  ///< the camera's intrinsics
};

class Brain {
 public:
  virtual ~Brain() = default;
  virtual Orders think(const Senses& senses) = 0;
};

}  // namespace verp::brain
