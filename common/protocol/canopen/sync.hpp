#pragma once
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"

/// SYNC with its optional counter (CiA 301, objects 1005h and 1019h).
namespace verp::canopen {

inline constexpr std::uint8_t kMaxSyncCounter = 240;

/// 1019h: 0 (no counter) or 2 to 240.
constexpr Abort check_sync_overflow(std::uint8_t overflow) {
  return overflow == 1 || overflow > kMaxSyncCounter ? Abort::kValueRange : Abort::kNone;
}

/// `counter` 0: none.
constexpr Frame sync_frame(std::uint8_t counter) {
  Frame frame = classic_frame(kSyncId, counter == 0 ? 0 : 1);
  frame.data[0] = counter;
  return frame;
}

enum class SyncSeen : std::uint8_t {
  kNo,
  kSync,         ///< a SYNC of the length in 1019h
  kWrongLength,  ///< of another length: valid, EMCY 8240h is due
};

/// `counter` 0: none.
constexpr SyncSeen read_sync(const Frame& frame, std::uint8_t overflow, std::uint8_t& counter) {
  if (!is_canopen(frame) || frame.id != kSyncId) return SyncSeen::kNo;
  counter = overflow != 0 && frame.size == 1 ? frame.data[0] : std::uint8_t{0};
  const std::uint8_t announced = overflow == 0 ? 0 : 1;
  return frame.size == announced ? SyncSeen::kSync : SyncSeen::kWrongLength;
}

}  // namespace verp::canopen
