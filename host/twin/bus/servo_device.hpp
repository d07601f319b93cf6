#pragma once
#include <cstdint>

#include "host/twin/bus/device.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

struct ServoIdentity {
  std::uint8_t id = 1;
  std::uint16_t model = dxl::kModelXm430W210;
  std::uint32_t baud = 2000000;
  bool fast_sync_read = true;
  sim::ServoRating rating{};
};

/// An X-series or MX(2.0) servo for one joint of a plant.
class ServoDevice final : public Device {
 public:
  ServoDevice(const ServoIdentity& identity, sim::Plant& plant, int joint);

  /// e-Manual, Secondary(Shadow) ID (12): off from 253; the ID (7) has priority.
  bool in_group(std::uint8_t id) const override {
    return byte(dxl::address::kSecondaryId) == id && id <= dxl::kMaxId && id != this->id();
  }
  std::uint8_t status_level() const override { return byte(dxl::address::kStatusReturnLevel); }
  bool answers_fast_sync_read() const override { return fast_sync_read_; }
  bool alert() const override { return byte(dxl::address::kHardwareError) != 0; }
  bool torque_on() const override { return byte(dxl::address::kTorqueEnable) != 0; }
  void refresh(std::uint16_t address, std::uint16_t length) override;
  dxl::Error backup(std::span<const std::uint8_t> parameters) override;
  std::uint64_t deadline_us() const override;
  void expire() override;

 private:
  dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data) const override;
  bool known(std::uint16_t address, std::span<const std::uint8_t> data) const;
  bool within_limits(std::uint16_t address, std::span<const std::uint8_t> data) const;
  void written(std::uint16_t address, std::uint16_t length) override;
  void restarted() override;
  void started() override;
  void reset_goals();
  void refresh_motion(const sim::ServoMeasurement& measured);
  std::uint8_t moving_status(const sim::ServoMeasurement& measured) const;
  /// True for position control: single-turn, multi-turn or current-based.
  bool steers_position() const;
  bool reverse() const;
  int sign() const { return reverse() ? -1 : 1; }
  /// Encoder count to Present Position (shown) and back (meant_count).
  double shown(double count) const;
  std::int32_t meant_count(std::int64_t shown) const;
  void hold_here();
  bool moving() override;
  bool tripped() const { return byte(dxl::address::kBusWatchdog) == dxl::kBusWatchdogTripped; }
  std::int32_t homing() const;
  void watch_limits(const sim::ServoMeasurement& measured);
  void apply();
  void apply_profile(sim::ServoSetpoint& setpoint) const;

  const dxl::ServoModel& model_;
  sim::Plant& plant_;
  int joint_;
  bool fast_sync_read_;
  std::uint8_t mode_ = dxl::kPositionMode;  ///< Operating Mode last applied
  bool goal_written_ = false;
  RegisterTable stored_;  ///< by Control Table Backup, if Backup Ready
};

}  // namespace verp::bus
