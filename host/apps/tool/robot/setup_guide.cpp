#include "host/apps/tool/robot/setup_guide.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::tool {
namespace {

constexpr std::int32_t kMoved = 60;  // counts, 5 degrees: above tremor

/// Direction of the right thumb for a positive turn. Robots face x; y is their left, z up.
std::string thumb(const JointParams& joint) {
  constexpr const char* kWords[] = {"ahead", "to its left", "up", "back", "to its right", "down"};
  const auto kind = static_cast<std::size_t>(joint.axis_kind);
  if (kind < std::size(kWords)) return kWords[kind];
  return fmt::format("along ({:.2f} {:.2f} {:.2f}), x ahead, y left, z up", joint.axis.x,
                     joint.axis.y, joint.axis.z);
}

void add_todo(cli::Json& entry, const std::string& what) {
  const std::string before = entry.value("todo", "");
  entry["todo"] = before.empty() ? what : before + "; " + what;
}

}  // namespace

SetupGuide::SetupGuide(const Params& params, const link::Endpoint& endpoint,
                       const SetupChoice& choice, SetupReport& report, cli::Answers& answers)
    : params_(params),
      line_(endpoint, params.baud, params.bus_protocol),
      choice_(choice),
      report_(report),
      answers_(answers) {}

SetupGuide::Answer SetupGuide::ask(const std::string& question) {
  for (;;) {
    const auto word = answers_.line(question);
    if (!word || *word == "q") throw Stop{};
    if (word->empty()) return Answer::kGoOn;
    if (*word == "s") return Answer::kSkip;
    cli::complain("  Enter alone goes on, s skips, q ends");  // the rest may write EEPROM
  }
}

bool SetupGuide::run() {
  bool all = true;
  bool open = false;
  try {
    for (int j = 0; j < params_.servo_count(); ++j) {
      const std::string name = params_.joint[j].name;
      const bool wanted = choice_.joint.empty() ? !report_.done(name) : choice_.joint == name;
      if (!wanted) continue;
      if (!open) line_.at(params_.baud);  // before the user connects a servo
      open = true;
      all = joint(j) && all;
    }
    return all;
  } catch (const Stop&) {
    cli::complain("verp bus setup: stopped; the same command goes on from here");
    return false;
  }
}

bool SetupGuide::joint(int index) {
  const JointParams& joint = params_.joint[index];
  cli::complain(fmt::format(
      "\n{} ({} of {}): id {}, {}", joint.name, index + 1, params_.servo_count(), joint.servo_id,
      bus::model_name(params_.servo[joint.servo_profile].model_number, params_.bus_protocol)));
  const char* question = choice_.wired ? "Press Enter to begin (s skips the joint, q ends): "
                                       : "Connect its servo alone and power it, then press Enter "
                                         "(s skips the joint, q ends): ";
  while (ask(question) == Answer::kGoOn) {
    cli::Json entry = begun(joint);
    try {
      set_up(joint, entry);
      return !entry.contains("todo");
    } catch (const bus::DeviceError& error) {
      cli::complain(std::string("  ") + error.what());
      if (entry.contains("found") && !choice_.dry_run) {  // a write may have failed half-way
        entry["error"] = error.what();
        report_.keep(joint.name, entry);
      }
      question = "Press Enter to try again (s skips the joint, q ends): ";
    }
  }
  skip(joint);
  return false;
}

cli::Json SetupGuide::begun(const JointParams& joint) const {
  cli::Json entry = {{"outcome", "begun"}, {"id", joint.servo_id}, {"changes", cli::Json::array()}};
  const cli::Json before = report_.of(joint.name);
  if (!choice_.dry_run && !report_.done(joint.name) && before.contains("changes")) {
    entry["changes"] = before.at("changes");
  }
  return entry;
}

void SetupGuide::set_up(const JointParams& joint, cli::Json& entry) {
  bus::FoundServo servo = meet(joint);
  entry["found"] = {{"id", servo.identity.id}, {"baud", servo.baud}};
  bus::configure(
      line_, servo, joint.servo_id, params_.baud, choice_.dry_run, [&](const bus::Change& change) {
        note(joint, change, entry);
        cli::complain(fmt::format("  {} {} to {}", change.name, change.before, change.after));
      });
  bus::Client& client = line_.at(servo.baud);
  measure_zero(joint, client, servo.identity.id, entry);
  check_direction(joint, client, servo.identity.id, entry);
  entry["outcome"] = choice_.dry_run ? "dry run" : entry.contains("todo") ? "to do" : "done";
  report_.keep(joint.name, entry);
  cli::complain(fmt::format("  {}", entry.at("outcome").get<std::string>()));
}

void SetupGuide::note(const JointParams& joint, const bus::Change& change, cli::Json& entry) {
  entry["changes"].push_back(
      {{"register", change.name}, {"before", change.before}, {"after", change.after}});
  if (!choice_.dry_run) report_.keep(joint.name, entry);
}

