#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/twin/sim/exposure.hpp"

/// A run and its drawing program on a socket pair, of one build on one PC: numbers are in machine
/// form.
namespace verp::camera {

struct Stage {
  struct Robot {
    std::string file;
    std::uint64_t seed = 1;  ///< for its cameras' noise
  };
  std::vector<Robot> robots;
  std::string world_file;  ///< empty: a level floor
};

struct Moment {
  std::uint64_t time_us = 0;
  std::vector<std::uint32_t> cameras;                     ///< that look
  std::vector<std::vector<model::Transform>> link_world;  ///< per robot
  std::vector<model::Transform> body_world;               ///< the world's moving objects
  std::uint32_t robot = 0;                                ///< whose cameras look
  bool raw = false;                                       ///< rgb8, not PNG
};

struct Outside {
  std::string view;  ///< scene::view() for moment.robot; empty: eye_m to target_m
  model::Vec3 eye_m = model::Vec3::Zero(), target_m = model::Vec3::Zero();
  double vertical_fov_rad = 0.5;
  std::uint32_t width = 0, height = 0;
  bool shadows = true, antialias = true;
};

/// As in sensor_msgs (host/trace/record/ros_camera.hpp).
struct Picture {
  std::uint32_t camera = 0;
  std::uint64_t time_us = 0;
  std::uint32_t width = 0, height = 0;
  std::string encoding, data;
  std::vector<std::string> names = {};  ///< labels from 1; empty: not in view
};

enum class Kind : std::uint32_t {
  kStage,    ///< to the program, first
  kReady,    ///< from it: it can draw
  kFailed,   ///< from it: the reason, in one line
  kMoment,   ///< to it
  kPicture,  ///< from it: one or two per camera that looked
  kDone,     ///< from it, after a moment's pictures: processor time so far, us
  kOutside,  ///< to it: moment and viewpoint; then kPicture and kDone, or kRefused
  kRefused   ///< from it: the reason, in one line; it still works
};

struct Message {
  Kind kind = Kind::kDone;
  std::string data;
};

/// False: the other end is gone.
bool send(int socket, Kind kind, std::string_view data);
/// Waits for the next; empty: the other end is gone.
std::optional<Message> receive(int socket);

std::string pack(const Stage& stage);
std::string pack(const Moment& moment);
std::string pack(const Moment& moment, const Outside& from);
std::string pack(const Picture& picture);
std::string pack(std::uint64_t number);
/// Empty for other data, also from another build.
std::optional<Stage> unpack_stage(std::string_view data);
std::optional<Moment> unpack_moment(std::string_view data);
std::optional<std::pair<Moment, Outside>> unpack_outside(std::string_view data);
std::optional<Picture> unpack_picture(std::string_view data);
std::optional<std::uint64_t> unpack_number(std::string_view data);

}  // namespace verp::camera
