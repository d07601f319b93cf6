#pragma once
#include <concepts>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/bus_counters.hpp"
#include "firmware/app/joint_effort.hpp"

namespace verp::app {

/// A robot's servos and the sensors on their bus, in one protocol. Promises:
///  - bring_up(): sets up every device; torque is off afterwards, also on failure.
///  - read_positions(inputs): begins the tick on the bus. Sets position_count and the fresh bit of
///    each servo that answered in this tick and holds as commanded; leaves the others unchanged.
///  - read_sensors(inputs, imu): IMU (only if `imu`), feet, and slow telemetry of at most one
///    servo, each with its flag. Missing data leaves its counts unchanged.
///  - heard_nothing_for(us): servos may have received nothing for this long before this tick.
///  - send(outputs): goals, strength and torque. Never enables torque on a servo that may not know
///    its goal or may have lost its set-up. All servos get one tick's outputs; if the bus lost
///    some, those of a tick soon after.
///  - limit_torque(percent): of every servo's strength from the next send() on; 1 to 100.
///  - now_us(): bus time; after read_positions(), when that ended.
///  - counters(), damaged(), noise(): errors so far. damaged: packets or frames in pieces; noise:
///    bytes or frames that came to nothing.
///  - efforts(): of kMaxJoints joints, from time to time; null if the protocol lacks them.
/// A lost, late or foreign answer never blocks a tick beyond its timeout and never counts as an
/// answer. No call allocates.
template <class Servos>
concept ServoBinding = requires(Servos& servos, const Servos& seen, Inputs& inputs,
                                const Outputs& outputs, std::uint64_t time_us, std::uint8_t percent,
                                bool imu) {
  { servos.bring_up() } -> std::same_as<BringUpReport>;
  { servos.read_positions(inputs) } -> std::same_as<void>;
  { servos.read_sensors(inputs, imu) } -> std::same_as<void>;
  { servos.heard_nothing_for(time_us) } -> std::same_as<void>;
  { servos.send(outputs) } -> std::same_as<void>;
  { servos.limit_torque(percent) } -> std::same_as<void>;
  { servos.now_us() } -> std::same_as<std::uint64_t>;
  { seen.counters() } -> std::same_as<const BusCounters&>;
  { seen.damaged() } -> std::same_as<std::uint32_t>;
  { seen.noise() } -> std::same_as<std::uint32_t>;
  { seen.efforts() } -> std::same_as<const JointEffort*>;
};

/// An operator's part of one tick's Inputs.
struct OperatorOrder {
  Command command;          ///< stands until the next
  std::uint16_t flags = 0;  ///< kEmergencyStop, kCommandFresh, kParameterWrite; others ignored
  std::uint16_t parameter_id = 0;    ///< with kParameterWrite
  std::uint32_t parameter_bits = 0;  ///< with kParameterWrite
  std::uint16_t mailbox = 0;
  std::uint16_t action = 0;  ///< 0: none
  VERP_FIELDS(command, flags, parameter_id, parameter_bits, mailbox, action)
};
static_assert(packed_size<OperatorOrder>() == sizeof(OperatorOrder));

/// order(tick) returns the operator's wishes without waiting. The loop calls it exactly once a
/// tick, after the bus read. Ticks rise but may skip (an overrun).
template <class Link>
concept OperatorLink = requires(Link& link, std::uint32_t tick) {
  { link.order(tick) } -> std::same_as<OperatorOrder>;
};

/// The pacing clock's report on the tick that begins.
struct Beat {
  std::uint32_t periods = 0;  ///< since the previous tick; 0: no clock, use bus time
  bool overran = false;       ///< the previous tick was late
};

/// Takes each tick after its goals were sent. Never waits longer than a tick can spare and never
/// allocates on a microcontroller.
template <class Sink>
concept Recorder = requires(Sink& sink, const TickRecord& record, const State& state,
                            const Outputs& outputs) {
  { sink.record(record, state, outputs) } -> std::same_as<void>;
};

}  // namespace verp::app
