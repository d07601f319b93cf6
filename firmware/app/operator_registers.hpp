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
#include "firmware/app/tick_log.hpp"
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
  table::ClockSource clock_source = table::ClockSource::kUnknown;
  FieldName bad_field{};  ///< of Params, if self_test failed for it
  CrashNote crash{};
  /// false: only registers that select what is shown can be written.
  bool takes_orders = true;
};

/// The registers and the effects of reads and writes, without packets. Errors are the e-Manual's.
template <Images Store>
class OperatorRegisters {
 public:
  OperatorRegisters(const Params& params, const OperatorSetup& setup, Store& store)
      : store_(store),
        report_(params, image_),
        standing_(params, image_),
        tuning_(params.tuning),
        takes_orders_(setup.takes_orders) {
    image_.set(reg("model_number"), table::kModel);
    image_.set(reg("model_information"), params_crc(params));
    image_.set(reg("firmware_version"), table::kTableVersion);
    image_.set(reg("id"), setup.id);
    image_.set(reg("protocol_type"), std::uint8_t{2});
    image_.set(reg("core_version"), kCoreVersion);
    image_.set(reg("image_version"), kImageVersion);
    image_.set(reg("robot_name"), params.name);
    image_.set(reg("period_us"), params.period_us);
    image_.set(reg("joint_count"), params.joint_count);
    image_.set(reg("device_count"), static_cast<std::uint8_t>(table::kDeviceLink + 1));
    image_.set(reg("imu_source"), setup.imu_source);
    image_.set(reg("imu_sources"), setup.imu_sources);
    image_.set(reg("torque_limit"), setup.torque_limit_percent);
    image_.set(reg("self_test"), setup.self_test);
    image_.set(reg("image_field"), setup.bad_field.text);
    image_.set(reg("reset_cause"), setup.reset_cause);
    image_.set(reg("clock_source"), setup.clock_source);
    image_.set(reg("crash_pc"), setup.crash.pc);
    image_.set(reg("crash_cause"), setup.crash.cause);
    image_.set(reg("crash_tick"), setup.crash.tick);
    image_.set(reg("crash_count"), setup.crash.count);
    image_.set(reg("parameter_count"), static_cast<std::uint16_t>(kTuningCount));
    image_.set(reg("status_return_level"), std::uint8_t{2});
    show_parameter();
  }

  OperatorRegisters(const OperatorRegisters&) = delete;
  OperatorRegisters& operator=(const OperatorRegisters&) = delete;

  std::uint8_t id() const { return byte(reg("id")); }
  std::uint8_t status_level() const { return byte(reg("status_return_level")); }
  bool alert() const { return byte(reg("hardware_error")) != 0; }
  bool armed() const { return byte(reg("torque_enable")) != 0; }
  table::ImuSource imu_source() const {
    return image_.template get<table::ImuSource>(reg("imu_source"));
  }
  /// Pass to App::limit_torque() before each tick. Changes only with torque off: a standing robot
  /// must neither sag nor push harder at once.
  std::uint8_t torque_limit_percent() const { return byte(reg("torque_limit")); }
  /// The order for the chip; returned once.
  table::ImuCalibrationOrder take_calibration_order() {
    const table::ImuCalibrationOrder order = calibration_order_;
    calibration_order_ = table::ImuCalibrationOrder::kNone;
    return order;
  }
  /// `request` 0 was written; returned once.
  bool take_relax() { return standing_.take_relax(); }
  /// `count`: what action_request accepts; `fault`: why stored ones are not available.
  void offer_actions(int count, action::KeptFault fault = action::KeptFault::kNone) {
    image_.set(reg("action_count"), static_cast<std::uint16_t>(count));
    image_.set(reg("action_fault"), fault);
  }
  TickReport& report() { return report_; }
  /// Whether a write there may have its effect (OperatorSetup).
  bool obeys(std::uint16_t address) const { return takes_orders_ || only_shows(address); }

  /// The bytes of a read; nullptr: outside the table. Gaps read as zero.
  const std::uint8_t* read(std::uint16_t address, std::size_t size) {
    if (!RegisterImage::holds(address, size)) return nullptr;
    if (address < reg_end("window_data") && address + size > reg("window_data")) fill_window();
    return image_.at(address);
  }

  /// Writes all of it, or returns the error.
  dxl::Error write(std::uint16_t address, const std::uint8_t* data, std::size_t size) {
    const Write write{address, data, size};
    const dxl::Error error = check(write);
    if (error != dxl::Error::kNone) return error;
    __builtin_memcpy(image_.at(address), data, size);
    return take_effect(write);
  }

