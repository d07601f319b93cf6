#include "tests/support/stm32/imu_device.hpp"

namespace verp::hal::stm32::model {
namespace {

// MPU-9250: no banks.
constexpr std::uint8_t kMpuDivider = 0x19, kMpuIntStatus = 0x3A, kMpuData = 0x3B,
                       kMpuDataEnd = 0x48, kMpuPower = 0x6B, kMpuWho = 0x75;
// ICM-20648: bank 0, but the dividers are in bank 2.
constexpr std::uint8_t kIcmWho = 0x00, kIcmPower = 0x06, kIcmIntStatus1 = 0x1A, kIcmData = 0x2D,
                       kIcmDataEnd = 0x3A, kIcmBank = 0x7F, kIcmDivider2 = 0x00;
constexpr std::uint8_t kReset = 0x80, kSleep = 0x40;

}  // namespace

ImuDevice::ImuDevice(ImuKind kind) : kind_(kind) {
  power_on();
}

void ImuDevice::power_on() {
  for (auto& bank : registers_) {
    for (std::uint8_t& value : bank) value = 0;
  }
  if (mpu()) {
    registers_[0][kMpuPower] = 0x01;
    registers_[0][kMpuWho] = 0x71;
  } else {
    registers_[0][kIcmWho] = 0xE0;
    registers_[0][kIcmPower] = 0x41;
    registers_[2][kIcmDivider2] = 0x00;
  }
}

void ImuDevice::motion(const std::int16_t (&gyro)[3], const std::int16_t (&accel)[3]) {
  for (int i = 0; i < 3; ++i) {
    gyro_[i] = gyro[i];
    accel_[i] = accel[i];
  }
}

unsigned ImuDevice::bank() const {
  return mpu() ? 0u : static_cast<unsigned>(registers_[0][kIcmBank] >> 4 & 3);
}
bool ImuDevice::asleep() const {
  return (registers_[0][mpu() ? kMpuPower : kIcmPower] & kSleep) != 0;
}
Time ImuDevice::period() const {
  if (mpu()) return us(1000) * (registers_[0][kMpuDivider] + 1u);
  return kSecond / 1125 * (registers_[2][kIcmDivider2] + 1u);
}
std::uint32_t ImuDevice::max_hz() const {
  // MPU-9250: 1 MHz for all registers, 20 MHz to read sensor and interrupt registers (PS-MPU-9250A
  // table 6). ICM-20648: 7 MHz (DS-000179 table 4).
  if (!mpu()) return 7000000;
  const bool fast =
      addressed_ && reading_ && pointer_ >= kMpuIntStatus && pointer_ <= kMpuDataEnd + 1;
  return fast || !addressed_ ? 20000000 : 1000000;
}

void ImuDevice::sample() {
  ++samples_;
  std::uint8_t* data = &registers_[0][mpu() ? kMpuData : kIcmData];
  const auto put = [data](int at, std::int16_t value) {
    data[at] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(value) >> 8);
    data[at + 1] = static_cast<std::uint8_t>(value & 0xFF);
  };
  // MPU-9250: acceleration, temperature, rates. ICM-20648: acceleration, rates, temperature.
  const int gyro_at = mpu() ? 8 : 6;
  for (int i = 0; i < 3; ++i) {
    put(2 * i, accel_[i]);
    put(gyro_at + 2 * i, gyro_[i]);
  }
  registers_[0][mpu() ? kMpuIntStatus : kIcmIntStatus1] |= 1;
}

void ImuDevice::update(Time now) {
  if (asleep() || now < ready_at_) {
    sample_at_ = now + period();
    return;
  }
  if (frozen || now < sample_at_) return;
  sample();
  const Time late = (now - sample_at_) / period();
  sample_at_ += (late + 1) * period();
}

std::uint8_t ImuDevice::read(std::uint8_t address, Time now) {
  if (now < ready_at_) return 0;
  const bool who = address == (mpu() ? kMpuWho : kIcmWho) && bank() == 0;
  if (who && who_am_i >= 0) return static_cast<std::uint8_t>(who_am_i);
  const std::uint8_t value = registers_[address == kIcmBank && !mpu() ? 0 : bank()][address];
  const bool status = bank() == 0 && address == (mpu() ? kMpuIntStatus : kIcmIntStatus1);
  if (status) registers_[0][address] = 0;
  return value;
}

void ImuDevice::write(std::uint8_t address, std::uint8_t value, Time now) {
  if (now < ready_at_) {
    ++violations_;
    return;
  }
  const bool power = bank() == 0 && address == (mpu() ? kMpuPower : kIcmPower);
  if (power && (value & kReset) != 0) {
    power_on();
    ready_at_ = now + reset_time;
    return;
  }
  const bool data = bank() == 0 && (mpu() ? address >= kMpuIntStatus && address <= kMpuDataEnd
                                          : address >= kIcmData && address <= kIcmDataEnd);
  if (data || (bank() == 0 && address == (mpu() ? kMpuWho : kIcmWho))) {
    ++violations_;  // read-only
    return;
  }
  const bool was_asleep = asleep();
  registers_[address == kIcmBank && !mpu() ? 0 : bank()][address] = value;
  if (was_asleep && !asleep()) sample_at_ = now + period();
}

void ImuDevice::select(bool selected, Time now) {
  addressed_ = false;
  if (selected) update(now);  // what is read in one go is of one sample
}

std::uint8_t ImuDevice::exchange(std::uint8_t out, Time now) {
  if (silent) return 0xFF;
  if (!addressed_) {
    addressed_ = true;
    reading_ = (out & 0x80) != 0;
    pointer_ = out & 0x7F;
    return 0;
  }
  std::uint8_t in = 0;
  if (reading_) {
    in = read(pointer_, now);
  } else {
    write(pointer_, out, now);
  }
  pointer_ = (pointer_ + 1) & 0x7F;
  return in;
}

}  // namespace verp::hal::stm32::model
