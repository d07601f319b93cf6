#pragma once
#include <filesystem>
#include <memory>

#include "host/robot/model/world.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

/// Shows a trace at any time. Runs the controller over the recorded Inputs, so goals need no
/// recorded State.
class TracePlayer {
 public:
  /// Throws TraceError. Null: it reads the robot's file. Without a fitting one it shows a robot
  /// from the trace's Params, and note() says so.
  explicit TracePlayer(const std::filesystem::path& file, const Entity* robot = nullptr);
  ~TracePlayer();

  const record::Trace& trace() const;
  const Entity& entity() const;
  /// Null: a level floor.
  const model::World* world() const;
  const std::string& note() const;
  double begin_s() const;
  double end_s() const;
  std::size_t size() const;                ///< ticks
  std::size_t index_at(double t_s) const;  ///< at or before

  Snapshot at(std::size_t index) const;
  void controller_at(std::size_t index, State& state, Outputs& outputs) const;

 private:
  struct Film;
  std::unique_ptr<Film> film_;
};

}  // namespace verp::scene
