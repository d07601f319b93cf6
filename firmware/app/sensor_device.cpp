#include "firmware/app/sensor_device.hpp"

namespace verp::app {

template class DynamixelDevice<SensorRegisters>;

namespace at = dxl::address;
namespace block = dxl::sensor_block;

SensorRegisters::SensorRegisters(std::uint8_t id, std::uint16_t model, std::uint32_t baud) {
  constexpr std::uint8_t kFactoryDelay = 250;  // e-Manual, Return Delay Time
  dxl::put_u16(image_ + at::kModelNumber, model);
  image_[at::kFirmwareVersion] = version();
  image_[at::kId] = id;
  image_[at::kBaudRate] = dxl::baud_rate_code(baud);
  image_[at::kReturnDelay] = kFactoryDelay;
}

void SensorRegisters::add(const hal::ImuSample& sample) {
  if (now_us_ - begun_us_ > hal::kImuMostPause_us) {
    mean_ = {};
    begun_us_ = now_us_;
  }
  mean_.add(sample);
  note_sample();
}

void SensorRegisters::set(const std::uint16_t (&counts)[4]) {
  for (int i = 0; i < 4; ++i) dxl::put_u16(image_ + block::kFoot + 2 * i, counts[i]);
  note_sample();
}

void SensorRegisters::refresh() {
  hal::ImuSample sample;
  if (!mean_.take(sample)) return;  // the last one, which is fresh
  begun_us_ = now_us_;
  for (int axis = 0; axis < 3; ++axis) {
    dxl::put_u16(image_ + block::kGyro + 2 * axis,
                 static_cast<std::uint16_t>(sample.gyro_count[axis]));
    dxl::put_u16(image_ + block::kAccel + 2 * axis,
                 static_cast<std::uint16_t>(sample.accel_count[axis]));
  }
}

const std::uint8_t* SensorRegisters::read(std::uint16_t address, std::size_t size) {
  const std::size_t end = address + size;
  if (size == 0 || end > kBytes) return nullptr;
  if (end > block::kAddress) {
    if (!fresh()) return nullptr;
    refresh();
  }
  return image_ + address;
}

dxl::Error SensorRegisters::write(std::uint16_t address, const std::uint8_t* data,
                                  std::size_t size) {
  const auto rule = [](std::uint16_t where) -> dxl::WriteRule {
    if (where == at::kReturnDelay) return {1, true, 0, 254};
    if (where == at::kLed) return {1, true, 0, 1};
    return {};
  };
  const dxl::Error error = dxl::check_write(address, data, size, rule);
  if (error != dxl::Error::kNone) return error;
  for (std::size_t i = 0; i < size; ++i) image_[address + i] = data[i];
  return error;
}

}  // namespace verp::app
