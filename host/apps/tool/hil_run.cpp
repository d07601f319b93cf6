#include "host/apps/tool/hil_run.hpp"

#include <memory>
#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/cli/typed_lines.hpp"
#include "host/apps/tool/bit_rate.hpp"

namespace verp::tool {

HilResult serve_controller(const WalkPlan& plan, session::ServeOptions options,
                           record::TraceWriter* trace, cli::Progress& progress, bool keep_series) {
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
  session::Served* served = nullptr;
  session::Hooks hooks = shown(plan, trace, progress, plan.params.name, keep_series);
  tell_falls(plan, progress, "verp hil", hooks);
  session.add(plan, std::move(hooks), [&](session::Robot& robot) {
    auto made = session::make_served(robot, options);
    served = made.get();
    return made;
  });
  cli::TypedLines typed;
  while (session.tick() != nullptr) {
    if (typed.next() == "u") served->set_upright();
  }
  progress.clear();
  HilResult result{served->result(), {}};
  result.walk = session.result(0);
  return result;
}

}  // namespace verp::tool
