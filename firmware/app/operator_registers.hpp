#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/kept.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/image.hpp"
#include "common/model/params.hpp"
#include "common/model/tuning_ranges.hpp"
#include "common/protocol/device_end.hpp"
#include "firmware/app/block_window.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/register_image.hpp"
#include "firmware/app/standing_order.hpp"
#include "firmware/app/tick_report.hpp"

namespace verp::app {

/// The previous run's crash (firmware/boot/crash.hpp). count 0: none.
struct CrashNote {
  std::uint32_t pc = 0;
  std::uint32_t cause = 0;  ///< CFSR
  std::uint32_t tick = 0;
  std::uint32_t count = 0;
};

/// The board's state before the first tick.
struct OperatorSetup {
  std::uint8_t id = table::kDefaultId;
  table::ImuSource imu_source = table::ImuSource::kBus;
  std::uint8_t imu_sources = 1 << static_cast<int>(table::ImuSource::kBus);  ///< bit mask
  std::uint8_t torque_limit_percent = 100;
  table::SelfTest self_test = table::SelfTest::kNotRun;
  table::ResetCause reset_cause = table::ResetCause::kUnknown;
  table::BrownOut brown_out = table::BrownOut::kUnknown;
  table::ClockSource clock_source = table::ClockSource::kUnknown;
  FieldName bad_field{};  ///< of Params, if self_test failed for it
  CrashNote crash{};
  /// false: only registers that select what is shown can be written.
  bool takes_orders = true;
};

/// The registers and the effects of reads and writes, without packets. Errors are the e-Manual's.
class OperatorRegisters {
 public:
  OperatorRegisters(const Params& params, const OperatorSetup& setup, Images& store);
  OperatorRegisters(const OperatorRegisters&) = delete;
  OperatorRegisters& operator=(const OperatorRegisters&) = delete;

  std::uint8_t id() const { return byte(reg("id")); }
  std::uint8_t status_level() const { return byte(reg("status_return_level")); }
  bool alert() const { return byte(reg("hardware_error")) != 0; }
  bool armed() const { return byte(reg("torque_enable")) != 0; }
  table::ImuSource imu_source() const;
  /// Pass to App::limit_torque() before each tick. Changes only with torque off: a standing robot
  /// must neither sag nor push harder at once.
  std::uint8_t torque_limit_percent() const { return byte(reg("torque_limit")); }
  /// The order for the chip; returned once.
  table::ImuCalibrationOrder take_calibration_order();
  /// `request` 0 was written; returned once.
  bool take_relax() { return standing_.take_relax(); }
  void offer_actions(int count, action::KeptFault fault = action::KeptFault::kNone);
  TickReport& report() { return report_; }

  // DynamixelDevice; this port's answers leave at once.
  static constexpr std::uint16_t model() { return table::kModel; }
  static constexpr std::uint8_t version() { return table::kTableVersion; }
  static constexpr bool holds() { return false; }
  void answers_after(std::uint32_t) {}
  void heard() { report_.heard(); }
  void link(std::uint32_t crc_errors, const hal::LinkErrors& errors) {
    report_.link(crc_errors, errors);
  }
  /// Whether a write there may have its effect (OperatorSetup).
  bool obeys(std::uint16_t address) const { return takes_orders_ || only_shows(address); }

  /// The bytes of a read; nullptr: outside the table. Gaps read as zero.
  const std::uint8_t* read(std::uint16_t address, std::size_t size);

  /// Writes all of it, or returns the error.
  dxl::Error write(std::uint16_t address, const std::uint8_t* data, std::size_t size);

  /// Keeps a write until action(), or returns the error.
  dxl::Error reg_write(std::uint16_t address, const std::uint8_t* data, std::size_t size);
  dxl::Error action();
  bool slept_until(std::uint32_t tick);
  void withdraw_orders() { standing_.withdraw(armed()); }

  /// Commits a complete image, from the window or elsewhere; the window shows the result.
  bool commit(ImageKind kind, std::uint32_t crc);
  void show_window(table::WindowState state, std::uint8_t fault = 0);
  OperatorOrder order();

  /// Call after the tick.
  void record(const TickRecord& record, const State& state, const Outputs& outputs);

 private:
  struct Write {
    std::uint16_t address;
    const std::uint8_t* data;
    std::size_t size;
    bool covers(std::uint16_t at) const { return at >= address && at < address + size; }
    bool touches(std::uint16_t first, std::uint16_t end) const {
      return address < end && first < address + size;
    }
    const std::uint8_t* from(std::uint16_t at) const { return data + (at - address); }
  };

  static constexpr bool only_shows(std::uint16_t address) {
    return address == reg("parameter_id") || address == reg("window_kind") ||
           address == reg("window_offset") || address == reg("tick_hold");
  }

  std::uint8_t byte(std::uint16_t address) const;
  std::int16_t word(std::uint16_t address) const;
  ImageKind window_kind() const { return image_.get<ImageKind>(reg("window_kind")); }

  dxl::Error check(const Write& write) const;
  dxl::Error check_values(const Write& write) const;
  std::uint16_t parameter_in(const Write& write) const;
  std::uint32_t offset_in(const Write& write) const;
  static std::uint32_t data_begin(const Write& write);
  static std::uint32_t data_end(const Write& write);
  dxl::Error take_effect(const Write& write);

  /// While the memory is prepared the window stays idle: no refusal.
  dxl::Error keep_block(const Write& write);
  dxl::Error commit();

  /// Beyond the image's end it shows zeros.
  void fill_window();
  void show_parameter();

  Images& store_;
  RegisterImage image_;
  TickReport report_;
  StandingOrder standing_;
  Tuning tuning_;
  const bool takes_orders_;
  std::uint8_t registered_[table::longest_write()] = {};
  std::size_t registered_size_ = 0;
  std::uint16_t registered_address_ = 0;
  std::uint16_t parameter_id_ = 0;
  std::uint32_t parameter_bits_ = 0;
  table::ImuCalibrationOrder calibration_order_ = table::ImuCalibrationOrder::kNone;
  bool parameter_pending_ = false;
};

}  // namespace verp::app
