#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "host/author/action/robotis.hpp"

/// A page of 512 bytes. Source: ROBOTIS' framework, op3_action_module's action_file_define.h.
namespace verp::action {

namespace page {

// In a page's header.
inline constexpr std::size_t kName = 0, kNameBytes = 14, kRepeat = 15, kSchedule = 16,
                             kStepCount = 20, kSpeed = 22, kAccel = 24, kNext = 25, kExit = 26,
                             kChecksum = 31, kGain = 32;
inline constexpr std::size_t kStepBytes = 64, kPause = 62, kTime = 63;
inline constexpr std::uint16_t kInvalid = 0x4000, kTorqueOff = 0x2000, kCount = 0x0FFF;
inline constexpr std::uint16_t kUnused = 0x9000;
inline constexpr double kUnit_s = 0.0078;  // unit of times
inline constexpr int kNormalSpeed = 32;

inline std::size_t step_at(std::size_t step) {
  return kStepBytes * (step + 1);
}

inline std::uint16_t word(const Page& page, std::size_t at) {
  return static_cast<std::uint16_t>(page[at] | page[at + 1] << 8);
}
inline void put_word(Page& page, std::size_t at, int value) {
  page[at] = static_cast<std::uint8_t>(value);
  page[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

inline double unit_s(const Page& page) {
  return kUnit_s * kNormalSpeed / std::max<int>(page[kSpeed], 1);
}

}  // namespace page

FrameText frame_of_page(const Params& params, const Page& page, std::size_t step);

}  // namespace verp::action
