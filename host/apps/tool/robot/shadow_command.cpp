#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/bit_rate.hpp"
#include "host/apps/tool/robot/action_words.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/run_params.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/os/link/can_claim.hpp"
#include "host/os/link/can_port.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/shadow/live_check.hpp"
#include "host/run/shadow/polled_check.hpp"

namespace verp::tool {
namespace {

struct ShadowWords {
  std::string model, bus, link;
  RunParams params;
  WalkOptions tuning;     ///< only its tuning is used
  double for_s = 0;       ///< 0: until an interrupt
  double patience_s = 5;  ///< with a silent controller
  bool json = false;
};

/// The robot on the named bus, or on its first bus of the link's kind.
model::Entity robot_on(const ShadowWords& words, bool can) {
  const std::string file = model::find_model(words.model);
  if (!can) return model::load_robot(file, words.bus);  // any bus gives the same
  model::Entity entity = model::load_robot_on_can(file, words.bus);
  if (entity.protocol == BusProtocol::kCia402) {
    model::require_bus(entity, model::make_params(entity));
    return entity;
  }
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp shadow: {}: the bus of {} speaks {}, and {} is a CAN interface; "
                  "name another of its buses with --bus",
                  entity.file, entity.name, model::protocol_name(entity.protocol), words.link));
}

/// Listens on the bus of the controller's drives.
class CanSide {
 public:
  static constexpr const char* kRemedy =
      "is it running, on this bus, with a node of its own that keeps ticks?";
  CanSide(const std::string& link, const Params& params, const action::Library& own)
      : port_(link::parse_endpoint(link)),
        claim_(port_.interface().name, "watcher", link::CanClaim::kWatcher),
        check(params, own) {
    check_bit_rate("verp shadow", port_.interface(), params);
  }
  void turn() {
    CanFrame frame;
    if (port_.await(frame, kIdle_us)) check.take(frame, port_.now_us());
    while (check.next(frame, port_.now_us()) && port_.send(frame)) {
    }
  }
  std::uint64_t now_us() { return port_.now_us(); }
  bool connected() const { return port_.connected(); }

 private:
  static constexpr std::uint32_t kIdle_us = 20'000;  ///< longest delay of Ctrl-C
  link::CanPort port_;
  link::CanClaim claim_;

 public:
  shadow::LiveCheck check;
};

