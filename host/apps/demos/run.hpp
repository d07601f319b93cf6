#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/demos/brain/brain.hpp"
#include "host/twin/radio/radio.hpp"

namespace verp::demos {

struct Run;

struct Fact {
  std::string name;
  double value = 0;
  std::string unit;
};

struct Verdict {
  std::string failure;  ///< which criterion failed; empty: none
  std::vector<Fact> facts;
};

/// A task for one robot or several in a world.
struct Demo {
  std::string name, what, criterion;
  int fewest = 1, usual = 1, most = 1;             ///< number of robots
  double length_s = 60;                            ///< at most
  std::string world{};                             ///< in common/worlds; empty: a level floor
  bool cameras = false;                            ///< the robots use their cameras
  std::vector<brain::Pose> (*places)(int robots);  ///< start poses
  std::unique_ptr<brain::Brain> (*brain)(const brain::About& about);
  /// Judges from the ground truth, as a referee does.
  Verdict (*judge)(const Run& run);
  std::vector<brain::Point> marks{};  ///< drawn in the picture, such as a goal
};

const std::vector<Demo>& all_demos();

struct Options {
  std::string model = "generic21";
  int robots = 0;          ///< 0: the demo's default
  double for_s = 0;        ///< 0: the demo's default
  std::uint64_t seed = 1;  ///< of the radio and of robot 0; robot i uses seed + i
  std::uint32_t physics_step_us = 2000;
  radio::Conditions radio = {};
  std::string world;             ///< replaces the demo's world
  std::filesystem::path record;  ///< RUN.mcap: robot traces are RUN.NAME.mcap; empty: no traces
  std::map<std::string, std::string> metadata;  ///< additional, for the traces
  /// Sees a brain's inputs before the brain does; for tests.
  std::function<void(int robot, const brain::Senses&)> spy;
  std::function<bool()> interrupted;
  std::function<void(double share)> went_on;
};

/// A robot's true pose and its pose by odometry, both in the world frame.
struct Moment {
  double time_s = 0;
  brain::Pose real, believed;
};

struct Track {
  std::string name;
  std::vector<Moment> moments;
  std::optional<double> fell_s, done_s;  ///< done: by the robot's own judgement
  int touches = 0;                       ///< new contacts with another robot or a thing
  std::uint64_t ticks = 0, digest = 0;
  std::filesystem::path trace;
  std::string trace_failure;
};

struct ThingTrack {
  std::string name;
  std::vector<brain::Point> at_m;
};

/// A static object above the floor, from above.
struct Outline {
  std::vector<brain::Point> corners;
};

struct RadioCount {
  std::uint64_t sent = 0, refused = 0;
  std::array<std::uint64_t, radio::kFates> fates{};
};

struct Run {
  const Demo* demo = nullptr;
  std::vector<Track> robots;
  std::vector<ThingTrack> things;
  std::vector<Outline> outlines;
  RadioCount radio;
  double length_s = 0, wall_s = 0;
  bool interrupted = false;
  Verdict verdict;
};

/// Throws what loading a robot or a world and running a session throw. Throws std::invalid_argument
/// for an unsuitable number of robots and camera::CameraError if pictures cannot be drawn.
Run run(const Demo& demo, const Options& options);

}  // namespace verp::demos
