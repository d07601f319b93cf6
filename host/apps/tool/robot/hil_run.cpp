#include "host/apps/tool/robot/hil_run.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/cli/typed_lines.hpp"
#include "host/apps/tool/bit_rate.hpp"

namespace verp::tool {
namespace {

/// "u" and Enter set the robot on its feet.
class Keyboard final : public session::Observer {
 public:
  explicit Keyboard(session::RemoteController*& served) : served_(served) {}
  void tick(std::size_t, session::Robot&) override {
    if (lines_.next() == "u") served_->set_upright();
  }

 private:
  session::RemoteController*& served_;
  cli::TypedLines lines_;
};

}  // namespace

HilResult serve_controller(const WalkPlan& plan, session::ServeOptions options,
                           cli::Progress& progress, std::vector<session::Observer*> observers) {
  const auto say = [&progress](const std::string& line) {
    progress.clear();
    cli::complain("verp hil: " + line);
  };
  options.told = say;
  options.check = [&plan](const link::CanInterface& interface) {
    check_bit_rate("verp hil", interface, plan.params);
  };
  options.real_time_begins = [say] {
    const cli::RealTime got = cli::become_real_time();
    if (!got.advice.empty()) say(got.advice);
  };
  options.cannot_keep_up = cli::leave_real_time;
  session::Session session({.interrupted = cli::interrupted});
  session::RemoteController* served = nullptr;
  RunOnScreen screen(progress, "verp hil");
  Keyboard keyboard(served);
  observers.insert(observers.end(), {&screen, &keyboard});
  std::vector<WalkResult> results =
      session::run(session, {plan}, observers, [&](session::Robot& robot) {
        auto made = session::make_served(robot, options);
        served = made.get();
        return made;
      });
  progress.clear();
  if (!session.diverged().empty()) throw cli::ToolError(cli::kRunFailed, session.diverged());
  return {served->result(), std::move(results.front())};
}

}  // namespace verp::tool
