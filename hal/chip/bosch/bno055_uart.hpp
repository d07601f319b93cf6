#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/byte_link.hpp"
#include "hal/contract/register_bus.hpp"

namespace verp::hal::bosch {

/// A BNO055's registers over its UART, 115200 baud, PS1 high and PS0 low (BST-BNO055-DS000, section
/// 4.7). A request that comes while the chip is busy is refused with BUS_OVER_RUN: asked again.
template <class Clock>
class Bno055Uart final : public RegisterBus {
 public:
  static constexpr std::uint32_t kBaud = 115'200;

  Bno055Uart(ByteLink& link, const Clock& clock) : link_(link), clock_(clock) {}

  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size) override {
    const std::uint8_t request[] = {kStart, 1, address, static_cast<std::uint8_t>(size)};
    return size <= kMost && ask(request, sizeof request, data, size);
  }
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size) override {
    if (size > kMost) return false;
    std::uint8_t request[4 + kMost] = {kStart, 0, address, static_cast<std::uint8_t>(size)};
    for (std::size_t i = 0; i < size; ++i) request[4 + i] = data[i];
    return ask(request, 4 + size, nullptr, 0);
  }

 private:
  static constexpr std::uint8_t kStart = 0xAA, kData = 0xBB, kStatus = 0xEE;
  static constexpr std::uint8_t kWritten = 1;
  /// Refusals that say nothing about the request: READ_FAIL, WRITE_FAIL, WRONG_START_BYTE,
  /// BUS_OVER_RUN, RECEIVE_CHARACTER_TIMEOUT.
  static constexpr std::uint32_t kTransient = 1u << 2 | 1u << 3 | 1u << 6 | 1u << 7 | 1u << 10;
  static constexpr std::size_t kMost = 128;
  static constexpr int kTries = 4;
  /// Bytes take 0.1 ms each; an FTDI adapter keeps them for up to 16 ms, there and back.
  static constexpr std::uint64_t kAnswer_us = 35'000;

  bool ask(const std::uint8_t* request, std::size_t size, std::uint8_t* data, std::size_t wanted) {
    for (int i = 0; i < kTries; ++i) {
      std::uint8_t rest[64];
      while (link_.read(rest, sizeof rest, 0) > 0) {
      }
      if (link_.write(request, size, static_cast<std::uint32_t>(kAnswer_us)) != size) return false;
      const std::uint8_t said = answer(data, wanted);
      if (said == kWritten) return true;
      if (said > 31 || (kTransient >> said & 1) == 0) return false;
    }
    return false;
  }

  /// The status; kWritten also for all bytes of a read; 0: silence, or nonsense.
  std::uint8_t answer(std::uint8_t* data, std::size_t wanted) {
    const std::uint64_t deadline_us = clock_.now_us() + kAnswer_us;
    std::uint8_t head[2];
    if (!take(head, 2, deadline_us)) return 0;
    if (head[0] == kStatus) return wanted > 0 && head[1] == kWritten ? 0 : head[1];
    if (head[0] != kData || wanted == 0 || head[1] != wanted) return 0;
    return take(data, wanted, deadline_us) ? kWritten : 0;
  }
  bool take(std::uint8_t* data, std::size_t size, std::uint64_t deadline_us) {
    while (size > 0) {
      const std::uint64_t now_us = clock_.now_us();
      if (now_us >= deadline_us) return false;
      const std::size_t count =
          link_.read(data, size, static_cast<std::uint32_t>(deadline_us - now_us));
      data += count;
      size -= count;
    }
    return true;
  }

  ByteLink& link_;
  const Clock& clock_;
};

}  // namespace verp::hal::bosch
