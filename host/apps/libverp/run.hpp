#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/libverp/air.hpp"
#include "host/apps/libverp/verp.h"
#include "host/run/session/live_orders.hpp"
#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::abi {

class Sight {
 public:
  explicit Sight(const sim::WorldOptions& world);

  void add(const session::WalkPlan& plan);
  void looked(session::Session& session, std::uint32_t robot);

  /// The camera's last picture in that encoding (camera::Picture); null: none taken yet. Throws
  /// CameraError.
  const camera::Picture* picture(std::uint32_t robot, std::uint32_t camera, const char* encoding);
  /// Draws the world as it is now. Throws CameraError, and std::invalid_argument for an unknown
  /// view.
  camera::Picture render(session::Session& session, std::uint32_t robot,
                         const camera::Outside& from);

 private:
  struct Look {
    std::shared_ptr<const camera::Moment> at;  ///< null: none taken yet
    std::vector<camera::Picture> drawn;        ///< empty: not drawn yet
  };
  camera::Painter& painter();

  camera::Stage stage_;
  std::vector<std::vector<Look>> last_;       ///< by robot, by camera
  std::unique_ptr<camera::Painter> painter_;  ///< made by the first request
};

/// A robot of the session. The session's hooks refer to it.
class RobotInstance {
 public:
  RobotInstance(const verp_robot& what, std::uint32_t index);

  const session::WalkPlan& plan() const { return plan_; }
  session::Hooks hooks();

  void view(verp_tick* tick) { view_ = tick; }
  void control(verp_controller controller, void* user) {
    controller_ = controller;
    user_ = user;
  }
  session::LiveOrders& orders() { return orders_; }
  /// Orders come only from the library's user.
  bool own_orders() const { return own_orders_; }
  const Tuning& tuning() const {
    return state_.admit.started != 0 ? state_.tuning : plan_.params.tuning;
  }
  const State& state() const { return state_; }
  std::uint64_t digest() const { return state_.digest.chain; }
  /// Adds to the trace, at the time of the last tick.
  void note_radio(record::ros::Radio radio);

  /// Computes the result and closes the trace, once.
  const session::WalkResult& finish(session::Session& session);

 private:
  void take_actions();
  void open_trace(const char* file);
  void decide(const Params& params, State& state, const Inputs& inputs, Outputs& outputs);
  void ticked(const session::Tick& tick);
  void write_view(const session::Tick& tick);

  const std::uint32_t index_;
  session::WalkPlan plan_;
  action::Library actions_;  ///< in plan_.actions
  bool open_end_ = false, own_orders_ = false;
  std::unique_ptr<record::TraceWriter> trace_;
  session::LiveOrders orders_;
  verp_controller controller_ = nullptr;
  void* user_ = nullptr;
  verp_tick* view_ = nullptr;
  State state_;
  std::uint32_t tick_ = 0;
  std::optional<std::uint32_t> deciding_;  ///< tick whose controller runs or has failed
  std::string radio_failure_;              ///< why the trace takes no more messages
  std::optional<session::WalkResult> result_;
};

struct Run {
  explicit Run(const session::Options& options) : session(options), sight(options.world) {}
  RobotInstance& seat(std::uint32_t index);

  std::deque<std::unique_ptr<RobotInstance>> seats;  ///< outlive the session
  session::Session session;
  Sight sight;
  std::optional<Air> air;  ///< nullopt: no radio
  bool begun = false, ended = false;

  void finish();
};

}  // namespace verp::abi
