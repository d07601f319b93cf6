#include "firmware/app/operator_registers.hpp"

namespace verp::app {

OperatorRegisters::OperatorRegisters(const Params& params, const OperatorSetup& setup,
                                     Images& store)
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
  image_.set(reg("brown_out"), setup.brown_out);
  image_.set(reg("clock_source"), setup.clock_source);
  image_.set(reg("crash_pc"), setup.crash.pc);
  image_.set(reg("crash_cause"), setup.crash.cause);
  image_.set(reg("crash_tick"), setup.crash.tick);
  image_.set(reg("crash_count"), setup.crash.count);
  image_.set(reg("parameter_count"), static_cast<std::uint16_t>(kTuningCount));
  image_.set(reg("status_return_level"), std::uint8_t{2});
  show_parameter();
}

table::ImuSource OperatorRegisters::imu_source() const {
  return image_.get<table::ImuSource>(reg("imu_source"));
}

table::ImuCalibrationOrder OperatorRegisters::take_calibration_order() {
  const table::ImuCalibrationOrder order = calibration_order_;
  calibration_order_ = table::ImuCalibrationOrder::kNone;
  return order;
}

void OperatorRegisters::offer_actions(int count, action::KeptFault fault) {
  image_.set(reg("action_count"), static_cast<std::uint16_t>(count));
  image_.set(reg("action_fault"), fault);
}

const std::uint8_t* OperatorRegisters::read(std::uint16_t address, std::size_t size) {
  if (!RegisterImage::holds(address, size)) return nullptr;
  if (address < reg_end("window_data") && address + size > reg("window_data")) fill_window();
  return image_.at(address);
}

dxl::Error OperatorRegisters::write(std::uint16_t address, const std::uint8_t* data,
                                    std::size_t size) {
  const Write write{address, data, size};
  const dxl::Error error = check(write);
  if (error != dxl::Error::kNone) return error;
  __builtin_memcpy(image_.at(address), data, size);
  return take_effect(write);
}

dxl::Error OperatorRegisters::reg_write(std::uint16_t address, const std::uint8_t* data,
                                        std::size_t size) {
  const dxl::Error error = check({address, data, size});
  if (error != dxl::Error::kNone) return error;
  __builtin_memcpy(registered_, data, size);  // one run of writable registers
  registered_address_ = address;
  registered_size_ = size;
  image_.set(reg("registered_instruction"), std::uint8_t{1});
  return error;
}

dxl::Error OperatorRegisters::action() {
  const std::size_t size = registered_size_;
  if (size == 0) return dxl::Error::kInstruction;
  registered_size_ = 0;
  image_.set(reg("registered_instruction"), std::uint8_t{0});
  return write(registered_address_, registered_,
               size);  // conditions may have changed
}

bool OperatorRegisters::slept_until(std::uint32_t tick) {
  return standing_.slept_until(tick, tuning_.safety.command_hold_s);
}

bool OperatorRegisters::commit(ImageKind kind, std::uint32_t crc) {
  const std::uint8_t fault = kind == ImageKind::kNone ? kWrongWindowCrc : store_.commit(kind, crc);
  show_window(fault == 0 ? table::WindowState::kAccepted : table::WindowState::kRefused, fault);
  return fault == 0;
}

void OperatorRegisters::show_window(table::WindowState state, std::uint8_t fault) {
  image_.set(reg("window_state"), state);
  image_.set(reg("window_fault"), fault);
}

OperatorOrder OperatorRegisters::order() {
  OperatorOrder order;
  order.command = standing_.take(order.flags);
  if (parameter_pending_) {
    order.flags |= kParameterWrite;
    order.parameter_id = parameter_id_;
    order.parameter_bits = parameter_bits_;
  }
  parameter_pending_ = false;
  order.action = image_.get<std::uint16_t>(reg("action_request"));
  return order;
}

void OperatorRegisters::record(const TickRecord& record, const State& state,
                               const Outputs& outputs) {
  report_.tick(record, state, outputs);
  tuning_ = state.tuning;
  show_parameter();
  store_.keep(record, state);
}

