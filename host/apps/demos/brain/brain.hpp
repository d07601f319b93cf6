#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/demos/brain/pose.hpp"

/// Who decides where a robot goes: given, some times a second, what a computer on its back could
/// know, and nothing else. Nothing in this folder can see the twin (tests/gates/layers.txt).
namespace verp::brain {

/// One turn of the robot's laser.
struct Scan {
  double time_s = 0;                   ///< when it was measured, by the robot's clock
  Pose odometry;                       ///< then
  double roll_rad = 0, pitch_rad = 0;  ///< then, as the controller estimates them
  double high_m = 0;                   ///< of the laser above the floor, by the joints' angles
  std::vector<float> range_m;          ///< from the first angle on; inf: nothing within range
};

/// What a camera saw.
struct Picture {
  double time_s = 0;
  Pose odometry;               ///< then
  double camera_m[3] = {};     ///< then, above the point of the floor that `odometry` has,
  double camera_axes[9] = {};  ///< and its axes (x ahead, y left, z up), row-major, by the
                               ///< joints' and the IMU's angles; the floor is taken for level
  int width_px = 0, height_px = 0;
  std::string rgb;  ///< rows from the top, three bytes a pixel
};

struct Message {
  int from = 0;
  std::string data;
};

/// All that a brain is told.
struct Senses {
  double now_s = 0;    ///< the robot's own clock
  bool ready = false;  ///< it stands, or walks: it takes orders
  bool walking = false;
  bool down = false;  ///< it fell, or is about to
  /// Where the robot thinks that it is, from where it was switched on: its feet's steps by the
  /// joints' angles, its heading by the gyro. It drifts, and nobody tells how much.
  Pose odometry;
  std::optional<Scan> scan;        ///< one that is new
  std::optional<Picture> picture;  ///< likewise
  std::vector<Message> heard;      ///< by radio, since the last time
};

struct ToSay {
  std::string data;
  int to = -1;  ///< a robot's number; -1: everybody
};

/// All that a brain can do: what an operator may order, and radio.
struct Orders {
  bool walk = false;  ///< false: stand
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
  double head_pan_rad = 0, head_tilt_rad = 0;  ///< to the left, down
  std::vector<ToSay> say;
  bool done = false;  ///< as far as this robot knows, its part is over
};

/// What a robot knows of itself from the start: its file, and what it was told before.
struct About {
  int number = 0, robots = 1;  ///< its own, from 0, and how many there are
  Pose placed;                 ///< where it is put down, as well as whoever does that can
  double laser_first_rad = 0, laser_step_rad = 0, laser_max_m = 0;
  Point laser_m{};                                    ///< from the trunk's centre
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;  ///< the camera's lens
};

class Brain {
 public:
  virtual ~Brain() = default;
  virtual Orders think(const Senses& senses) = 0;
};

}  // namespace verp::brain
