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
#include "host/run/scenario/expand.hpp"
#include "host/run/session/live_orders.hpp"
#include "host/run/session/session.hpp"
#include "host/trace/record/mcap_format.hpp"

namespace verp::view {

struct RunSetup {
  scenario::Expanded run = {};  ///< only its first robot is steered
  /// A robot that is drawn beside ours but not in the world. Called in the run's thread after each
  /// tick.
  std::function<scene::RobotView(const scene::RobotView&)> beside = {};
  std::string record_file = {};  ///< may be empty
  record::mcap::StringMap metadata = {};

  const session::WalkPlan& plan() const { return run.plans.front(); }
};

/// A session in its own thread for a window.
class LiveRun {
 public:
  /// Starts paused.
  explicit LiveRun(RunSetup setup);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  void play();
  void pause();
  void tick_once();
  /// 1: real time; 0: unpaced.
  void set_speed(double factor);
  /// Restarts the run and its record, played or paused as before.
  void reset();

  /// Handles for actions between two ticks.
  struct Hands {
    session::Session& session;
    session::Robot& robot;
    session::LiveOrders& orders;
  };
  /// Runs in the run's thread before the next tick. An exception becomes Status::complaint.
  void touch(std::function<void(Hands&)> what);

  /// A push or a set quantity, as in `verp walk`: recorded with its tick.
  void intervene(session::Intervention what);

  /// Gets up after each fall, if the robot has actions for it.
  void let_get_up(bool by_itself);

  /// Saves the run so far as a trace. These return empty or the reason.
  std::string save(const std::filesystem::path& file);
  /// Ends the run and completes its record. Returns empty or the reason.
  std::string finish();

  struct Status {
    bool playing = false, over = false, driving = false, emergency_stop = false;
    bool gets_up_by_itself = false;
    double speed = 1, real_time_factor = 0, simulated_s = 0;
    double late_s = 0;  ///< behind the clock
    std::uint64_t ticks = 0, digest = 0;
    std::optional<Tuning> tuning = {};  ///< in effect
    std::string failure = {};           ///< why the run is over
    std::string complaint = {};         ///< last failed touch
    std::string happened = {};          ///< last event after a fall
    int runs = 0;
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
