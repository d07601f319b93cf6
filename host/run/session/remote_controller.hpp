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

/// How time passes in the twin for a controller at the other end of a link.
enum class Pace {
  kAuto,      ///< lockstep if the controller announces it, else wall clock
  kLockstep,  ///< time stands until a controller announces lockstep
  kRealTime,  ///< wall clock; lockstep is refused
};

struct ServeOptions {
  std::string link;  ///< link of the controller's servo bus
  std::string operator_link =
      {};  ///< link of its operator port; empty: orders come from another source
  Pace pace = Pace::kAuto;
  /// How long, by the wall clock, a lockstep controller may keep the twin waiting. Then the robot
  /// counts as without a controller. 0: no limit.
  double patience_s = 0;
  /// The run ends when a controller releases the robot and hangs up; else the twin waits for
  /// another.
  bool ends_with_controller = false;
  // Functions may be empty.
  std::function<void(const std::string&)> told = {};  ///< receives events as text
  /// Called for a CAN interface before anything is sent; may throw.
  std::function<void(const link::CanInterface&)> check = {};
  std::function<void()> real_time_begins = {};  ///< in its thread: raise the priority now
  std::function<void()> cannot_keep_up = {};    ///< give the priority back now
  std::function<void(const std::string& why)> gave_up = {};  ///< this robot is over, and why
};

/// Counts of a CAN interface.
struct CanFrames {
  std::uint64_t heard = 0;
  std::uint32_t dropped = 0;     ///< of these, or before: faster than the simulated wire or this PC
  std::uint64_t skipped_us = 0;  ///< clock time skipped because this PC was slower
};

struct RemoteResult {
  bool met = false;             ///< a controller came, or a master that sends requests
  bool device_trouble = false;  ///< the link or the controller caused the walk's failure
  bool lay_down = false;        ///< the robot was released, and lies
  bool real_time = false;
  std::uint64_t compared = 0;  ///< ticks with a reported digest equal to this PC's
  std::uint32_t losses = 0;    ///< losses of the link
  std::uint32_t overruns = 0;  ///< bytes or CAN frames lost at this PC for lack of room
  std::uint32_t resets = 0;    ///< controller restarts during the run
  bus::LockstepSession::Counters lockstep;
  bus::RealtimeServer::Counters realtime;
  std::optional<CanFrames> can;  ///< only for CAN in real time
};

/// The twin's side for a controller at the other end of a link. With an operator link the robot
/// walks as with a local controller, and this PC compares every tick. Without one, the twin serves
/// for plan.walk_s from the first torque on (Robot::watch) and is scored by what it did. Subclasses
/// add what differs between buses.
class RemoteController : public Controller {
 public:
  bool tick() final;
  void finish() final;
  double wall_s(double session_s) const final;
  /// Reports, once, for whom it waits.
  void introduce();
  /// The user sets the robot on its feet. False: impossible while a servo has torque.
  bool set_upright();
  /// Call once, at the end.
  virtual RemoteResult result() const;

 protected:
  /// `connected`: the link is there from the beginning.
  RemoteController(Robot& robot, const ServeOptions& options, bool connected);

  /// Serves incoming requests; waits kIdle_us for them, in real time kRealTimeTurn_us.
  virtual void turn() = 0;
  virtual bool stopped() const = 0;  ///< the controller was told to stop
  virtual bool greeted() const = 0;  ///< it has announced lockstep
  virtual bool real_time_begun() const = 0;
  /// Any client has come, even if only to look.
  virtual bool met() const { return greeted() || real_time_begun(); }
  virtual void conclude() {}  ///< after the last turn
  virtual std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) = 0;

  void say(const std::string& line) const;
  void fail(const std::string& why, bool device = true);
  bool over() const;
  bool shadows() const { return shadow_ != nullptr; }
  bool may_run_in_real_time() const;
  /// Gives a controller time to look around before it asks for a twin. `heard`: something other
  /// than clock requests has come.
  static constexpr std::uint64_t kListen_ns = 1'000'000'000;
  bool still_listening(bool heard, std::uint64_t listen_ns = kListen_ns);
  void begin_real_time();
  /// Watches all ticks up to bus time `now_us` of a robot whose controller reports nothing.
  void watch_until(std::uint64_t now_us);
  /// Ends a turn in which `came` bytes or frames arrived. Judges the controller's patience by its
  /// clock requests; other traffic does not advance the world.
  void waited(const bus::LockstepSession& clock, std::size_t came, const char* unit);
  /// Reports each change of the link. `losses`: their number so far.
  void watch_link(bool connected, std::uint32_t losses);

  /// The lockstep server's hooks that are common to all buses.
  bus::SessionHooks hooks();

  static constexpr std::uint32_t kIdle_us = 20'000;  // longest delay of an interrupt
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
  std::unique_ptr<bus::Shadow> shadow_;  ///< null without an operator port
  bus::ControllerReport last_;
  PlanNotes plan_notes_;
  std::string failure_;
  std::uint64_t compared_ = 0;
  std::uint64_t start_ns_ = 0;  ///< start, monotonic clock; 0: not yet
  std::uint64_t drive_ns_ = 0;  ///< time at which a servo first had torque
  std::uint64_t heard_ns_ = 0;  ///< time of the first traffic other than clock requests
  std::uint64_t alone_ns_ = 0;  ///< time since when no controller has come; 0: not yet
  std::uint64_t idle_ns_ = 0;   ///< time since when no clock request came; 0: it is not waiting
  std::uint64_t asked_ = 0;     ///< clock requests, as last seen
  std::uint64_t strange_ = 0;   ///< bytes or frames since the last clock request
  std::uint64_t next_us_ = 0;   ///< next tick to watch
  std::uint32_t resets_ = 0;
  bool device_trouble_ = false, recorded_ = false, met_ = false, declined_ = false;
  bool lay_down_ = false, introduced_ = false, reminded_ = false, connected_, ended_ = false,
       began_ = false;
};

/// The server for the robot's bus: byte link or CAN. Throws what opening a link throws.
std::unique_ptr<RemoteController> make_served(Robot& robot, const ServeOptions& options);

std::unique_ptr<RemoteController> make_served_on_serial(Robot& robot, const ServeOptions& options);
std::unique_ptr<RemoteController> make_served_on_can(Robot& robot, const ServeOptions& options);

}  // namespace verp::session