/// Fetches ticks from the operator port.
class SerialSide {
 public:
  static constexpr const char* kRemedy =
      "is it running, is this its operator's port, and is no other program using it?";
  SerialSide(const std::string& link, const Params& params, const action::Library& own)
      : port_(link::parse_endpoint(link)), check(params, port_, own) {}
  void turn() {
    if (!check.turn(now_us())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::uint64_t now_us() const { return (link::monotonic_ns() - opened_ns_) / 1000; }
  bool connected() const { return port_.connected(); }

 private:
  shadow::TickPort port_;
  std::uint64_t opened_ns_ = link::monotonic_ns();

 public:
  shadow::PolledCheck check;
};

template <class Side>
class ShadowRun {
 public:
  ShadowRun(const ShadowWords& words, const Params& params, const action::Library& own)
      : words_(words), params_(params), progress_(!words.json), side_(words.link, params_, own) {}

  int run() {
    say(fmt::format("looking for the controller of {} on {}", params_.name, words_.link));
    while (!check_.over() && !enough() && !cli::interrupted() && failure_.empty()) {
      side_.turn();
      watch(side_.now_us());
    }
    progress_.clear();
    if (failure_.empty()) failure_ = check_.refusal();
    if (check_.suspects()) say("the end came while a digest that differs was looked into");
    words_.json ? cli::print_json(to_json()) : cli::answer(to_text());
    if (!failure_.empty()) {
      cli::complain("verp shadow: " + failure_);
      return check_.refusal().empty() ? cli::kNoDevice : cli::kBadInput;
    }
    if (check_.unsettled() > 0) {
      say(fmt::format("{} digests differed that could not be looked into in time",
                      check_.unsettled()));
    }
    const bool good =
        !check_.over() && !check_.suspects() && check_.unsettled() == 0 && check_.compared() > 0;
    return good ? cli::kGood : cli::kRunFailed;
  }

 private:
  bool enough() const {
    return words_.for_s > 0 &&
           check_.compared() >=
               static_cast<std::uint64_t>(std::ceil(words_.for_s * 1e6 / params_.period_us));
  }

  void say(const std::string& line) {
    progress_.clear();
    cli::complain("verp shadow: " + line);
  }

  void watch(std::uint64_t now_us) {
    if (side_.connected() != connected_) {
      connected_ = side_.connected();
      say(connected_ ? "the link is back" : "the link is lost; waiting for it to come back");
    }
    if (check_.gaps() != gaps_ && gaps_ < kMostTold) {
      gaps_ = check_.gaps();
      say(check_.gap() + "; asking the controller for its State anew" +
          (gaps_ == kMostTold ? " (the next ones are counted only)" : ""));
    }
    const std::uint64_t heard_us = check_.heard_us();
    if (static_cast<double>(now_us - std::min(heard_us, now_us)) > words_.patience_s * 1e6) {
      failure_ =
          fmt::format("{} for {} s on {}; {}",
                      heard_us == 0 ? "no controller was heard" : "the controller has said nothing",
                      words_.patience_s, words_.link, Side::kRemedy);
    }
    progress_.show(words_.for_s > 0 ? static_cast<double>(check_.compared()) * params_.period_us *
                                          1e-6 / words_.for_s
                                    : 0,
                   fmt::format("tick {}, {} compared", check_.tick(), check_.compared()));
  }

  std::string divergence() const {
    return record::text(check_.divergence(), params_, "controller", "PC");
  }

  cli::Json to_json() const {
    cli::Json json = {{"model", params_.name},
                      {"link", words_.link},
                      {"compared_ticks", check_.compared()},
                      {"tick", nullptr},  // last compared; null: none
                      {"digest", nullptr},
                      {"gaps", check_.gaps()},
                      {"controller_resets", check_.boots()},
                      {"unsettled", check_.unsettled()},
                      {"differs", check_.differs()},
                      {"failure", failure_}};
    if (check_.compared() > 0) {
      json["tick"] = check_.tick();
      json["digest"] = fmt::format("0x{:016x}", check_.digest());
    }
    if (!check_.differs()) return json;
    const record::Divergence& found = check_.divergence();
    json["difference"] = {{"tick", found.tick}, {"stage", found.stage}, {"text", divergence()}};
    if (!found.fields.empty()) json["difference"]["field"] = found.fields.front().path;
    return json;
  }

  std::string to_text() const {
    std::string out;
    if (check_.differs()) {
      out = fmt::format("{}: not the same bits: {}\n", params_.name, divergence());
    } else if (check_.compared() > 0) {
      out = fmt::format("{}: the same bits in all {} ticks compared, up to tick {}: 0x{:016x}\n",
                        params_.name, check_.compared(), check_.tick(), check_.digest());
    } else {
      out = fmt::format("{}: no tick was compared\n", params_.name);
    }
    if (check_.gaps() > 0) {
      out += fmt::format("  {:<18}{} times ticks were not heard whole, and not compared\n", "gaps",
                         check_.gaps());
    }
    return out;
  }

  static constexpr std::uint64_t kMostTold = 5;

  const ShadowWords& words_;
  const Params& params_;
  cli::Progress progress_;
  Side side_;
  decltype(Side::check)& check_ = side_.check;
  std::string failure_;
  std::uint64_t gaps_ = 0;
  bool connected_ = true;
};

/// Includes the changes given to `verp run`.
Params params_of(const ShadowWords& words, const model::Entity& entity) {
  Params params = model::make_params(entity);
  scenario::tune(tuning_of(words.tuning), params.tuning);
  apply_run_params(words.params, params);
  return params;
}

int run_shadow(const ShadowWords& words) {
  const bool can = link::parse_endpoint(words.link).kind == link::Endpoint::Kind::kCan;
  const model::Entity entity = robot_on(words, can);
  const Params params = params_of(words, entity);
  const action::CompiledActions made = make_actions(entity, params, "");
  const action::Library own = made.library();
  return can ? ShadowRun<CanSide>(words, params, own).run()
             : ShadowRun<SerialSide>(words, params, own).run();
}

}  // namespace

cli::Subcommand add_shadow(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "shadow");
  auto words = std::make_shared<ShadowWords>();
  cli::add_model(*app, words->model)->required();
  app->add_option(
         "--link", words->link,
         "can:INTERFACE, the bus of its drives; or its operator's port: serial:DEVICE@BAUD, "
         "pty:PATH, tcp:HOST:PORT or unix:PATH")
      ->required();
  cli::add_bus_option(*app, words->bus);
  app->add_option("--for", words->for_s, "end after so much of the robot's time was compared, s")
      ->check(cli::number_between(0.01, 1e6, "s"));
  app->add_option("--patience", words->patience_s, "give up when nothing was heard for so long, s")
      ->check(cli::number_between(0.1, 1e6, "s"))
      ->capture_default_str();
  declare_run_params(*app, words->params);
  words->tuning.command = "verp shadow";
  declare_tuning(*app, words->tuning);
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return run_shadow(*words);
          }};
}

}  // namespace verp::tool
