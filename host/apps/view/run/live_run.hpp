#pragma once
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/apps/view/run/film.hpp"
#include "host/apps/view/run/pace.hpp"
#include "host/apps/view/run/run_record.hpp"
#include "host/run/session/live_orders.hpp"
#include "host/run/session/session.hpp"
#include "host/trace/record/mcap_format.hpp"

namespace verp::view {

struct RunSetup {
  session::WalkPlan plan;
  std::vector<session::WalkPlan> others = {};  ///< robots of the same world, which are only watched
  /// What stands beside the robot and is none of the world's: asked in the run's thread after each
  /// tick, with the robot's own view.
  std::function<scene::RobotView(const scene::RobotView&)> beside = {};
  sim::WorldOptions world = {};
  std::string record_file = {};  ///< gets the run as it goes on; empty: none
  record::mcap::StringMap metadata = {};
};

/// A session that runs beside a window, in a thread of its own: paced, paused, touched, wound up
/// anew. All that a person does reaches it between two ticks, so the window's own pace changes no
/// bit of it.
class LiveRun {
 public:
  /// Paused before the first tick.
  explicit LiveRun(RunSetup setup);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  void play();
  void pause();
  void tick_once();
  /// 1: as fast as the clock; 0: as fast as it can.
  void set_speed(double factor);
  /// The same run from its beginning, as it was played or paused; a record begins anew.
  void reset();

  /// What can be touched between two ticks.
  struct Hands {
    session::Session& session;
    session::Robot& robot;
    session::LiveOrders& orders;
  };
  /// Done in the run's thread before its next tick. What it throws is Status::complaint.
  void touch(std::function<void(Hands&)> what);

  /// A push, or a quantity set to a value, as `verp walk` does them: recorded, with its tick.
  void intervene(session::Intervention what);

  /// Whenever it falls, it gets up without a word, if it has actions to get up by.
  void let_get_up(bool by_itself);

  /// Writes what has run so far as a trace. Empty, or why there is none.
  std::string save(const std::filesystem::path& file);
  /// The record's file is whole from here on, and the run over. Empty, or why it is not.
  std::string finish();

  struct Status {
    bool playing = false, over = false, driving = false, emergency_stop = false;
    bool gets_up_by_itself = false;
    double speed = 1, real_time_factor = 0, simulated_s = 0;
    double late_s = 0;  ///< behind the clock
    std::uint64_t ticks = 0, digest = 0;
    std::optional<Tuning> tuning = {};  ///< in force
    std::string failure = {};           ///< of a run that is over
    std::string complaint = {};         ///< of the last touch that went wrong
    std::string happened = {};          ///< to a robot that falls or lies: the last, in words
    int runs = 0;                       ///< it was begun so often
  };
  Status status() const;

  const RunSetup& setup() const { return setup_; }
  std::shared_ptr<const LiveFilm> film() const;

 private:
  struct Going;

  void loop();
  bool work(std::unique_lock<std::mutex>& lock);
  void tick(std::unique_lock<std::mutex>& lock);
  void ticked(const session::Tick& tick);
  void begin();
  session::Hooks hooks_of_other(std::size_t index);
  std::string close_record();
  double wall_s() const;
  template <class Change>
  void change(Change&& change);

  const RunSetup setup_;
  const std::shared_ptr<const model::Entity> entity_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  // Under the mutex:
  Status status_;
  Pace pace_;
  std::shared_ptr<LiveFilm> film_;
  std::vector<std::function<void(Hands&)>> touches_;
  int single_ticks_ = 0;
  bool quit_ = false, reset_ = false;
  // The run's thread alone:
  std::unique_ptr<Going> going_;
  std::thread thread_;
};

}  // namespace verp::view
