#pragma once
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "firmware/app/pacer.hpp"
#include "host/apps/tool/walk_cameras.hpp"
#include "host/apps/tool/walk_files.hpp"

/// A robot that walks, and others beside it in the same world.
namespace verp::tool {

struct Walks {
  WalkResult result;
  app::Deadlines deadlines;                                ///< of a walk in real time
  double took_s = 0;                                       ///< of the wall, waiting included
  std::vector<std::pair<std::string, WalkResult>> others;  ///< name
  cli::Json objects =
      cli::Json::array();  ///< of the world that can be pushed or move, and where they ended
  cli::Json radio;         ///< what came of what was said; null: nobody had one
  std::string radio_text;
};

/// What the others leave on the disk: a trace each beside the first's, if that has one.
class OtherFiles {
 public:
  /// Throws as WalkFiles does.
  OtherFiles(const WalkOptions& options, const WalkFiles& first,
             const std::vector<WalkPlan>& others, LiveStream& live);
  /// Of the other of this number; null: none.
  record::TraceWriter* trace(std::size_t i) { return files_.empty() ? nullptr : files_[i].trace(); }
  void finish(const Walks& walks);
  /// Its name; empty: there is none.
  std::string name(std::size_t i) const;
  /// What was wanted and is not there.
  std::vector<std::string> lost() const;

 private:
  std::deque<WalkFiles> files_;
};

/// Walks them all. A robot of which the plan names a link is driven from there, in lockstep: the
/// world waits until its controller has come, and in every tick until it has answered. One that is
/// lost ends the run of all, or with TeamOptions::go_on its own.
Walks walk_together(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    const WalkOptions& options, const sim::WorldOptions& world, WalkFiles& files,
                    OtherFiles& other_files, cli::Progress& progress, WalkCameras* cameras);

/// What is to be said of the world and of those who walked along.
std::string team_text(const Walks& walks, const std::vector<WalkPlan>& others,
                      const OtherFiles& files, const sim::WorldOptions& world);
cli::Json team_json(const Walks& walks, const std::vector<WalkPlan>& others,
                    const OtherFiles& files, const sim::WorldOptions& world);
/// A line for each of the others whose walk is no good.
std::vector<std::string> failures_of(const Walks& walks, const OtherFiles& files);

}  // namespace verp::tool
