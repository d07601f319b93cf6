#include "host/run/shadow/tick_listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/drive_objects.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/drive_telemetry.hpp"

namespace verp::shadow {
namespace {

namespace plan = canopen::plan;
namespace published = canopen::published;
using canopen::get_le;

constexpr std::size_t kMostRounds = 2;  // a SYNC may overtake the last report
constexpr std::size_t kMostSaid = 8;
constexpr std::size_t kMostKept = 2;  // each one multiplies the readings

template <class Value>
void say(Said<Value>& said, const Value& value) {
  said.erase(std::remove(said.begin(), said.end(), value), said.end());
  said.insert(said.begin(), value);
  if (said.size() > kMostSaid) said.pop_back();
}

/// Values that a tick did not use may be those of the next: its own are likelier.
template <class Value>
void keep_for(Said<Value>& next, const Said<Value>& unused) {
  for (const Value& value : unused) {
    const bool there = std::find(next.begin(), next.end(), value) != next.end();
    if (!there && next.size() < kMostKept) next.push_back(value);
  }
}

void keep_unused(const HeardTick& tick, HeardTick& next) {
  for (std::size_t j = 0; j < kMaxJoints; ++j) {
    if ((tick.fresh >> j & 1) == 0) keep_for(next.position[j], tick.position[j]);
  }
  // Two frames make one reading: a controller that waits for the second is a tick behind.
  keep_for(next.gyro, tick.gyro);
  keep_for(next.accel, tick.accel);
  for (std::size_t foot = 0; foot < kFeet && (tick.flags & kFeetFresh) == 0; ++foot) {
    keep_for(next.foot[foot], tick.foot[foot]);
  }
}

template <class Word, std::size_t kCount>
std::array<Word, kCount> words(const CanFrame& frame) {
  std::array<Word, kCount> values{};
  for (std::size_t i = 0; i < kCount; ++i) {
    values[i] = static_cast<Word>(get_le(frame.data + 2 * i, 2));
  }
  return values;
}

}  // namespace

TickListener::TickListener(const Params& params) : params_(params), nodes_(params) {}

bool TickListener::next(HeardTick& tick) {
  if (ticks_.empty()) return false;
  tick = std::move(ticks_.front());
  ticks_.pop_front();
  return true;
}

bool TickListener::take_boot() {
  return std::exchange(booted_, false);
}

void TickListener::take(const CanFrame& frame) {
  using canopen::Service;
  if (!canopen::is_canopen(frame)) return;
  const canopen::Connection from = canopen::connection_of(frame.id);
  if (from.service == Service::kSync && frame.size == 1 && frame.data[0] == 1) return begin_round();
  if (from.node == plan::kControllerNode) {
    if (from.service == Service::kTpdo) take_published(from.number, frame);
    if (from.service == Service::kHeartbeat && frame.size == 1 && frame.data[0] == 0) {
      booted_ = true;
    }
    return;
  }
  const int slot = nodes_.slot_of(from.node);
  if (slot < 0) return;
  if (from.service == Service::kTpdo) take_drive(slot, from.number, frame);
  if (from.service == Service::kSdoRequest && app::is_joint(slot)) take_request(slot, frame);
  if (from.service == Service::kSdoResponse && app::is_joint(slot)) take_response(slot, frame);
}

// Values between two ticks may count for the later one.
void TickListener::begin_round() {
  if (rounds_.size() == kMostRounds) drop_oldest();
  Round round;
  round.tick = std::exchange(early_, {});
  rounds_.push_back(std::move(round));
  told_ = false;
}

void TickListener::drop_oldest() {
  ++missed_;
  rounds_.pop_front();
  if (rounds_.empty()) told_ = true;
}

void TickListener::take_drive(int slot, unsigned number, const CanFrame& frame) {
  HeardTick& tick = told_ || rounds_.empty() ? early_ : rounds_.back().tick;
  if (app::is_joint(slot)) {
    if (number != 1 || frame.size < plan::kDriveAnswerBytes) return;
    say(tick.position[static_cast<std::size_t>(slot)],
        static_cast<std::int32_t>(get_le(frame.data + 2, 4)));
  } else if (slot == app::kImuNode) {
    if (number > 2 || frame.size < plan::kImuAnswerBytes) return;
    say(number == 1 ? tick.gyro : tick.accel, words<std::int16_t, 3>(frame));
  } else {
    if (number != 1 || frame.size < plan::kFootAnswerBytes) return;
    say(tick.foot[static_cast<std::size_t>(slot - app::kFootNode)],
        words<std::uint16_t, kFootSensors>(frame));
  }
}

// Requests are those of app::DriveTelemetry.
void TickListener::take_request(int joint, const CanFrame& frame) {
  namespace sdo = canopen::sdo;
  if (frame.size != sdo::kFrameBytes || sdo::specifier_of(frame) != sdo::request::kUpload) return;
  const canopen::Address at = sdo::address_of(frame);
  namespace object = canopen::cia402::object;
  if (!(at == plan::kTelemetry || at == object::kDcLinkVoltage || at == object::kErrorCode)) return;
  if (asked_.joint != joint) asked_.told = {.joint = static_cast<std::uint8_t>(joint)};
  asked_.joint = joint;
  asked_.index = at.index;
}

void TickListener::take_response(int joint, const CanFrame& frame) {
  namespace sdo = canopen::sdo;
  namespace object = canopen::cia402::object;
  if (joint != asked_.joint || frame.size != sdo::kFrameBytes ||
      sdo::address_of(frame).index != asked_.index ||
      sdo::specifier_of(frame) != sdo::response::kUpload) {
    return;
  }
  const auto value = static_cast<std::uint32_t>(get_le(frame.data + 4, 4));
  if (asked_.index == plan::kTelemetry.index) {
    const plan::Telemetry all = plan::Telemetry::from(value);
    asked_.told.voltage_tenth_v = all.voltage_tenth_v;
    asked_.told.temperature_c = all.temperature_c;
    asked_.told.error = all.errors;
  } else if (asked_.index == object::kDcLinkVoltage.index) {
    asked_.told.voltage_tenth_v = static_cast<std::uint16_t>(std::min(value / 100, 0xFFFFu));
    return;
  } else if (asked_.index == object::kErrorCode.index) {
    asked_.told.error = app::hardware_error_of(static_cast<std::uint16_t>(value));
  } else {
    return;
  }
  say(slow_, asked_.told);
}

void TickListener::take_published(unsigned number, const CanFrame& frame) {
  if (number < published::kDigestPdo || frame.size != published::kFrameBytes) return;
  if (number == published::kDigestPdo && !rounds_.empty() && rounds_.front().has_digest) {
    drop_oldest();  // its record was lost
  }
  if (rounds_.empty()) return;
  Round& round = rounds_.front();
  if (number == published::kDigestPdo) {
    round.tick.digest = get_le(frame.data, 8);
    round.has_digest = true;
    return;
  }
  if (number == published::kPartPdo) {
    if (!round.has_record) return;
    round.tick.parts.push_back(published::Part::from(get_le(frame.data, 8)));
    return close_if_whole();
  }
  if (number != published::kRecordPdo) return;
  if (!round.has_digest || round.has_record) return drop_oldest();  // of two different ticks
  round.has_record = true;
  round.tick.tick_low = static_cast<std::uint16_t>(get_le(frame.data, 2));
  round.tick.fresh = static_cast<std::uint32_t>(get_le(frame.data + 2, 4));
  round.tick.flags = static_cast<std::uint16_t>(get_le(frame.data + 6, 2));
  const unsigned parts = round.tick.flags >> published::kPartsShift;
  round.parts_due = parts == published::kTooManyParts ? 0 : parts;
  if ((round.tick.flags & kSlowFresh) != 0) round.tick.slow = std::exchange(slow_, {});
  if (rounds_.size() == 1) told_ = true;
  close_if_whole();
}

void TickListener::close_if_whole() {
  if (rounds_.front().tick.parts.size() < rounds_.front().parts_due) return;
  keep_unused(rounds_.front().tick, rounds_.size() > 1 ? rounds_[1].tick : early_);
  ticks_.push_back(std::move(rounds_.front().tick));
  rounds_.pop_front();
}

namespace {

/// All combinations: each source multiplies the readings.
class Reader {
 public:
  Reader(const Inputs& first, std::size_t most) : readings_{first}, most_(most) {}

