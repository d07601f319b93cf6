#pragma once
#include <string>
#include <utility>
#include <vector>

#include "firmware/app/pacer.hpp"
#include "host/sim/world.hpp"
#include "host/tool/json.hpp"
#include "host/tool/walk_run.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Options for where the robot walks: --world, --at-pose.
struct PlaceOptions {
  std::string world, pose_text;
};

void declare(CLI::App& app, PlaceOptions& options);

/// Reads the world's file into what the twin's world is made of. Throws LoadError.
void read_place(const PlaceOptions& options, sim::WorldOptions& world);
/// Puts the robot to --at-pose. Throws ToolError.
void place_robot(const PlaceOptions& options, WalkPlan& plan);

class WalkCameras;

/// The walk of a robot, and of others beside it in the same world.
struct Walks {
  WalkResult result;
  app::Deadlines deadlines;                                ///< of a walk in real time
  double took_s = 0;                                       ///< of the wall, waiting included
  std::vector<std::pair<std::string, WalkResult>> others;  ///< name
  Json objects = Json::array();  ///< of the world that can be pushed or move, and where they ended
};
Walks walk_together(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    record::TraceWriter* trace, Progress& progress, bool keep_series,
                    const sim::WorldOptions& world, WalkCameras* cameras = nullptr,
                    bool real_time = false);

/// What is to be said of the world and of those who walked along.
std::string place_text(const Walks& walks, const sim::WorldOptions& world);
Json place_json(const Walks& walks, const sim::WorldOptions& world);

}  // namespace verp::tool
