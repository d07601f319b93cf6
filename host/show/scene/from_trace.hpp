#pragma once
#include <filesystem>
#include <memory>

#include "host/robot/model/world.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

/// A trace as something to look at: at any time. The controller is run over the recorded Inputs
/// once more, so what it wanted is there too, whether the trace kept its State or not.
class TracePlayer {
 public:
  /// Throws TraceError. A trace whose robot file is gone, or is another robot now, shows a robot
  /// made of its Params: note() says so.
  explicit TracePlayer(const std::filesystem::path& file);
  ~TracePlayer();

  const record::Trace& trace() const;
  const Entity& entity() const;
  /// Where it was; null: on a level floor.
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
