#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/bus_load.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

/// Time of one tick at worst stuffing; the source of the loop's timeouts.
namespace verp::app {

/// Time from SYNC to a drive's answer: an allowance, not a measurement. A slower drive counts as
/// silent.
inline constexpr std::uint32_t kReactionUs = 300;
/// Frames that may precede the last answer to a SYNC: one under way, an SDO answer, an EMCY.
inline constexpr std::uint32_t kForeignFrames = 3;

/// Time of classic frames of `bytes` bytes. Without a baud rate: the maximum.
constexpr std::uint32_t can_frames_us(std::uint8_t bytes, std::uint32_t frames,
                                      std::uint32_t baud) {
  if (baud == 0) return 0xFFFFFFFFu;
  const canopen::FrameBits bits = canopen::classic_bits(bytes, canopen::Stuffing::kWorst) * frames;
  return static_cast<std::uint32_t>((std::uint64_t{bits.all()} * 1'000'000u + baud - 1) / baud);
}

/// From a SYNC until its group has answered. Drives may extend answers to eight bytes.
constexpr std::uint32_t window_us(const Params& params, std::uint8_t group) {
  std::uint32_t answers = group == canopen::plan::sync_groups(params)
                              ? static_cast<std::uint32_t>(canopen::plan::sensor_answers(params))
                              : 0;
  for (int j = 0; j < params.servo_count(); ++j) {
    answers += canopen::plan::group_of_joint(j) == group ? 1u : 0u;
  }
  return can_frames_us(1, 1, params.baud) + kReactionUs +
         can_frames_us(kMaxCanData, answers + kForeignFrames, params.baud);
}

/// Frames of the controller at a tick's end: all goals, controlwords and strengths, two SDO
/// requests, a heartbeat or a third one, and an NMT command.
constexpr std::uint32_t most_sent(int joints) {
  Params params;
  params.joint_count = static_cast<std::uint8_t>(joints);
  return static_cast<std::uint32_t>(shared_frames(canopen::plan::kGoals, params) +
                                    shared_frames(canopen::plan::kWords, params) +
                                    shared_frames(canopen::plan::kStrengths, params)) +
         4;
}

}  // namespace verp::app
