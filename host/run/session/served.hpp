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

/// How the twin lets time go on for a controller at the other end of a link.
enum class Pace {
  kAuto,      ///< lockstep if the controller announces it, else by the wall's clock
  kLockstep,  ///< time stands until a controller announces lockstep
  kRealTime,  ///< by the wall's clock; lockstep is refused
};

struct ServeOptions {
  std::string link;  ///< where the controller's servo bus is
  std::string operator_link =
      {};  ///< where its operator's port is; empty: somebody else gives orders
  Pace pace = Pace::kAuto;
  /// How long a controller that has announced lockstep may keep the twin waiting, by the wall's
  /// clock; then the robot has none any more. 0: as long as it likes.
  double patience_s = 0;
  /// A controller that lets go of the robot and hangs up has ended the run; else it is served on.
  bool ends_with_controller = false;
  // Empty members are allowed.
  std::function<void(const std::string&)> told = {};  ///< what happens, in words
  /// Of a CAN interface, before anything is sent: may throw.
  std::function<void(const link::CanInterface&)> check = {};
  std::function<void()> real_time_begins = {};  ///< in its thread: the moment to ask for priority
  std::function<void()> cannot_keep_up = {};    ///< the moment to give it back
  std::function<void(const std::string& why)> gave_up = {};  ///< this robot is over, and why
};

/// What came from a CAN interface.
struct CanFrames {
  std::uint64_t heard = 0;
  std::uint32_t dropped = 0;  ///< of these, or before: faster than the simulated wire, or this PC
  std::uint64_t skipped_us = 0;  ///< of the clock: where this PC was slower than it
};

struct ServedResult {
  bool met = false;             ///< somebody has come: a controller, or a master that asks
  bool device_trouble = false;  ///< the walk's failure is the link's or the controller's
  bool lay_down = false;        ///< the robot was let go, and lies
  bool real_time = false;
  std::uint64_t compared = 0;  ///< ticks whose digest the controller told, equal to this PC's
  std::uint32_t losses = 0;    ///< times the link was lost
  std::uint32_t overruns = 0;  ///< bytes, or CAN frames, that found no room at this PC
  std::uint32_t resets = 0;    ///< times a controller began anew on a robot that was under way
  bus::LockstepSession::Counters lockstep;
  bus::RealtimeServer::Counters realtime;
  std::optional<CanFrames> can;  ///< over CAN in real time
};

/// A controller at the other end of a link: the twin answers it. With an operator link it walks as
/// one here does, and every tick of it is held against this PC's; without one the robot is served
/// for plan.walk_s from the first torque on (Robot::watch), and scored by what the twin did. What
/// differs between buses is added by the kind of bus.
class Served : public Controller {
 public:
  bool tick() final;
  void finish() final;
  double wall_s(double session_s) const final;
  /// Says for whom it waits, once.
  void introduce();
  /// Somebody sets the robot on its feet. False: not now, a servo has torque.
  bool set_upright();
  /// Once, at the end.
  virtual ServedResult result() const;

 protected:
  /// `connected`: the link is there from the beginning.
  Served(Robot& robot, const ServeOptions& options, bool connected);

  /// What came, and what it asks for; waits kIdle_us for it, in real time kRealTimeTurn_us.
  virtual void turn() = 0;
  virtual bool stopped() const = 0;  ///< the controller was told to
  virtual bool greeted() const = 0;  ///< it has announced lockstep
  virtual bool real_time_begun() const = 0;
  /// Somebody has come, if only to look.
  virtual bool met() const { return greeted() || real_time_begun(); }
  virtual void conclude() {}  ///< after the last turn
  virtual std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) = 0;

  void say(const std::string& line) const;
  void fail(const std::string& why, bool device = true);
  bool over() const;
  bool shadows() const { return shadow_ != nullptr; }
  bool may_run_in_real_time() const;
  /// A controller may look around before it asks for a twin: it gets time to do so. `heard`:
  /// something that is not for the clock has come.
  static constexpr std::uint64_t kListen_ns = 1'000'000'000;
  bool still_listening(bool heard, std::uint64_t listen_ns = kListen_ns);
  void begin_real_time();
  /// All ticks up to bus time `now_us` of a robot whose controller tells nothing, until it is over.
  void watch_until(std::uint64_t now_us);
  /// One turn is over, in which so many bytes or frames came: judges the controller's patience by
  /// what it asked of the clock. Whatever else comes does not let the world go on.
  void waited(const bus::LockstepSession& clock, std::size_t came, const char* unit);
  /// The link is there, or not: tells of each change. `losses`: of it so far.
  void watch_link(bool connected, std::uint32_t losses);

  /// The hooks of a lockstep server that mean the same on every bus.
  bus::SessionHooks hooks();

  static constexpr std::uint32_t kIdle_us = 20'000;  // how long an interrupt may have to wait
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
  std::unique_ptr<bus::Shadow> shadow_;  ///< null without an operator's port
  bus::ControllerReport last_;
  PlanNotes plan_notes_;
  std::string failure_;
  std::uint64_t compared_ = 0;
  std::uint64_t start_ns_ = 0;  ///< when it began, by the monotonic clock; 0: not yet
  std::uint64_t drive_ns_ = 0;  ///< when a servo first had torque
  std::uint64_t heard_ns_ = 0;  ///< when something that is not for the clock came first
  std::uint64_t alone_ns_ = 0;  ///< since when no controller has come; 0: not yet
  std::uint64_t idle_ns_ = 0;   ///< since when nothing came that lockstep waits for; 0: it does not
  std::uint64_t asked_ = 0;     ///< of the clock, as last seen
  std::uint64_t strange_ = 0;  ///< bytes or frames that came since something was asked of the clock
  std::uint64_t next_us_ = 0;  ///< tick to be watched
  std::uint32_t resets_ = 0;
  bool device_trouble_ = false, recorded_ = false, met_ = false, declined_ = false;
  bool lay_down_ = false, introduced_ = false, reminded_ = false, connected_, ended_ = false,
       began_ = false;
};

/// That controller, on a byte link or a CAN interface as the robot's bus is. Throws what opening a
/// link throws.
std::unique_ptr<Served> make_served(Robot& robot, const ServeOptions& options);

/// The two kinds of it.
std::unique_ptr<Served> make_served_on_serial(Robot& robot, const ServeOptions& options);
std::unique_ptr<Served> make_served_on_can(Robot& robot, const ServeOptions& options);

}  // namespace verp::session
