#include "host/twin/imu/bno055_port.hpp"

#include <algorithm>

namespace verp::imu {
namespace {

constexpr std::uint8_t kStart = 0xAA, kData = 0xBB, kStatus = 0xEE;
constexpr std::uint8_t kWritten = 0x01, kWrongStart = 0x06, kOverrun = 0x07, kTooLong = 0x08,
                       kTooShort = 0x09;
constexpr std::size_t kHead = 4, kMost = 128;
constexpr std::uint64_t kForget_us = 30'000;  ///< a request that broke off

}  // namespace

void Bno055Port::take(std::span<const std::uint8_t> bytes, std::uint64_t now_us,
                      std::vector<std::uint8_t>& answer) {
  if (now_us > heard_us_ + kForget_us) inbox_.clear();
  if (!bytes.empty()) heard_us_ = now_us;
  inbox_.insert(inbox_.end(), bytes.begin(), bytes.end());
  while (serve(now_us, answer)) {
  }
}

/// False: no whole request is left. A chip without power says nothing.
bool Bno055Port::serve(std::uint64_t now_us, std::vector<std::uint8_t>& answer) {
  if (inbox_.empty()) return false;
  if (inbox_[0] != kStart) {
    inbox_.clear();
    answer.insert(answer.end(), {kStatus, kWrongStart});
    return false;
  }
  if (inbox_.size() < kHead) return false;
  const bool reads = inbox_[1] == 1;
  const std::uint8_t address = inbox_[2];
  const std::size_t size = inbox_[3], whole = kHead + (reads || size > kMost ? 0 : size);
  if (inbox_.size() < whole) return false;
  const std::vector<std::uint8_t> sent(inbox_.begin() + kHead,
                                       inbox_.begin() + static_cast<std::ptrdiff_t>(whole));
  inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(whole));
  std::uint8_t data[kMost];
  if (size == 0 || size > kMost || overruns > 0) {
    const bool refused = size > 0 && size <= kMost;
    overruns -= refused ? 1 : 0;
    answer.insert(answer.end(), {kStatus, refused ? kOverrun : size == 0 ? kTooShort : kTooLong});
  } else if (reads && model_.read(address, data, size, now_us)) {
    answer.insert(answer.end(), {kData, static_cast<std::uint8_t>(size)});
    answer.insert(answer.end(), data, data + size);
  } else if (!reads && model_.write(address, sent.data(), size, now_us)) {
    answer.insert(answer.end(), {kStatus, kWritten});
  }
  return true;
}

}  // namespace verp::imu
