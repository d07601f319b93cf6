#include "tests/support/stm32/imu_device.hpp"

namespace verp::hal::stm32::model {
namespace {

// MPU-9250: no banks.
constexpr std::uint8_t kMpuDivider = 0x19, kMpuConfig = 0x1A, kMpuFifoEnable = 0x23,
                       kMpuIntStatus = 0x3A, kMpuData = 0x3B, kMpuDataEnd = 0x48, kMpuUser = 0x6A,
                       kMpuPower = 0x6B, kMpuFifoSize = 0x72, kMpuFifo = 0x74, kMpuWho = 0x75;
// ICM-20648: bank 0, except the dividers in bank 2.
constexpr std::uint8_t kIcmWho = 0x00, kIcmUser = 0x03, kIcmPower = 0x06, kIcmIntStatus1 = 0x1A,
                       kIcmIntStatus2 = 0x1B, kIcmData = 0x2D, kIcmDataEnd = 0x3A,
                       kIcmFifoEnable2 = 0x67, kIcmFifoReset = 0x68, kIcmFifoMode = 0x69,
                       kIcmFifoSize = 0x70, kIcmFifo = 0x72, kIcmBank = 0x7F, kIcmDivider2 = 0x00;
constexpr std::uint8_t kReset = 0x80, kSleep = 0x40;
constexpr std::uint8_t kFifoOn = 0x40, kMpuFifoReset = 0x04, kMpuFifoStops = 0x40;

}  // namespace

/// The FIFO has the order of the data registers.
struct ImuDevice::Map {
  std::uint8_t who, power, user, status, overflow_status, overflow, data, fifo_size, fifo;
  std::uint8_t fifo_enable, selects_accel, selects_gyro[3], selects_temperature;
  int gyro_at, temperature_at;
};
const ImuDevice::Map& ImuDevice::map() const {
  static constexpr Map kMpu = {.who = kMpuWho,
                               .power = kMpuPower,
                               .user = kMpuUser,
                               .status = kMpuIntStatus,
                               .overflow_status = kMpuIntStatus,
                               .overflow = 0x10,
                               .data = kMpuData,
                               .fifo_size = kMpuFifoSize,
                               .fifo = kMpuFifo,
                               .fifo_enable = kMpuFifoEnable,
                               .selects_accel = 0x08,
                               .selects_gyro = {0x40, 0x20, 0x10},
                               .selects_temperature = 0x80,
                               .gyro_at = 8,
                               .temperature_at = 6};
  static constexpr Map kIcm = {.who = kIcmWho,
                               .power = kIcmPower,
                               .user = kIcmUser,
                               .status = kIcmIntStatus1,
                               .overflow_status = kIcmIntStatus2,
                               .overflow = 0x01,
                               .data = kIcmData,
                               .fifo_size = kIcmFifoSize,
                               .fifo = kIcmFifo,
                               .fifo_enable = kIcmFifoEnable2,
                               .selects_accel = 0x10,
                               .selects_gyro = {0x02, 0x04, 0x08},
                               .selects_temperature = 0x01,
                               .gyro_at = 6,
                               .temperature_at = 12};
  return mpu() ? kMpu : kIcm;
}

ImuDevice::ImuDevice(ImuKind kind) : kind_(kind) {
  power_on();
}

void ImuDevice::power_on() {
  for (auto& bank : registers_) {
    for (std::uint8_t& value : bank) value = 0;
  }
  fifo_.clear();
  on_the_way_.clear();
  if (mpu()) {
    registers_[0][kMpuPower] = kind_ == ImuKind::kMpu6050 ? kSleep : 0x01;
    registers_[0][kMpuWho] = kind_ == ImuKind::kMpu6050 ? 0x68 : 0x71;
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
  return (registers_[0][map().power] & kSleep) != 0;
}
Time ImuDevice::period() const {
  if (mpu()) return us(1000) * (registers_[0][kMpuDivider] + 1u);
  return kSecond / 1125 * (registers_[2][kIcmDivider2] + 1u);
}
std::uint32_t ImuDevice::max_hz() const {
  // MPU-9250: 1 MHz for all registers, 20 MHz for sensor and interrupt registers (PS-MPU-9250A
  // table 6); the FIFO, not in the table: 10 MHz. ICM-20648: 7 MHz (DS-000179 table 4).
  if (!mpu()) return 7000000;
  if (!addressed_) return 20000000;
  if (reading_ && pointer_ >= kMpuFifoSize && pointer_ <= kMpuFifo) return 10000000;
  const bool fast = reading_ && pointer_ >= kMpuIntStatus && pointer_ <= kMpuDataEnd + 1;
  return fast ? 20000000 : 1000000;
}

void ImuDevice::sample() {
  before_sample();
  ++samples_;
  std::uint8_t* data = &registers_[0][map().data];
  const auto put = [data](int at, std::int16_t value) {
    data[at] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(value) >> 8);
    data[at + 1] = static_cast<std::uint8_t>(value & 0xFF);
  };
  // MPU-9250: acceleration, temperature, rates. ICM-20648: temperature last.
  for (int i = 0; i < 3; ++i) {
    put(2 * i, accel_[i]);
    put(map().gyro_at + 2 * i, gyro_[i]);
  }
  registers_[0][map().status] |= 1;
  put_in_fifo();
}

bool ImuDevice::fifo_is_on() const {
  const bool held = !mpu() && registers_[0][kIcmFifoReset] != 0;
  return (registers_[0][map().user] & kFifoOn) != 0 && !held;
}

void ImuDevice::put_in_fifo() {
  let_in(0);
  if (!fifo_is_on()) return;
  const std::uint8_t selected = registers_[0][map().fifo_enable];
  for (int at = 0; at < 14; at += 2) {
    const int axis = (at - map().gyro_at) / 2;
    const std::uint8_t bit = at < 6                       ? map().selects_accel
                             : at == map().temperature_at ? map().selects_temperature
                                                          : map().selects_gyro[axis];
    if ((selected & bit) == 0) continue;
    on_the_way_.push_back(registers_[0][map().data + at]);
    on_the_way_.push_back(registers_[0][map().data + at + 1]);
  }
  let_in(torn);
}

void ImuDevice::let_in(std::size_t but) {
  for (; on_the_way_.size() > but; on_the_way_.pop_front()) push(on_the_way_.front());
}

void ImuDevice::push(std::uint8_t byte) {
  const bool full = fifo_.size() == kFifoSize;
  const bool stops =
      mpu() ? (registers_[0][kMpuConfig] & kMpuFifoStops) != 0 : registers_[0][kIcmFifoMode] != 0;
  if (full) registers_[0][map().overflow_status] |= map().overflow;
  if (full && stops) return;
  if (full) fifo_.pop_front();
  fifo_.push_back(byte);
}

void ImuDevice::slip(std::size_t bytes) {
  for (; bytes > 0 && !fifo_.empty(); --bytes) fifo_.pop_front();
}

void ImuDevice::update(Time now) {
  let_in(0);
  if (asleep() || now < ready_at_) {
    sample_at_ = now + period();
    return;
  }
  for (; sample_at_ <= now; sample_at_ += period()) {
    if (!frozen) sample();
  }
}

/// An empty FIFO repeats its last byte. The size's high byte freezes it until the low byte.
std::uint8_t ImuDevice::read_fifo(std::uint8_t address) {
  if (address == map().fifo_size) {
    fifo_size_low_ = static_cast<std::uint8_t>(fifo_.size() & 0xFF);
    return static_cast<std::uint8_t>(fifo_.size() >> 8);
  }
  if (address != map().fifo) return fifo_size_low_;
  if (!fifo_.empty()) {
    fifo_byte_ = fifo_.front();
    fifo_.pop_front();
  }
  return fifo_byte_;
}

/// MPU-9250: the bit clears itself and acts only while the FIFO is off, as older maps say.
/// ICM-20648: keeps the FIFO empty until it is cleared.
void ImuDevice::reset_fifo_if_told(std::uint8_t address, std::uint8_t value) {
  const bool told = mpu() ? address == kMpuUser && (value & kMpuFifoReset) != 0
                          : address == kIcmFifoReset && value != 0;
  if (!told) return;
  if (!mpu() || (value & kFifoOn) == 0) {
    fifo_.clear();
    on_the_way_.clear();
  }
  if (mpu()) registers_[0][kMpuUser] &= static_cast<std::uint8_t>(~kMpuFifoReset);
}

std::uint8_t ImuDevice::read(std::uint8_t address, Time now) {
  if (now < ready_at_) return 0;
  const bool who = address == map().who && bank() == 0;
  if (who && who_am_i >= 0) return static_cast<std::uint8_t>(who_am_i);
  const bool fifo = address >= map().fifo_size && address <= map().fifo && bank() == 0;
  if (fifo) return read_fifo(address);
  const std::uint8_t value = registers_[address == kIcmBank && !mpu() ? 0 : bank()][address];
  const bool status = address == map().status || address == map().overflow_status;
  if (bank() == 0 && status) registers_[0][address] = 0;
  return value;
}

void ImuDevice::write(std::uint8_t address, std::uint8_t value, Time now) {
  if (now < ready_at_) {
    ++violations_;
    return;
  }
  const bool power = bank() == 0 && address == map().power;
  if (power && (value & kReset) != 0) {
    power_on();
    ready_at_ = now + reset_time;
    return;
  }
  const bool data = bank() == 0 && (mpu() ? address >= kMpuIntStatus && address <= kMpuDataEnd
                                          : address >= kIcmData && address <= kIcmDataEnd);
  if (data || (bank() == 0 && address == map().who)) {
    ++violations_;  // read-only
    return;
  }
  const bool was_asleep = asleep();
  registers_[address == kIcmBank && !mpu() ? 0 : bank()][address] = value;
  if (bank() == 0) reset_fifo_if_told(address, value);
  if (was_asleep && !asleep()) sample_at_ = now + period();
}

void ImuDevice::select(bool selected, Time now) {
  addressed_ = false;
  if (selected) update(now);  // one sample per transfer
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
  const bool stays = reading_ && bank() == 0 && pointer_ == map().fifo;
  if (!stays) pointer_ = (pointer_ + 1) & 0x7F;
  return in;
}

}  // namespace verp::hal::stm32::model
