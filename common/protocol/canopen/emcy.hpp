#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"

/// Emergency messages: CiA 301; the drives' codes are CiA 402's.
namespace verp::canopen {

enum class ErrorCode : std::uint16_t {
  kNoError = 0x0000,  ///< "error reset": see the error register
  kGeneric = 0x1000,
  kOverCurrent = 0x2310,
  kUnderVoltage = 0x3220,
  kOverVoltage = 0x3210,
  kOverTemperature = 0x4310,
  kCommunication = 0x8100,  ///< NMT has stopped the node
  kCanOverrun = 0x8110,
  kErrorPassive = 0x8120,
  kHeartbeatLost = 0x8130,
  kBusOffRecovered = 0x8140,
  kPdoTooShort = 0x8210,  ///< PDO not processed
  kPdoTooLong = 0x8220,   ///< PDO processed
  kSyncLength = 0x8240,
  kFollowingError = 0x8611,
};

/// Bits of the error register, object 1001h.
inline constexpr std::uint8_t kErrorGeneric = 1;
inline constexpr std::uint8_t kErrorVoltage = 4;
inline constexpr std::uint8_t kErrorTemperature = 8;
inline constexpr std::uint8_t kErrorCommunication = 16;
inline constexpr std::uint8_t kErrorProfile = 32;

struct Emergency {
  std::uint8_t node = 0;
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;
  std::uint8_t manufacturer[5] = {};
  constexpr bool operator==(const Emergency&) const = default;
};

constexpr Frame encode_emcy(const Emergency& emergency) {
  Frame frame = classic_frame(emcy_id(emergency.node), 8);
  put_le(frame.data, emergency.code, 2);
  frame.data[2] = emergency.error_register;
  for (unsigned i = 0; i < 5; ++i) frame.data[3 + i] = emergency.manufacturer[i];
  return frame;
}
constexpr bool decode_emcy(const Frame& frame, Emergency& emergency) {
  if (!is_canopen(frame) || frame.size != 8) return false;
  const Connection connection = connection_of(frame.id);
  if (connection.service != Service::kEmcy) return false;
  emergency.node = connection.node;
  emergency.code = static_cast<std::uint16_t>(get_le(frame.data, 2));
  emergency.error_register = frame.data[2];
  for (unsigned i = 0; i < 5; ++i) emergency.manufacturer[i] = frame.data[3 + i];
  return true;
}

/// Object 1003h, newest at subindex 1.
template <std::size_t kEntries>
class ErrorHistory {
 public:
  /// Error code low, manufacturer's information high.
  constexpr void push(std::uint32_t error) {
    for (std::size_t i = kEntries - 1; i > 0; --i) errors_[i] = errors_[i - 1];
    errors_[0] = error;
    if (count_ < kEntries) ++count_;
  }
  constexpr std::uint8_t count() const { return count_; }
  constexpr Abort read(std::uint8_t subindex, std::uint32_t& value) const {
    if (subindex > kEntries) return Abort::kNoSubindex;
    if (subindex > count_) return Abort::kNoData;
    value = subindex == 0 ? count_ : errors_[subindex - 1];
    return Abort::kNone;
  }
  /// Only subindex 0 is writable, with 0: clears all.
  constexpr Abort write(std::uint8_t subindex, std::uint32_t value) {
    if (subindex > kEntries) return Abort::kNoSubindex;
    if (subindex != 0) return Abort::kReadOnly;
    if (value != 0) return Abort::kValueRange;
    count_ = 0;
    return Abort::kNone;
  }

 private:
  std::uint32_t errors_[kEntries] = {};
  std::uint8_t count_ = 0;
};

}  // namespace verp::canopen