  /// Keeps a write until action(), or returns the error.
  dxl::Error reg_write(std::uint16_t address, const std::uint8_t* data, std::size_t size) {
    const dxl::Error error = check({address, data, size});
    if (error != dxl::Error::kNone) return error;
    __builtin_memcpy(registered_, data, size);  // one run of writable registers
    registered_address_ = address;
    registered_size_ = size;
    image_.set(reg("registered_instruction"), std::uint8_t{1});
    return error;
  }

  dxl::Error action() {
    const std::size_t size = registered_size_;
    if (size == 0) return dxl::Error::kInstruction;
    registered_size_ = 0;
    image_.set(reg("registered_instruction"), std::uint8_t{0});
    return write(registered_address_, registered_,
                 size);  // conditions may have changed
  }

  bool slept_until(std::uint32_t tick) {
    return standing_.slept_until(tick, tuning_.safety.command_hold_s);
  }
  void withdraw_orders() { standing_.withdraw(armed()); }

  /// Commits a complete image, from the window or elsewhere; the window shows the result.
  bool commit(ImageKind kind, std::uint32_t crc) {
    const std::uint8_t fault =
        kind == ImageKind::kNone ? kWrongWindowCrc : store_.commit(kind, crc);
    show_window(fault == 0 ? table::WindowState::kAccepted : table::WindowState::kRefused, fault);
    return fault == 0;
  }
  void show_window(table::WindowState state, std::uint8_t fault = 0) {
    image_.set(reg("window_state"), state);
    image_.set(reg("window_fault"), fault);
  }

  OperatorOrder order() {
    OperatorOrder order;
    order.command = standing_.take(order.flags);
    if (parameter_pending_) {
      order.flags |= kParameterWrite;
      order.parameter_id = parameter_id_;
      order.parameter_bits = parameter_bits_;
    }
    parameter_pending_ = false;
    order.action = image_.template get<std::uint16_t>(reg("action_request"));
    return order;
  }

