#pragma once
#include <cstdint>

namespace verp::bus {

/// A device on a serial line, whatever its protocol.
class BusDevice {
 public:
  BusDevice() = default;
  virtual ~BusDevice() = default;
  BusDevice(const BusDevice&) = delete;
  BusDevice& operator=(const BusDevice&) = delete;

  virtual std::uint8_t id() const = 0;
  /// Its port runs at this rate.
  virtual bool runs_at(std::uint32_t baud) const = 0;
  /// From a request to the answer.
  virtual std::uint32_t return_delay_us() const = 0;
  virtual bool torque_on() const { return false; }

  /// A request for any device ended at `time_us`.
  void heard(std::uint64_t time_us) { heard_us_ = time_us; }
  /// Time of the device's own next action.
  virtual std::uint64_t deadline_us() const { return kNever_us; }
  virtual void expire() {}

  virtual void lose_power() = 0;
  virtual void reboot() = 0;

 protected:
  static constexpr std::uint64_t kNever_us = ~std::uint64_t{0};
  std::uint64_t heard_us_ = 0;
};

}  // namespace verp::bus
