#pragma once
#include <filesystem>
#include <memory>

#include "host/robot/model/world.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

/// Shows a trace at any time. Runs the controller again over the recorded Inputs, so its goals are
/// known even without recorded State.
class TracePlayer {
 public:
  /// Throws TraceError. If the robot's file is gone or has other joints, shows a robot made of the
  /// trace's Params; note() says so.
  explicit TracePlayer(const std::filesystem::path& file);
  ~TracePlayer();

  const record::Trace& trace() const;
  const Entity& entity() const;
  /// Null: a level floor.
  const model::World* world() const;
  const std::string& note() const;
  double begin_s() const;
  double end_s() const;
  std::size_t size() const;                ///< ticks
  std::size_t index_at(double t_s) const;  ///< the tick at or before

  Snapshot at(std::size_t index) const;
  /// The controller after that tick.
  void controller_at(std::size_t index, State& state, Outputs& outputs) const;

 private:
  struct Film;
  std::unique_ptr<Film> film_;
};

}  // namespace verp::scene