  /// Call after the tick.
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    report_.tick(record, state, outputs);
    tuning_ = state.tuning;
    show_parameter();
    if constexpr (KeepsTicks<Store>) store_.keep(record, state);
  }

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

  std::uint8_t byte(std::uint16_t address) const {
    return image_.template get<std::uint8_t>(address);
  }
  std::int16_t word(std::uint16_t address) const {
    return image_.template get<std::int16_t>(address);
  }
  ImageKind window_kind() const { return image_.template get<ImageKind>(reg("window_kind")); }

  dxl::Error check(const Write& write) const {
    const dxl::Error error =
        dxl::check_write(write.address, write.data, write.size, [&](std::uint16_t address) {
          const table::Rule* rule = table::rule_at(address);
          if (rule == nullptr) return dxl::WriteRule{};
          const bool open =
              obeys(address) && (rule->access == table::Access::kWrite ||
                                 (rule->access == table::Access::kDisarmed && !armed()));
          return dxl::WriteRule{rule->size, open, rule->minimum, rule->maximum()};
        });
    return error == dxl::Error::kNone ? check_values(write) : error;
  }

  dxl::Error check_values(const Write& write) const {
    if (write.covers(reg("action_request")) &&
        dxl::get_u16(write.from(reg("action_request"))) > word(reg("action_count"))) {
      return dxl::Error::kDataRange;
    }
    if (write.covers(reg("request")) &&
        !standing_.takes(static_cast<Request>(*write.from(reg("request"))))) {
      return dxl::Error::kResultFail;
    }
    if (write.covers(reg("imu_source")) &&
        (byte(reg("imu_sources")) >> *write.from(reg("imu_source")) & 1) == 0) {
      return dxl::Error::kDataRange;
    }
    // Calibration needs the chip as the source.
    if (write.covers(reg("imu_calibrate")) && *write.from(reg("imu_calibrate")) != 0 &&
        imu_source() != table::ImuSource::kChip) {
      return dxl::Error::kResultFail;
    }
    if (!KeepsTicks<Store> && write.covers(reg("tick_hold")) &&
        *write.from(reg("tick_hold")) != 0) {
      return dxl::Error::kResultFail;
    }
    if (write.covers(reg("window_kind"))) {
      const auto kind = static_cast<ImageKind>(*write.from(reg("window_kind")));
      const bool known = store_.size(kind) != 0 || store_.room(kind) != 0;
      if (kind != ImageKind::kNone && !known) return dxl::Error::kDataRange;
    }
    if (write.covers(reg("parameter_value"))) {
      float value;
      __builtin_memcpy(&value, write.from(reg("parameter_value")), sizeof value);
      if (!in_range(parameter_in(write), value)) return dxl::Error::kDataRange;
      if (parameter_pending_) return dxl::Error::kResultFail;
    }
    if (write.touches(reg("window_data"), reg_end("window_data"))) {
      const std::uint64_t end = std::uint64_t{offset_in(write)} + data_end(write);
      if (end > store_.room(window_kind())) return dxl::Error::kDataLimit;
      if (window_kind() == ImageKind::kActions && armed()) return dxl::Error::kAccess;
    }
    return dxl::Error::kNone;
  }

  std::uint16_t parameter_in(const Write& write) const {
    return dxl::get_u16(write.covers(reg("parameter_id")) ? write.from(reg("parameter_id"))
                                                          : image_.at(reg("parameter_id")));
  }
  std::uint32_t offset_in(const Write& write) const {
    return dxl::get_u32(write.covers(reg("window_offset")) ? write.from(reg("window_offset"))
                                                           : image_.at(reg("window_offset")));
  }
  static std::uint32_t data_begin(const Write& write) {
    return write.address > reg("window_data") ? write.address - reg("window_data") : 0u;
  }
  static std::uint32_t data_end(const Write& write) {
    const std::size_t end = write.address + write.size;
    return static_cast<std::uint32_t>(
        (end < reg_end("window_data") ? end : reg_end("window_data")) - reg("window_data"));
  }

  dxl::Error take_effect(const Write& write) {
    if (write.touches(reg("request"), reg_end("action_request"))) standing_.given();
    if (write.covers(reg("request"))) standing_.requested();
    if (write.covers(reg("parameter_value"))) {
      parameter_id_ = parameter_in(write);
      parameter_bits_ = dxl::get_u32(write.from(reg("parameter_value")));
      parameter_pending_ = true;
    }
    if (write.covers(reg("imu_calibrate"))) {
      calibration_order_ = image_.template get<table::ImuCalibrationOrder>(reg("imu_calibrate"));
      image_.set(reg("imu_calibrate"), std::uint8_t{0});
    }
    if (write.touches(reg("parameter_id"), reg_end("parameter_value"))) show_parameter();
    if constexpr (KeepsTicks<Store>) {
      if (write.covers(reg("tick_hold"))) store_.hold(byte(reg("tick_hold")));
    }
    if (write.covers(reg("window_kind"))) {
      store_.begin(window_kind());
      const std::size_t size = store_.size(window_kind());
      image_.set(reg("window_size"), static_cast<std::uint32_t>(size));
      show_window(table::WindowState::kIdle);
    }
    if (write.touches(reg("window_data"), reg_end("window_data"))) {
      const dxl::Error error = keep_block(write);
      if (error != dxl::Error::kNone) return error;
    }
    return write.covers(reg("window_commit")) ? commit() : dxl::Error::kNone;
  }

  /// While the memory is prepared the window stays idle: no refusal.
  dxl::Error keep_block(const Write& write) {
    const std::uint32_t begin = data_begin(write);
    const Taken taken =
        store_.write(window_kind(), offset_in(write) + begin,
                     write.from(static_cast<std::uint16_t>(reg("window_data") + begin)),
                     data_end(write) - begin);
    if (taken == Taken::kYes) show_window(table::WindowState::kReceiving);
    if (taken == Taken::kNo) show_window(table::WindowState::kRefused, kBlockNotKept);
    return taken == Taken::kYes ? dxl::Error::kNone : dxl::Error::kResultFail;
  }

  dxl::Error commit() {
    const bool wanted = byte(reg("window_commit")) != 0;
    image_.set(reg("window_commit"), std::uint8_t{0});
    if (!wanted) return dxl::Error::kNone;
    const std::uint32_t crc = dxl::get_u32(image_.at(reg("window_crc")));
    return commit(window_kind(), crc) ? dxl::Error::kNone : dxl::Error::kResultFail;
  }

  /// Beyond the image's end it shows zeros.
  void fill_window() {
    const std::size_t size = store_.size(window_kind());
    const std::size_t offset = dxl::get_u32(image_.at(reg("window_offset")));
    const std::size_t left = offset < size ? size - offset : 0;
    const std::size_t count = left < table::kWindowBytes ? left : table::kWindowBytes;
    __builtin_memset(image_.at(reg("window_data")), 0, table::kWindowBytes);
    if (count > 0) store_.read(window_kind(), offset, image_.at(reg("window_data")), count);
  }

  void show_parameter() {
    const int id = dxl::get_u16(image_.at(reg("parameter_id")));
    image_.set(reg("parameter_value"), tuning_value(tuning_, id));
    image_.set(reg("parameter_low"), kTuningRanges[id].low);
    image_.set(reg("parameter_high"), kTuningRanges[id].high);
  }

  Store& store_;
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
