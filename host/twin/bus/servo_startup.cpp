#include <algorithm>
#include <iterator>

#include "host/twin/bus/servo_device.hpp"
#include "host/twin/bus/servo_registers.hpp"

namespace verp::bus {

using namespace servo;
namespace at = dxl::address;

// e-Manual, Startup Configuration (60).
void ServoDevice::started() {
  const std::uint8_t startup = byte(at::kStartupConfiguration);
  const bool kept = stored_.get(at::kBackupReady) != 0;
  if (kept && (startup & kRamRestore) != 0) {
    table_.copy(stored_, at::kVelocityIGain, at::kBusWatchdog);
    table_.copy(stored_, at::kProfileAcceleration, at::kGoalPosition);
    for (const auto& [addresses, data, pairs] : indirect_) {
      table_.copy(stored_, addresses, static_cast<std::uint16_t>(addresses + 2 * pairs));
    }
  }
  if ((startup & kStartupTorqueOn) != 0) {
    table_.set(at::kTorqueEnable, 1);
    hold_here();
  }
  apply();
}

dxl::Error ServoDevice::backup(std::span<const std::uint8_t> parameters) {
  if (!model_.has(dxl::kStartup)) return dxl::Error::kInstruction;
  if (parameters.size() != 1 + sizeof kBackupWord ||
      !std::equal(std::begin(kBackupWord), std::end(kBackupWord), parameters.begin() + 1)) {
    return dxl::Error::kDataRange;
  }
  const bool kept = stored_.get(at::kBackupReady) != 0;
  if (torque_on() || (parameters[0] == kRestore && !kept)) return dxl::Error::kResultFail;
  if (parameters[0] == kStore) {
    table_.set(at::kBackupReady, 1);
    stored_ = table_;
    return dxl::Error::kNone;
  }
  if (parameters[0] != kRestore) return dxl::Error::kDataRange;
  table_.copy(stored_, at::kId, at::kTorqueEnable);
  reboot();
  return dxl::Error::kNone;
}

}  // namespace verp::bus