void SetupGuide::skip(const JointParams& joint) {
  if (report_.done(joint.name)) return;  // stays done
  cli::Json entry = report_.of(joint.name);
  entry["outcome"] = "skipped";
  entry["id"] = joint.servo_id;
  report_.keep(joint.name, entry);
}

bus::FoundServo SetupGuide::meet(const JointParams& joint) {
  bus::FoundServo servo;
  if (choice_.wired) {
    const auto identity = line_.at(params_.baud).ping(joint.servo_id);
    if (!identity) {
      throw bus::DeviceError(
          fmt::format("device {} does not answer; check power and wiring, or "
                      "set it up alone, without --wired",
                      joint.servo_id));
    }
    servo = {*identity, params_.baud};
  } else {
    const auto found = line_.find([] { return cli::interrupted(); });
    if (cli::interrupted()) throw Stop{};
    if (found.empty())
      throw bus::DeviceError("no servo answers at any rate; check power and wiring");
    if (found.size() > 1) {
      throw bus::DeviceError(
          fmt::format("{} devices answer (ids {} and {} among them); leave only "
                      "this joint's servo connected",
                      found.size(), found[0].identity.id, found[1].identity.id));
    }
    servo = found[0];
  }
  cli::complain(fmt::format("  found: id {} at {} baud, {}", servo.identity.id, servo.baud,
                            bus::model_name(servo.identity.model, params_.bus_protocol)));
  const std::uint16_t wanted = params_.servo[joint.servo_profile].model_number;
  if (servo.identity.model != wanted) {
    throw bus::DeviceError(fmt::format(
        "it is a {}, the model wants a {}: take the right servo, or correct its type in the model",
        bus::model_name(servo.identity.model, params_.bus_protocol),
        bus::model_name(wanted, params_.bus_protocol)));
  }
  return servo;
}

void SetupGuide::measure_zero(const JointParams& joint, bus::Client& client, std::uint8_t id,
                              cli::Json& entry) {
  const bool stiff = bus::is_stiff(client, id);
  if (ask(fmt::format(
          "  Zero: {}. Put {} where the model has its angle 0, hold it, Enter "
          "(s leaves the zero as it is): ",
          stiff ? "torque is on, a dry run leaves it so: don't force the joint" : "torque is off",
          joint.name)) == Answer::kSkip) {
    return add_todo(entry, "measure the zero");
  }
  const auto model_count = static_cast<std::int32_t>(std::lround(joint.zero_count));
  const bus::ZeroFix fix = bus::zero_fix(client, id, bus::still_position(client, id), model_count);
  entry["zero"] = {{"count", fix.count},
                   {"model_offset", model_count},
                   {"homing_before", fix.homing_before},
                   {"homing_after", fix.servo_can ? fix.homing_after : fix.homing_before}};
  if (!fix.servo_can) {
    cli::complain(
        fmt::format("  at zero it reads {}, the model says {}: too far for the servo's Homing "
                    "Offset (it would be {})",
                    fix.count, model_count, fix.homing_after));
    return add_todo(entry, fmt::format("turn the horn, or set offset=\"{}\" of {} in the model",
                                       fix.model_offset, joint.name));
  }
  cli::complain(
      fmt::format("  at zero it reads {}, the model says {}: Homing Offset {} to {}, in the "
                  "servo{}",
                  fix.count, model_count, fix.homing_before, fix.homing_after,
                  choice_.dry_run ? " (not written)" : ""));
  if (!choice_.dry_run && fix.homing_after != fix.homing_before) {
    bus::write_homing(client, id, fix);
    note(joint, {"homing_offset", fix.homing_before, fix.homing_after}, entry);
  }
}

void SetupGuide::check_direction(const JointParams& joint, bus::Client& client, std::uint8_t id,
                                 cli::Json& entry) {
  const std::int32_t from = bus::still_position(client, id);
  std::int32_t moved = 0;
  while (std::abs(moved) < kMoved) {
    if (ask(fmt::format("  Direction: turn {} by 10 degrees or more its positive way (right hand's "
                        "thumb {}: the fingers show it), hold it, Enter: ",
                        joint.name, thumb(joint))) == Answer::kSkip) {
      return add_todo(entry, "check the direction");
    }
    moved = bus::still_position(client, id) - from;
    if (std::abs(moved) < kMoved) {
      cli::complain(fmt::format("  it moved by {} counts only: turn it further", moved));
    }
  }
  const bool right = (moved > 0) == (joint.counts_per_rad > 0);
  entry["direction"] = {{"moved", moved}, {"right", right}};
  cli::complain(
      fmt::format("  {} counts: the direction is {}", moved, right ? "right" : "not the model's"));
  if (!right) {
    add_todo(entry, fmt::format("set direction=\"{}\" of {} in the model",
                                joint.counts_per_rad > 0 ? -1 : 1, joint.name));
  }
}

}  // namespace verp::tool
