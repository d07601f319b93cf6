#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/os/link/can_interface.hpp"
#include "host/run/session/controller.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/twin/bus/lockstep_session.hpp"
#include "host/twin/bus/order_sink.hpp"
#include "host/twin/bus/realtime_server.hpp"
#include "host/twin/bus/shadow_loop.hpp"

namespace verp::session {

/// Time in the twin for a controller at a link.
enum class Pace {
  kAuto,      ///< lockstep if announced, else wall clock
  kLockstep,  ///< time stands until a controller announces lockstep
  kRealTime,  ///< lockstep is refused
};

struct ServeOptions {
  std::string link;                ///< of the servo bus
  std::string operator_link = {};  ///< operator port; empty: orders come from elsewhere
  Pace pace = Pace::kAuto;
  /// Longest wait for a lockstep controller, wall clock; then the run has lost it. 0: no limit.
  double patience_s = 0;
  /// The run ends when a controller releases the robot and hangs up; else the twin waits for
  /// another.
  bool ends_with_controller = false;
  // Functions may be empty.
  std::function<void(const std::string&)> told = {};  ///< receives events as text
  /// Called before anything is sent on CAN; may throw.
  std::function<void(const link::CanInterface&)> check = {};
  /// Called after each turn, some ms at most apart: for sensors beside the bus.
  std::function<void(sim::Plant&)> turned = {};
  std::function<void()> real_time_begins = {};               ///< raise the thread's priority
  std::function<void()> cannot_keep_up = {};                 ///< give it back
  std::function<void(const std::string& why)> gave_up = {};  ///< why this robot is over
};

struct CanFrames {
  std::uint64_t heard = 0;
  std::uint32_t dropped = 0;  ///< of these, or before: too fast for the simulated wire or this PC
  std::uint64_t skipped_us = 0;  ///< clock time skipped by a slow PC
};

struct RemoteResult {
  bool met = false;             ///< a controller or master came
  bool device_trouble = false;  ///< link or controller caused the failure
  bool lay_down = false;        ///< released, and lies
  bool real_time = false;
  std::uint64_t compared = 0;  ///< ticks with equal digests
  std::uint32_t losses = 0;    ///< losses of the link
  std::uint32_t overruns = 0;  ///< bytes or frames lost for lack of room
  std::uint32_t resets = 0;    ///< restarts of the controller
  bus::LockstepSession::Counters lockstep;
  bus::RealtimeServer::Counters realtime;
  std::optional<CanFrames> can;  ///< CAN in real time
};

/// The twin's side of a link to a controller. With an operator link, this PC compares every tick.
/// Without one, the twin serves plan.walk_s from the first torque on (Robot::watch) and is scored
/// by its motion.
class RemoteController : public Controller {
 public:
  bool tick() final;
  void finish() final;
  double wall_s(double session_s) const final;
  /// Reports, once, whom it waits for.
  void introduce();
  /// The user sets the robot upright; false: a servo has torque.
  bool set_upright();
  /// Call once.
  virtual RemoteResult result() const;

 protected:
  /// `connected`: the link is there from the beginning.
  RemoteController(Robot& robot, const ServeOptions& options, bool connected);

  /// Serves incoming requests; waits kIdle_us for them, in real time kRealTimeTurn_us.
  virtual void turn() = 0;
  virtual bool stopped() const = 0;  ///< a stop was sent
  virtual bool greeted() const = 0;  ///< it has announced lockstep
  virtual bool real_time_begun() const = 0;
  /// Any client, even one that only looks.
  virtual bool met() const { return greeted() || real_time_begun(); }
  virtual void conclude() {}  ///< after the last turn
  virtual std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) = 0;

  void say(const std::string& line) const;
  void fail(const std::string& why, bool device = true);
  bool over() const;
  bool shadows() const { return shadow_ != nullptr; }
  bool may_run_in_real_time() const;
  /// Leaves time to a controller that looks around before it asks for a twin. `heard`: something
  /// other than clock requests came.
  static constexpr std::uint64_t kListen_ns = 1'000'000'000;
  bool still_listening(bool heard, std::uint64_t listen_ns = kListen_ns);
  void begin_real_time();
  /// Watches all ticks up to bus time `now_us` of a controller without reports.
  void watch_until(std::uint64_t now_us);
  /// Ends a turn with `came` bytes or frames. Clock requests measure the controller's patience;
  /// other traffic does not advance the world.
  void waited(const bus::LockstepSession& clock, std::size_t came, const char* unit);
  /// Reports each change of the link. `losses`: their number so far.
  void watch_link(bool connected, std::uint32_t losses);

  bus::SessionHooks hooks();

  static constexpr std::uint32_t kIdle_us = 20'000;  // delay of an interrupt
  static constexpr std::uint32_t kRealTimeTurn_us = 500;

  Robot& robot_;
  const ServeOptions options_;
  std::string place_;  ///< of the link

 private:
  void waited_for_first(std::uint64_t now_ns, std::size_t came, const char* unit);
  void begins();
  void refused(const std::string& why);
  bool tick_ends();
  void tick_begins(std::uint32_t tick);
  void begin_shadow();
  void look_for_actions();
  void compare(const bus::ControllerReport& told);
  void watch();

  std::unique_ptr<bus::OrderSink> orders_;
  std::unique_ptr<bus::Shadow> shadow_;  ///< null: no operator port
  bus::ControllerReport last_;
  PlanNotes plan_notes_;
  std::string failure_;
  std::uint64_t compared_ = 0;
  std::uint64_t start_ns_ = 0;  ///< monotonic clock; 0: not yet
  std::uint64_t drive_ns_ = 0;  ///< first torque of a servo
  std::uint64_t heard_ns_ = 0;  ///< first traffic but clock requests
  std::uint64_t alone_ns_ = 0;  ///< since then no controller came; 0: not yet
  std::uint64_t idle_ns_ = 0;   ///< since then no clock request came; 0: it is not waiting
  std::uint64_t asked_ = 0;     ///< clock requests so far
  std::uint64_t strange_ = 0;   ///< bytes or frames since the last clock request
  std::uint64_t next_us_ = 0;   ///< next tick to watch
  std::uint32_t resets_ = 0;
  bool device_trouble_ = false, recorded_ = false, met_ = false, declined_ = false;
  bool lay_down_ = false, introduced_ = false, reminded_ = false, connected_, ended_ = false,
       began_ = false;
};

/// Byte link or CAN. Throws what opening a link throws.
std::unique_ptr<RemoteController> make_served(Robot& robot, const ServeOptions& options);

std::unique_ptr<RemoteController> make_served_on_serial(Robot& robot, const ServeOptions& options);
std::unique_ptr<RemoteController> make_served_on_can(Robot& robot, const ServeOptions& options);

}  // namespace verp::session
