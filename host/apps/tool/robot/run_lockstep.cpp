#include "host/apps/tool/robot/run_lockstep.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware/app/lockstep_bus.hpp"
#include "firmware/app/tick_report.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/tool/robot/robot_loop.hpp"

namespace verp::tool {
namespace {

constexpr std::uint64_t kGone_ns = 5'000'000'000;    // then the link stays lost
constexpr std::uint64_t kSilent_ns = 2'000'000'000;  // an idle twin answers at once

/// While waiting for the twin: gives up after a second interrupt, or after kGone_ns without the
/// twin.
struct Waiting {
  link::Link* link;
  bool* answered;             ///< answered, or the user was warned
  std::uint64_t lost_ns = 0;  ///< 0: connected
  std::uint64_t asked_ns = link::monotonic_ns();

  bool operator()() {
    if (cli::presses() > 1) return false;
    if (link->connected()) {
      const bool silent = link::monotonic_ns() > asked_ns + kSilent_ns;
      if (silent && !std::exchange(*answered, true)) {
        cli::complain(
            "verp run: " + link->place() +
            ": nobody answers yet; a twin that another controller drives serves no second one");
      }
      return lost_ns = 0, true;
    }
    if (lost_ns == 0) lost_ns = link::monotonic_ns();
    return link::monotonic_ns() < lost_ns + kGone_ns;
  }
};

class TwinInLockstep {
 public:
  using Bus = app::LockstepBus<link::Link, Waiting>;

  explicit TwinInLockstep(link::Link& link) : link_(link), bus_(link, Waiting{&link, &answered_}) {}

  lockstep::Verdict greet(const Params& params) {
    const lockstep::Verdict verdict = bus_.greet(params);
    answered_ = true;
    return verdict;
  }

  Bus& bus() { return bus_; }
  bool stopped() const { return bus_.stopped(); }
  void set_held(std::uint32_t) {}
  bool connected() const { return link_.connected(); }
  hal::LinkErrors link_errors() const { return link_.errors(); }
  static std::string where(std::uint16_t address) { return fmt::format("register {}", address); }

  void brought_up(const app::BringUpReport&) {}
  void record(const TickRecord&, const State&, const Outputs& outputs) {
    torque_ = outputs.torque_enable != 0;
  }
  void report(const app::LoopHealth&) {}

  // Lockstep loses nothing.
  LetGo let_go(int) const { return torque_ ? LetGo::kNo : LetGo::kYes; }

 private:
  link::Link& link_;
  bool answered_ = false;
  Bus bus_;
  bool torque_ = false;
};

void greet(TwinInLockstep& twin, const RunPlan& plan) {
  const lockstep::Verdict verdict = twin.greet(plan.walk.params);
  if (verdict == lockstep::Verdict::kAccepted) return;
  const std::string where = "verp run: " + link::to_text(plan.link);
  if (cli::interrupted())
    throw cli::ToolError(cli::kRunFailed, where + ": interrupted before a twin answered");
  if (verdict == lockstep::Verdict::kNoAnswer)
    throw cli::ToolError(cli::kNoDevice,
                         where + ": the twin hung up before it answered; start it anew");
  if (verdict == lockstep::Verdict::kNoLockstep)
    throw cli::ToolError(cli::kNoDevice,
                         where + ": that twin runs in real time; leave out --lockstep");
  throw cli::ToolError(cli::kBadInput,
                       where +
                           ": the twin has another robot or core than this controller (it "
                           "says which); give both the same MODEL, --cycle and --set");
}

}  // namespace

RunResult drive_in_lockstep(link::Link& link, const RunPlan& plan, record::TraceWriter* trace,
                            cli::Progress& progress) {
  TwinInLockstep twin(link);
  greet(twin, plan);
  return RobotRun<TwinInLockstep>(twin, plan, {}, trace, progress).run();
}

}  // namespace verp::tool
