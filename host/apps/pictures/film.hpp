#pragma once
#include <functional>
#include <memory>

#include "host/apps/tool/walk_options.hpp"
#include "host/show/scene/snapshot.hpp"

/// What pictures are made of.
namespace verp::pictures {

/// Gets one instant after the other; false: enough.
using Show = std::function<bool(scene::Snapshot&&)>;

/// A robot's walk in the twin, or a trace.
class Film {
 public:
  virtual ~Film() = default;
  const scene::Scene& scene() const { return scene_; }
  const model::Entity& entity() const { return *scene_.robots.front().entity; }
  /// Something to say of it in one line; empty: nothing.
  const std::string& note() const { return note_; }
  virtual double end_s() const = 0;  ///< about when it ends
  virtual scene::Snapshot start() const = 0;
  /// Its instants from from_s on, every_s apart (0: each tick), until it or `show` ends. Once.
  virtual void play(double from_s, double every_s, const Show& show) = 0;

 protected:
  scene::Scene scene_;
  std::string note_;
};

/// A trace where the options' MODEL ends in .mcap, else a walk with these options. Throws
/// ToolError, LoadError and TraceError.
std::unique_ptr<Film> open_film(const tool::WalkOptions& options);

/// The options of a walk that a picture is made of, as those of the command line.
void declare_film(CLI::App& app, tool::WalkOptions& options);

bool is_trace(const tool::WalkOptions& options);

/// A trace shows what was recorded: throws ToolError where an option of a walk stands beside one.
void refuse_walk_of_trace(const CLI::App& app, const tool::WalkOptions& options);

}  // namespace verp::pictures
