#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/controller_table.hpp"
#include "firmware/app/operator_registers.hpp"
#include "hal/contract/store.hpp"

/// Operator settings that survive a power loss. OperatorSetup's defaults apply if nothing was kept,
/// another version wrote it, or this board lacks the feature.
namespace verp::app {

inline constexpr std::uint16_t kSettingsKey = 1;  ///< key in the board's Store

struct Settings {
  std::uint8_t id = table::kDefaultId;
  table::ImuSource imu_source = table::ImuSource::kBus;
  /// Kept, because a reset during a robot's first steps must not restore full strength.
  std::uint8_t torque_limit_percent = 100;

  friend bool operator==(const Settings&, const Settings&) = default;
};

template <hal::Store Memory>
class SettingsKeeper {
 public:
  explicit SettingsKeeper(Memory& memory) : memory_(memory) {}

  /// Call at start: loads the settings into `setup`.
  void load(OperatorSetup& setup) {
    kept_ = {setup.id, setup.imu_source, setup.torque_limit_percent};
    std::uint8_t bytes[kBytes];
    const std::size_t size = memory_.get(kSettingsKey, bytes, sizeof bytes);
    if ((size != kBytes && size != kBytesOnce) || bytes[0] != kVersion) return;
    if (bytes[1] <= table::find("id")->maximum) setup.id = bytes[1];
    if (bytes[2] < 8 && (setup.imu_sources >> bytes[2] & 1) != 0) {
      setup.imu_source = static_cast<table::ImuSource>(bytes[2]);
    }
    if (size == kBytes && bytes[3] >= kLimit.minimum && bytes[3] <= kLimit.maximum) {
      setup.torque_limit_percent = bytes[3];
    }
    kept_ = {setup.id, setup.imu_source, setup.torque_limit_percent};
  }

  /// Call regularly: stores changes, one step of the memory per call. True while something is not
  /// durable. A change that the memory refuses is not retried: it holds until the next start.
  bool keep(const Settings& now, bool may_erase) {
    const hal::WorkState state = memory_.work(may_erase);
    if (now == kept_) return state == hal::WorkState::kWorking;
    const std::uint8_t bytes[kBytes] = {kVersion, now.id, static_cast<std::uint8_t>(now.imu_source),
                                        now.torque_limit_percent};
    const hal::PutResult result = memory_.put(kSettingsKey, bytes, sizeof bytes);
    if (result != hal::PutResult::kBusy) kept_ = now;
    return true;
  }

 private:
  static constexpr std::uint8_t kVersion = 1;
  static constexpr std::size_t kBytes = 4;
  static constexpr std::size_t kBytesOnce = 3;  ///< an older layout: no torque limit
  static constexpr table::Register kLimit = *table::find("torque_limit");
  Memory& memory_;
  Settings kept_;
};

}  // namespace verp::app
