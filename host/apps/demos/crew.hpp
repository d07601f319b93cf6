#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/demos/computer.hpp"
#include "host/apps/demos/run.hpp"
#include "host/run/session/session.hpp"
#include "host/show/camera/wire.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::demos {

class Member {
 public:
  Member(const Demo& demo, const Options& options, int number, int robots);

  const session::WalkPlan& plan() const { return plan_; }
  Computer& computer() { return computer_; }
  record::TraceWriter* trace() { return trace_.get(); }
  Track& track() { return track_; }
  const Track& track() const { return track_; }
  std::uint32_t tick() const { return tick_; }
  /// The session's hooks. `look` renders a picture; empty: no pictures.
  using Look = std::function<std::optional<camera::Picture>(const sim::Exposure&)>;
  session::Hooks hooks(Look look);

  /// The referee observes the robot.
  void watch(const sim::TwinRobot& twin, double time_s);
  void note_radio(const char* event, std::int64_t number, int from, int to,
                  const std::string& data);
  void close(const session::WalkResult& result);

 private:
  void open_trace(const Options& options);
  void guarded(const std::function<void()>& act);

  session::WalkPlan plan_;
  const brain::Pose placed_;
  const int number_;
  Computer computer_;
  std::unique_ptr<record::TraceWriter> trace_;
  Track track_;
  std::uint32_t tick_ = 0;
  bool touched_ = false;
};

}  // namespace verp::demos
