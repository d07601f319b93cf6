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

/// A number that tells how well it went.
struct Fact {
  std::string name;
  double value = 0;
  std::string unit;
};

struct Verdict {
  std::string failure;  ///< by what the demo failed its own criterion; empty: it did not
  std::vector<Fact> facts;
};

/// Robots in a world that do something together, or one alone.
struct Demo {
  std::string name, what, criterion;
  int fewest = 1, usual = 1, most = 1;             ///< robots
  double length_s = 60;                            ///< at most
  std::string world{};                             ///< of common/worlds; empty: a level floor
  bool cameras = false;                            ///< they see through their cameras
  std::vector<brain::Pose> (*places)(int robots);  ///< where they are put down
  std::unique_ptr<brain::Brain> (*brain)(const brain::About& about);
  /// Knows what really happened, as a referee does.
  Verdict (*judge)(const Run& run);
  std::vector<brain::Point> marks{};  ///< to be seen in the picture, such as a goal
};

const std::vector<Demo>& all_demos();

struct Options {
  std::string model = "generic21";
  int robots = 0;          ///< 0: as the demo has
  double for_s = 0;        ///< likewise
  std::uint64_t seed = 1;  ///< of the first robot; the others have the next ones. And of the radio
  std::uint32_t physics_step_us = 2000;
  radio::Conditions radio = {};
  std::string world;             ///< in place of the demo's
  std::filesystem::path record;  ///< RUN.mcap: each robot's trace is RUN.NAME.mcap; empty: none
  std::map<std::string, std::string> metadata;  ///< of the traces, besides
  /// Sees what a robot's brain is told before it is; for tests.
  std::function<void(int robot, const brain::Senses&)> spy;
  std::function<bool()> interrupted;
  std::function<void(double share)> went_on;
};

/// Where a robot was, and where it thought that it was by its odometry: both in the world.
struct Moment {
  double time_s = 0;
  brain::Pose real, believed;
};

struct Track {
  std::string name;
  std::vector<Moment> moments;
  std::optional<double> fell_s, done_s;  ///< done: as the robot itself thought
  int touches = 0;                       ///< times it began to touch another robot or a thing
  std::uint64_t ticks = 0, digest = 0;
  std::filesystem::path trace;
  std::string trace_failure;
};

/// Where something that can move was at each moment.
struct ThingTrack {
  std::string name;
  std::vector<brain::Point> at_m;
};

/// What of the world stands still and is above the floor, seen from above.
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

/// Throws what loading a robot and a world and running a session throws, std::invalid_argument for
/// a number of robots that the demo has no use for, camera::CameraError where pictures cannot be
/// drawn.
Run run(const Demo& demo, const Options& options);

}  // namespace verp::demos
