#pragma once
#include <cstdint>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/communication.hpp"
#include "common/protocol/canopen/drive_objects.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::can {

/// P, I and D gain of the position loop: an array.
inline constexpr std::uint16_t kGains = 0x2002;
inline constexpr std::uint16_t kMostGain = 16383;

/// What commissioning has left in a drive; CiA 402 has no objects for it.
struct DriveSetup {
  double counts_per_rad = 0;  ///< of its encoder, without sign
  std::uint16_t p_gain = 0;   ///< 2002h:1 to 3, in units of sim::ServoSetpoint
  std::uint16_t i_gain = 0;
  std::uint16_t d_gain = 0;
};

/// What a drive does by itself and its device must tell.
struct DriveNews {
  canopen::ErrorCode code = canopen::ErrorCode::kNoError;
  std::uint8_t error_register = 0;
  bool any = false;
};

/// The application of a CiA 402 drive over one joint of a plant: its objects from 2000h up (a
/// canopen::Application), and the state machine behind them.
///
/// Mode 8 only. Targets take effect when they are written, within 607Dh, and are joined by straight
/// lines of 60C2h; before the first one since it got torque it holds where it is. Max torque
/// (6072h) limits the duty, as Goal PWM does in a serial servo. Quick stop stops on the spot:
/// torque goes when it stands (605Ah 1 to 3), or stays (5 to 7). Overheating and, if watched, a
/// following error are faults; a supply out of range is a warning, as in a serial servo's Shutdown.
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

  /// What 1010h stores.
  struct Settings {
    canopen::cia402::DriveObjects objects;
    std::uint16_t gains[3] = {};
  };
  Settings settings() const;
  /// After restart(): as they were stored.
  void restore(const Settings& settings);

  /// Power on, or NMT's reset: all objects as commissioned, no torque.
  void restart();
  void power_off();
  /// The heartbeat of the master is gone, or NMT has stopped the node: option 6007h. True if that
  /// is a fault; a drive that has no torque to lose has none.
  bool connection_lost();
  /// 603Fh: what its device says is wrong.
  void show_error(canopen::ErrorCode code) {
    objects_.error_code = static_cast<std::uint16_t>(code);
  }
  /// Once a millisecond. What it returns is to be sent as EMCY.
  DriveNews work(std::uint64_t now_us);

  const canopen::cia402::Drive& drive() const { return drive_; }

 private:
  void refresh();
  void control(std::uint16_t word);
  /// After anything that may have changed its state.
  void settle();
  DriveNews watch(std::uint64_t now_us);
  DriveNews fault(canopen::ErrorCode code, std::uint8_t error_register, std::uint8_t error_bit);
  /// Of the rated torque, -1 to 1.
  double share(const sim::ServoMeasurement& measured) const;
  void hold();
  void apply();
  std::int32_t goal_count();
  std::uint16_t status_bits() const;

  sim::Plant& plant_;
  int joint_;
  DriveSetup setup_;
  sim::ServoRating rating_;
  canopen::cia402::DriveObjects objects_;
  canopen::cia402::Drive drive_;
  canopen::cia402::FollowingMonitor following_;
  std::uint16_t gains_[3] = {};
  std::uint8_t hardware_errors_ = 0;  ///< bits of dxl::HardwareError, until a fault reset
  std::int32_t held_count_ = 0;       ///< where it stays while it has no target to follow
  bool target_written_ = false;       ///< since it last stopped or lost its torque
  bool limited_ = false;              ///< 607Dh cut the target
  bool following_error_ = false;
  bool warned_ = false;
  canopen::cia402::State state_ = canopen::cia402::State::kNotReady;  ///< as last acted upon
};

}  // namespace verp::can
