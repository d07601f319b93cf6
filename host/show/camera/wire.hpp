#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/twin/sim/exposure.hpp"

/// What goes between a run and the program that draws for it, over a socket pair on one PC and of
/// one build: numbers are as the machine has them.
namespace verp::camera {

/// What is to be drawn.
struct Stage {
  struct Robot {
    std::string file;
    std::uint64_t seed = 1;  ///< of its cameras' noise
  };
  std::vector<Robot> robots;
  std::string world_file;  ///< empty: a level floor
};

/// One moment of it.
struct Moment {
  std::uint64_t time_us = 0;
  std::vector<std::uint32_t> cameras;                     ///< that look
  std::vector<std::vector<model::Transform>> link_world;  ///< of each robot
  std::vector<model::Transform> body_world;               ///< of the world's moving things
  std::uint32_t robot = 0;                                ///< whose cameras look
  bool raw = false;                                       ///< colour as rgb8, not as PNG
};

/// From where somebody beside the robots looks at a moment.
struct Outside {
  std::string view;  ///< of scene::view(), of moment.robot; empty: from eye_m to target_m
  model::Vec3 eye_m = model::Vec3::Zero(), target_m = model::Vec3::Zero();
  double vertical_fov_rad = 0.5;
  std::uint32_t width = 0, height = 0;
  bool shadows = true, antialias = true;
};

/// As sensor_msgs have it (host/trace/record/ros_camera.hpp).
struct Picture {
  std::uint32_t camera = 0;
  std::uint64_t time_us = 0;
  std::uint32_t width = 0, height = 0;
  std::string encoding, data;
  std::vector<std::string> names =
      {};  ///< of labels, from 1 on; empty: nothing to see has that number
};

enum class Kind : std::uint32_t {
  kStage,    ///< to the program, first
  kReady,    ///< from it: it can draw
  kFailed,   ///< from it: why not, in one line
  kMoment,   ///< to it
  kPicture,  ///< from it, for each camera that looked one or two
  kDone,     ///< from it, after the pictures of a moment: its processor time so far, us
  kOutside,  ///< to it, a moment and from where to look at it: kPicture and kDone, or kRefused
  kRefused   ///< from it: why it can't draw that, in one line; other things it can
};

struct Message {
  Kind kind = Kind::kDone;
  std::string data;
};

/// Waits until all is on its way. False: the other end is gone.
bool send(int socket, Kind kind, std::string_view data);
/// Waits for the next. None: the other end is gone.
std::optional<Message> receive(int socket);

std::string pack(const Stage& stage);
std::string pack(const Moment& moment);
std::string pack(const Moment& moment, const Outside& from);
std::string pack(const Picture& picture);
std::string pack(std::uint64_t number);
/// What pack() was given. None: it is no such thing; of a stage, also if another build packed it.
std::optional<Stage> unpack_stage(std::string_view data);
std::optional<Moment> unpack_moment(std::string_view data);
std::optional<std::pair<Moment, Outside>> unpack_outside(std::string_view data);
std::optional<Picture> unpack_picture(std::string_view data);
std::optional<std::uint64_t> unpack_number(std::string_view data);

}  // namespace verp::camera
