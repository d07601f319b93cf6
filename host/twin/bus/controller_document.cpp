#include <fmt/format.h>

#include <iterator>

#include "common/model/tuning_ranges.hpp"
#include "common/safety/machine.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::bus {
namespace {

using namespace dxl::controller;

std::string range_of(const Register& each) {
  if (!each.writable()) return "";
  if (each.minimum < 0) {
    return fmt::format("{}..{}", each.minimum, static_cast<std::int32_t>(each.maximum));
  }
  if (each.type == Type::kF32) return "its range";
  return fmt::format("{}..{}", each.minimum, each.maximum);
}

void put_registers(std::back_insert_iterator<std::string> out) {
  fmt::format_to(out,
                 "| Address | Register | Type | Access | Range | Unit | Meaning | CANopen |\n"
                 "|---|---|---|---|---|---|---|---|\n");
  for (const Register& each : kTable) {
    const std::string type =
        each.count == 1
            ? kTypeNames[static_cast<int>(each.type)]
            : fmt::format("{}[{}]", kTypeNames[static_cast<int>(each.type)], each.count);
    fmt::format_to(out, "| {} | `{}` | {} | {} | {} | {} | {} | {:04X}h |\n", each.address,
                   each.name, type, kAccessNames[static_cast<int>(each.access)], range_of(each),
                   each.unit, each.meaning, each.object_index());
  }
}

void put_parameters(std::back_insert_iterator<std::string> out) {
  fmt::format_to(out,
                 "| parameter_id | Number | Lowest | Highest | Default |\n|---|---|---|---|---|\n");
  const Tuning tuning;
  int id = 0;
  Tuning::fields(tuning, [&](const char* group, const auto& part) {
    part.fields(part, [&](const char* name, const float& value) {
      const Range& range = kTuningRanges[id];
      fmt::format_to(out, "| {} | `{}.{}` | {:g} | {:g} | {:g} |\n", id, group, name, range.low,
                     range.high, value);
      ++id;
    });
  });
}

}  // namespace

std::string controller_document() {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "# The controller's registers\n\n"
                 "Written by `verp bus registers` from `common/protocol/controller_table.hpp`; a "
                 "test compares it.\n\n"
                 "The controller is a Dynamixel Protocol 2.0 device on the operator's port, id {} "
                 "unless it was changed, model {}. Integers are little-endian. A write is done "
                 "whole or not at all; what it may get: Data Range Error (a value out of range), "
                 "Data Length Error (part of a register), Access Error (read-only, no register, or "
                 "not while a servo holds torque), Data Limit Error (a block beyond the image), "
                 "Result Fail (not now). Bytes between registers read as 0.\n\n",
                 kDefaultId, kModel);
  put_registers(out);
  fmt::format_to(out,
                 "\nEach register is a CANopen object too, at index 2000h + address; elements "
                 "of an array have subindices from 1 on.\n\n## Numbers of the tuning\n\n");
  put_parameters(out);
  fmt::format_to(
      out,
      "\n## A new Params image, new actions\n\n"
      "Write `window_kind` 1, of actions 2; then `window_offset` and `window_data` of each block "
      "together; then `window_crc`; with torque off `window_commit` 1. "
      "`window_state` says what became of it. It is in force from the next start "
      "(Reboot). Blocks may come in any order, and more than once. Actions are those of "
      "`verp action export`, with the mark of the robot in force; `verp action send` "
      "does all of it. What is not committed counts for nothing.\n");
  return text;
}

}  // namespace verp::bus
