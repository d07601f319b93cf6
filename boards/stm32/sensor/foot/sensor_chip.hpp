#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/model/params.hpp"
#include "firmware/app/sensor_registers.hpp"
#include "hal/chip/stm32/analog_scan.hpp"

namespace verp::board {

/// The four force cells of a foot on kFootPort. Alternatives: boards/stm32/sensor/chip, turning.
class SensorChip {
 public:
  static constexpr std::uint16_t kModel = dxl::kModelFoot;
  static constexpr std::uint64_t kSample_us = 0;
  static constexpr bool kWaits = false;

  explicit SensorChip(const Params& params) : params_(params) {}

  bool open(const Start& start) {
    stm32::Gpio<Io>().input(kFootPort.right, hal::stm32::gpio::kPullUp);
    cells_.open(start.clocks.apb2_hz);
    return true;
  }
  std::uint8_t id() const {
    return params_.feet.device_id[stm32::Gpio<Io>().read(kFootPort.right) ? 0 : 1];
  }
  void sample(app::SensorRegisters& registers) {
    std::uint16_t counts[4];
    if (cells_.poll(counts)) registers.set(counts);
  }

 private:
  const Params& params_;
  hal::stm32::AnalogScan<Io, Timer> cells_{kFootPort.cells, timer};
};

}  // namespace verp::board
