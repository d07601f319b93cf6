#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/control_table.hpp"
#include "common/protocol/device_end.hpp"
#include "hal/contract/byte_link.hpp"
#include "hal/contract/imu.hpp"

namespace verp::app {

/// The control table of an IMU or foot device on the servo bus, as the twin's: id, rate, return
/// delay, LED, and the sensor block (common/protocol/control_table.hpp). A read of an IMU's block
/// takes the mean of the samples since the last one, of kImuMostPause_us at most; a foot's gives
/// the newest. Without a sample for kSilent_us such a read is refused: no master takes old counts
/// for new ones.
class SensorRegisters {
 public:
  static constexpr std::uint64_t kSilent_us = 10'000;

  SensorRegisters(std::uint8_t id, std::uint16_t model, std::uint32_t baud);

  /// The board's clock; call before each poll() of the device.
  void set_time(std::uint64_t now_us) { now_us_ = now_us; }
  void add(const hal::ImuSample& sample);
  /// A foot's cells.
  void set(const std::uint16_t (&counts)[4]);
  bool fresh() const { return has_sample_ && now_us_ - added_us_ <= kSilent_us; }

  // DynamixelDevice
  std::uint8_t id() const { return image_[dxl::address::kId]; }
  std::uint16_t model() const { return dxl::get_u16(image_ + dxl::address::kModelNumber); }
  static constexpr std::uint8_t version() { return 1; }
  static constexpr std::uint8_t status_level() { return 2; }
  static constexpr bool alert() { return false; }
  static constexpr bool armed() { return false; }
  bool holds() const { return now_us_ < due_us_; }
  void answers_after(std::uint32_t time_us) {
    due_us_ = now_us_ + time_us + 2u * image_[dxl::address::kReturnDelay];
  }
  void heard() {}
  void link(std::uint32_t, const hal::LinkErrors&) {}
  /// nullptr: past the table's end, or the block has no fresh sample. Gaps read as zero.
  const std::uint8_t* read(std::uint16_t address, std::size_t size);
  /// Id and rate are the robot's, in the board's flash: read only here.
  dxl::Error write(std::uint16_t address, const std::uint8_t* data, std::size_t size);
  dxl::Error reg_write(std::uint16_t, const std::uint8_t*, std::size_t) {
    return dxl::Error::kInstruction;
  }
  dxl::Error action() { return dxl::Error::kInstruction; }

 private:
  static constexpr std::size_t kBytes = dxl::sensor_block::kAddress + dxl::sensor_block::kBytes;

  void refresh();
  void note_sample() {
    added_us_ = now_us_;
    has_sample_ = true;
  }

  std::uint8_t image_[kBytes] = {};
  hal::ImuMean mean_;
  bool has_sample_ = false;
  std::uint64_t now_us_ = 0;
  std::uint64_t due_us_ = 0;
  std::uint64_t added_us_ = 0;
  std::uint64_t begun_us_ = 0;  ///< of the mean
};

}  // namespace verp::app
