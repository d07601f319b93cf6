#pragma once
#include <memory>

#include "host/apps/view/run/film.hpp"
#include "host/apps/view/run/live_run.hpp"

namespace verp::view {

/// A rewound run is paused; play() continues it at its newest instant.
class Player {
 public:
  explicit Player(RunSetup setup);
  explicit Player(std::shared_ptr<const Film> trace);

  /// Null for a trace.
  LiveRun* live() { return live_.get(); }
  std::shared_ptr<const Film> film() const;

  void play();
  void pause();
  bool playing() const;
  /// Moves by ticks; a run at its newest instant runs one tick.
  void step(int ticks);
  void seek(double t_s);
  void set_speed(double factor);
  double speed() const { return speed_; }
  /// Restarts a run; rewinds a trace.
  void reset();

  /// True while a run's newest instant is shown.
  bool follows() const { return follows_; }
  double shown_s() const { return shown_s_; }
  /// Null: nothing to show. Call once a frame with the wall time.
  Picture now(double wall_s);

 private:
  std::unique_ptr<LiveRun> live_;
  std::shared_ptr<const Film> trace_;
  double speed_ = 1, shown_s_ = 0, wall_s_ = 0;
  bool follows_, playing_ = false;
};

}  // namespace verp::view