  template <class Value, class Put>
  void each(const Said<Value>& said, Put&& put) {
    const std::vector<Inputs> before = std::exchange(readings_, {});
    for (const Value& value : said) {
      for (const Inputs& each : before) {
        if (readings_.size() == most_) return;
        readings_.push_back(each);
        put(readings_.back(), value);
      }
    }
  }
  std::vector<Inputs>& readings() { return readings_; }

 private:
  std::vector<Inputs> readings_;
  std::size_t most_;
};

/// A used value that was not heard; or empty.
std::string find_lacking(const HeardTick& tick, const Params& params) {
  const unsigned parts = tick.flags >> published::kPartsShift;
  if (parts == published::kTooManyParts) return "more changes than the controller tells";
  for (int j = 0; j < kMaxJoints; ++j) {
    if ((tick.fresh >> j & 1) == 0 || !tick.position[static_cast<std::size_t>(j)].empty()) continue;
    return fmt::format("the answer of node {}", app::node_id(params, j));
  }
  const bool imu = (tick.flags & kImuFresh) != 0 && (tick.flags & published::kImuInParts) == 0;
  if (imu && (tick.gyro.empty() || tick.accel.empty())) return "an answer of the IMU";
  for (int foot = 0; foot < kFeet && (tick.flags & kFeetFresh) != 0; ++foot) {
    const bool there = params.feet.device_id[foot] != 0;
    if (there && tick.foot[static_cast<std::size_t>(foot)].empty()) return "the answer of a foot";
  }
  if ((tick.flags & kSlowFresh) != 0 && tick.slow.empty()) return "a drive's telemetry";
  return "";
}

}  // namespace

std::vector<Inputs> readings(const HeardTick& tick, const Inputs& before, const Params& params,
                             std::size_t most, std::string& lacking) {
  lacking = find_lacking(tick, params);
  if (!lacking.empty()) return {};
  Inputs first = before;
  first.tick += static_cast<std::uint16_t>(tick.tick_low - first.tick);
  first.fresh = tick.fresh;
  first.flags = tick.flags & published::kInputsMask;
  Reader reader(first, most);
  for (std::size_t j = 0; j < kMaxJoints; ++j) {
    if ((tick.fresh >> j & 1) == 0) continue;
    reader.each(tick.position[j],
                [j](Inputs& to, std::int32_t count) { to.position_count[j] = count; });
  }
  if ((tick.flags & kImuFresh) != 0 && (tick.flags & published::kImuInParts) == 0) {
    reader.each(tick.gyro, [](Inputs& to, const auto& axes) {
      std::copy(axes.begin(), axes.end(), to.gyro_count);
    });
    reader.each(tick.accel, [](Inputs& to, const auto& axes) {
      std::copy(axes.begin(), axes.end(), to.accel_count);
    });
  }
  for (std::size_t foot = 0; foot < kFeet && (tick.flags & kFeetFresh) != 0; ++foot) {
    if (params.feet.device_id[foot] == 0) continue;
    reader.each(tick.foot[foot], [foot](Inputs& to, const auto& counts) {
      std::copy(counts.begin(), counts.end(), to.foot_count[foot]);
    });
  }
  if ((tick.flags & kSlowFresh) != 0) {
    reader.each(tick.slow, [](Inputs& to, const SlowReport& told) {
      to.slow_joint = told.joint;
      to.slow_temperature_c = told.temperature_c;
      to.slow_error = told.error;
      to.slow_voltage_tenth_v = told.voltage_tenth_v;
    });
  }
  for (Inputs& each : reader.readings()) {
    for (const published::Part& part : tick.parts) {
      if (!part.put(each)) lacking = "a part of no Inputs";
    }
  }
  return lacking.empty() ? std::move(reader.readings()) : std::vector<Inputs>{};
}

}  // namespace verp::shadow
