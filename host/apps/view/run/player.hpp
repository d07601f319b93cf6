#pragma once
#include <memory>

#include "host/apps/view/run/film.hpp"
#include "host/apps/view/run/live_run.hpp"

namespace verp::view {

/// What the window plays: a run or a trace, at the instant that is shown. A run that is wound back
/// stands still; played on, it goes on where it was, not where it is shown.
class Player {
 public:
  explicit Player(RunSetup setup);
  explicit Player(std::shared_ptr<const Film> trace);

  /// Null of a trace.
  LiveRun* live() { return live_.get(); }
  std::shared_ptr<const Film> film() const;

  void play();
  void pause();
  bool playing() const;
  /// Back and forth by so many ticks; a run at its newest instant goes on by one.
  void step(int ticks);
  void seek(double t_s);
  void set_speed(double factor);
  double speed() const { return speed_; }
  /// A run: from its beginning. A trace: to its beginning.
  void reset();

  /// The newest instant of a run is shown, whatever comes.
  bool follows() const { return follows_; }
  double shown_s() const { return shown_s_; }
  /// Once a picture, with the wall's time: what is to be shown. Null: nothing yet.
  Picture now(double wall_s);

 private:
  std::unique_ptr<LiveRun> live_;
  std::shared_ptr<const Film> trace_;
  double speed_ = 1, shown_s_ = 0, wall_s_ = 0;
  bool follows_, playing_ = false;
};

}  // namespace verp::view