std::uint8_t OperatorRegisters::byte(std::uint16_t address) const {
  return image_.get<std::uint8_t>(address);
}

std::int16_t OperatorRegisters::word(std::uint16_t address) const {
  return image_.get<std::int16_t>(address);
}

dxl::Error OperatorRegisters::check(const Write& write) const {
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

dxl::Error OperatorRegisters::check_values(const Write& write) const {
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
  if (!store_.keeps_ticks() && write.covers(reg("tick_hold")) &&
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

std::uint16_t OperatorRegisters::parameter_in(const Write& write) const {
  return dxl::get_u16(write.covers(reg("parameter_id")) ? write.from(reg("parameter_id"))
                                                        : image_.at(reg("parameter_id")));
}

std::uint32_t OperatorRegisters::offset_in(const Write& write) const {
  return dxl::get_u32(write.covers(reg("window_offset")) ? write.from(reg("window_offset"))
                                                         : image_.at(reg("window_offset")));
}

std::uint32_t OperatorRegisters::data_begin(const Write& write) {
  return write.address > reg("window_data") ? write.address - reg("window_data") : 0u;
}

std::uint32_t OperatorRegisters::data_end(const Write& write) {
  const std::size_t end = write.address + write.size;
  return static_cast<std::uint32_t>((end < reg_end("window_data") ? end : reg_end("window_data")) -
                                    reg("window_data"));
}

dxl::Error OperatorRegisters::take_effect(const Write& write) {
  if (write.touches(reg("request"), reg_end("action_request"))) standing_.given();
  if (write.covers(reg("request"))) standing_.requested();
  if (write.covers(reg("parameter_value"))) {
    parameter_id_ = parameter_in(write);
    parameter_bits_ = dxl::get_u32(write.from(reg("parameter_value")));
    parameter_pending_ = true;
  }
  if (write.covers(reg("imu_calibrate"))) {
    calibration_order_ = image_.get<table::ImuCalibrationOrder>(reg("imu_calibrate"));
    image_.set(reg("imu_calibrate"), std::uint8_t{0});
  }
  if (write.touches(reg("parameter_id"), reg_end("parameter_value"))) show_parameter();
  if (write.covers(reg("tick_hold"))) store_.hold(byte(reg("tick_hold")));
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

dxl::Error OperatorRegisters::keep_block(const Write& write) {
  const std::uint32_t begin = data_begin(write);
  const Taken taken = store_.write(
      window_kind(), offset_in(write) + begin,
      write.from(static_cast<std::uint16_t>(reg("window_data") + begin)), data_end(write) - begin);
  if (taken == Taken::kYes) show_window(table::WindowState::kReceiving);
  if (taken == Taken::kNo) show_window(table::WindowState::kRefused, kBlockNotKept);
  return taken == Taken::kYes ? dxl::Error::kNone : dxl::Error::kResultFail;
}

dxl::Error OperatorRegisters::commit() {
  const bool wanted = byte(reg("window_commit")) != 0;
  image_.set(reg("window_commit"), std::uint8_t{0});
  if (!wanted) return dxl::Error::kNone;
  const std::uint32_t crc = dxl::get_u32(image_.at(reg("window_crc")));
  return commit(window_kind(), crc) ? dxl::Error::kNone : dxl::Error::kResultFail;
}

void OperatorRegisters::fill_window() {
  const std::size_t size = store_.size(window_kind());
  const std::size_t offset = dxl::get_u32(image_.at(reg("window_offset")));
  const std::size_t left = offset < size ? size - offset : 0;
  const std::size_t count = left < table::kWindowBytes ? left : table::kWindowBytes;
  __builtin_memset(image_.at(reg("window_data")), 0, table::kWindowBytes);
  if (count > 0) store_.read(window_kind(), offset, image_.at(reg("window_data")), count);
}

void OperatorRegisters::show_parameter() {
  const int id = dxl::get_u16(image_.at(reg("parameter_id")));
  image_.set(reg("parameter_value"), tuning_value(tuning_, id));
  image_.set(reg("parameter_low"), kTuningRanges[id].low);
  image_.set(reg("parameter_high"), kTuningRanges[id].high);
}

}  // namespace verp::app
