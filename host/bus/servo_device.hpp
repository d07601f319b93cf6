#pragma once
#include <cstdint>

#include "host/bus/device.hpp"
#include "host/sim/plant.hpp"

namespace verp::bus {

/// Who a servo is before anybody wrote to it.
struct ServoIdentity {
  std::uint8_t id = 1;
  std::uint16_t model = dxl::kModelXm430W210;
  std::uint32_t baud = 2000000;
  bool fast_sync_read = true;
};

/// One virtual servo: the control table of an X-series or MX(2.0) servo over one joint of a plant.
class ServoDevice final : public Device {
 public:
  ServoDevice(const ServoIdentity& identity, sim::Plant& plant, int joint);

  /// e-Manual, Secondary(Shadow) ID (12): off from 253 on; the ID (7) comes first.
  bool in_group(std::uint8_t id) const override {
    return byte(dxl::address::kSecondaryId) == id && id <= dxl::kMaxId && id != this->id();
  }
  std::uint8_t status_level() const override { return byte(dxl::address::kStatusReturnLevel); }
  bool answers_fast_sync_read() const override { return fast_sync_read_; }
  bool alert() const override { return byte(dxl::address::kHardwareError) != 0; }
  bool torque_on() const override { return byte(dxl::address::kTorqueEnable) != 0; }
  void refresh(std::uint16_t address, std::uint16_t length) override;
  std::uint64_t deadline_us() const override;
  void expire() override;

 private:
  dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data) const override;
  bool within_limits(std::uint16_t address, std::span<const std::uint8_t> data) const;
  void written(std::uint16_t address, std::uint16_t length) override;
  void restarted() override;
  bool moving() override;
  bool tripped() const { return byte(dxl::address::kBusWatchdog) == dxl::kBusWatchdogTripped; }
  std::int32_t homing() const;
  void watch_limits(const sim::ServoMeasurement& measured);
  void apply();

  sim::Plant& plant_;
  int joint_;
  bool fast_sync_read_;
  std::uint8_t mode_ = dxl::kPositionMode;  ///< Operating Mode as last acted upon
  bool goal_written_ = false;
};

}  // namespace verp::bus
