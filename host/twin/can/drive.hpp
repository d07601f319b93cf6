#pragma once
#include <cstdint>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/communication.hpp"
#include "common/protocol/canopen/drive_objects.hpp"
#include "host/twin/can/positioning.hpp"
#include "host/twin/can/profile_objects.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::can {

/// P, I and D gain of the position loop.
inline constexpr std::uint16_t kGains = 0x2002;
inline constexpr std::uint16_t kMostGain = 16383;

/// Commissioned settings without a CiA 402 object.
struct DriveSetup {
  double counts_per_rad = 0;  ///< of the encoder, unsigned
  std::uint16_t p_gain = 0;   ///< 2002h:1 to 3, units of sim::ServoSetpoint
  std::uint16_t i_gain = 0;
  std::uint16_t d_gain = 0;
};

struct DriveNews {
  canopen::ErrorCode code = canopen::ErrorCode::kNoError;
  std::uint8_t error_register = 0;
  bool any = false;
};

/// CiA 402 drive of one joint: its objects from 2000h up and its state machine.
///
/// Mode 8: a target, limited by 607Dh, takes effect when written; straight lines of 60C2h join the
/// targets; without a target since torque-on, the drive holds its position. Mode 1 ramps to
/// set-points, mode 6 makes the present position home (positioning.hpp). A change of mode with
/// torque on holds the goal until the new mode's first target. 6072h limits the duty, as Goal PWM
/// does in a serial servo. Quick stop stops at once; then the torque goes off (605Ah 1 to 3) or
/// stays on (5 to 7). Overheating and a watched following error are faults; a wrong supply voltage
/// is a warning.
class DriveApplication {
 public:
  DriveApplication(sim::Plant& plant, int joint, const DriveSetup& setup);

  canopen::Abort find(canopen::Address at, canopen::Entry& entry) const;
  canopen::Abort read(canopen::Address at, std::uint32_t offset, std::uint8_t* buffer,
                      std::uint32_t size);
  canopen::Abort write(canopen::Address at, const std::uint8_t* data, std::uint32_t size);
  canopen::Abort mappable(canopen::Address at, std::uint8_t bits, bool receive) const;
  std::uint64_t get(canopen::Address at, std::uint8_t bits);
  void put(canopen::Address at, std::uint8_t bits, std::uint64_t value);

  struct Settings {
    canopen::cia402::DriveObjects objects;
    ProfileObjects profile;
    std::uint16_t gains[3] = {};
    std::int32_t home_count = 0;
  };
  Settings settings() const;
  /// Restores stored settings; call it after restart().
  void restore(const Settings& settings);

  /// Power-on or NMT reset: all objects as commissioned, no torque.
  void restart();
  void power_off();
  /// Master's heartbeat missing, or stopped by NMT: applies 6007h; true if that is a fault.
  bool connection_lost();
  void show_error(canopen::ErrorCode code) {
    objects_.error_code = static_cast<std::uint16_t>(code);
  }
  /// Call once a millisecond; the device sends the returned event as EMCY.
  DriveNews work(std::uint64_t now_us);

  const canopen::cia402::Drive& drive() const { return drive_; }

 private:
  void refresh();
  canopen::Abort write_own(canopen::Address at, const std::uint8_t* data, std::uint32_t size);
  canopen::Abort change_mode(std::int8_t mode);
  bool operates(std::int8_t mode) const;
  void control(std::uint16_t word);
  void settle();
  bool follows_badly(std::uint64_t now_us);
  DriveNews watch(std::uint64_t now_us);
  DriveNews fault(canopen::ErrorCode code, std::uint8_t error_register, std::uint8_t error_bit);
  /// Share of the rated torque, -1 to 1.
  double share(const sim::ServoMeasurement& measured) const;
  void hold(std::int32_t count);
  void come_home();
  /// The encoder's position at which 6064h is 0.
  std::int64_t zero_count() const { return std::int64_t{home_count_} + objects_.home_offset; }
  void apply();
  std::int32_t goal_count();
  std::uint16_t status_bits() const;

  sim::Plant& plant_;
  int joint_;
  DriveSetup setup_;
  sim::ServoRating rating_;
  canopen::cia402::DriveObjects objects_;
  ProfileObjects profile_;
  ProfilePosition positioning_;
  Homing homing_;
  canopen::cia402::Drive drive_;
  canopen::cia402::FollowingMonitor following_;
  std::uint16_t gains_[3] = {};
  std::uint8_t hardware_errors_ = 0;  ///< bits of dxl::HardwareError until a fault reset
  std::int32_t held_count_ = 0;       ///< held position without a target
  std::int32_t goal_ = 0;             ///< of the encoder, last given to the servo
  std::int32_t home_count_ = 0;       ///< of the encoder, from mode 6
  std::uint16_t last_word_ = 0;       ///< controlword
  bool target_written_ = false;       ///< since the last stop or loss of torque
  bool limited_ = false;              ///< 607Dh limited the target
  bool following_error_ = false;
  bool warned_ = false;
  canopen::cia402::State state_ = canopen::cia402::State::kNotReady;  ///< last state acted upon
};

}  // namespace verp::can
