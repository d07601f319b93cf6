#pragma once
#include <functional>
#include <memory>

#include "host/apps/tool/walk_options.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::pictures {

using Show = std::function<bool(scene::Snapshot&&)>;

/// A walk in the twin, or a trace.
class Film {
 public:
  virtual ~Film() = default;
  const scene::Scene& scene() const { return scene_; }
  const model::Entity& entity() const { return *scene_.robots.front().entity; }
  /// A line for the user; may be empty.
  const std::string& note() const { return note_; }
  virtual double end_s() const = 0;  ///< an estimate
  virtual scene::Snapshot start() const = 0;
  /// Shows instants from from_s on, every_s apart (0: each tick), to the end or until `show`
  /// returns false. Call once.
  virtual void play(double from_s, double every_s, const Show& show) = 0;

 protected:
  scene::Scene scene_;
  std::string note_;
};

/// A trace if MODEL ends in .mcap, else a walk. Throws ToolError, LoadError and TraceError.
std::unique_ptr<Film> open_film(const tool::WalkOptions& options);

void declare_film(CLI::App& app, tool::WalkOptions& options);

bool is_trace(const tool::WalkOptions& options);

/// Walk options do not fit a trace. Throws ToolError.
void refuse_walk_of_trace(const CLI::App& app, const tool::WalkOptions& options);

}  // namespace verp::pictures
