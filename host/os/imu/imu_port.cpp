#include "host/os/imu/imu_port.hpp"

#include <cstdio>
#include <optional>

#include "hal/chip/bosch/bno055.hpp"
#include "hal/chip/bosch/bno055_uart.hpp"
#include "hal/chip/invensense/icm42688.hpp"
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/invensense/register_spi.hpp"
#include "host/os/imu/chips.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::imu {
namespace {

using Clock = link::SystemClock;
using Kind = link::LinkError::Kind;

constexpr std::uint32_t kStep_us = 5'000;
/// Power-up (0.65 s), then the driver's own reset (0.8 s), and a margin.
constexpr std::uint32_t kMostStart_us = 3'000'000;
/// The chip has to answer by then.
constexpr std::uint32_t kMostSilent_us = 1'000'000;

std::string hex(unsigned value) {
  char text[8];
  std::snprintf(text, sizeof text, "0x%02x", value);
  return text;
}

link::Endpoint uart_at(const std::string& device) {
  return {.kind = link::Endpoint::Kind::kSerial,
          .place = device,
          .baud = hal::bosch::Bno055Uart<Clock>::kBaud};
}

/// A chip of ours at another address of the bus, as words for --imu; empty: none.
std::string elsewhere(const ImuPlace& place, I2cCalls& calls) {
  constexpr std::uint8_t kAddresses[] = {0x28, 0x29, 0x68, 0x69};
  for (const std::uint8_t address : kAddresses) {
    if (address == place.address) continue;
    I2cBus bus(place.device, address, calls);
    if (const ChipType* type = identify(bus)) {
      return "i2c:" + place.device + "," + type->name + ",address=" + hex(address);
    }
  }
  return "";
}

template <class Driver>
Collect kept(std::shared_ptr<Driver> driver) {
  return [driver](hal::ImuMean& mean, std::uint64_t& time_us) {
    return driver->collect(mean, time_us);
  };
}

struct Mpu6050 : hal::invensense::RegisterSpi {
  Mpu6050(hal::RegisterBus& bus, const Clock& clock) : RegisterSpi(bus), sensor(*this, clock) {}
  hal::ImuStatus collect(hal::ImuMean& mean, std::uint64_t& time_us) {
    return sensor.collect(mean, time_us);
  }
  hal::invensense::MotionSensor<RegisterSpi, Clock, hal::invensense::I2cKinds> sensor;
};

Collect driver_of(Chip chip, hal::RegisterBus& bus, const Clock& clock) {
  switch (chip) {
    case Chip::kMpu6050:
      return kept(std::make_shared<Mpu6050>(bus, clock));
    case Chip::kIcm42688p:
      return kept(std::make_shared<hal::invensense::Icm42688<Clock>>(bus, clock));
    case Chip::kBno055:
    default:
      return kept(std::make_shared<hal::bosch::Bno055<Clock>>(bus, clock));
  }
}

}  // namespace

struct ImuPort::Bus {
  Bus(const ImuPlace& place, I2cCalls& calls) {
    if (place.serial) {
      link.emplace(uart_at(place.device));
      uart.emplace(*link, clock);
    } else {
      i2c.emplace(place.device, place.address, calls);
    }
    collect = driver_of(place.chip, registers(), clock);
  }
  hal::RegisterBus& registers() { return uart ? static_cast<hal::RegisterBus&>(*uart) : *i2c; }
  Clock clock;
  std::optional<link::Link> link;
  std::optional<hal::bosch::Bno055Uart<Clock>> uart;
  std::optional<I2cBus> i2c;
  Collect collect;
};

ImuPort::ImuPort(const ImuPlace& place, const std::function<bool()>& interrupted, I2cCalls& calls)
    : bus_(std::make_unique<Bus>(place, calls)),
      reader_(std::make_unique<ImuReader>(bus_->collect)) {
  const std::uint64_t begun_us = bus_->clock.now_us();
  bool answered = false;
  while (!interrupted()) {
    const hal::ImuStatus status = reader_->turn();
    if (status == hal::ImuStatus::kFresh) return;
    answered = answered || status == hal::ImuStatus::kStale;
    const std::uint64_t waited_us = bus_->clock.now_us() - begun_us;
    if (waited_us > kMostStart_us || (!answered && waited_us > kMostSilent_us)) {
      refuse_silent(place, calls);
    }
    link::sleep_until_ns(link::monotonic_ns() + kStep_us * 1000);
  }
}

ImuPort::~ImuPort() = default;

void ImuPort::start(int priority) {
  constexpr std::uint32_t kPause_us = 2'500;  // faster than any chip's samples here
  reader_->start(kPause_us, priority);
}

void ImuPort::refuse_silent(const ImuPlace& place, I2cCalls& calls) {
  const ChipType& wanted = type_of(place.chip);
  const std::string where = to_text(place) + ": ";
  const ChipType* found = identify(bus_->registers());
  if (found != nullptr && found != &wanted) {
    throw link::LinkError(Kind::kUnsuitable, where + "the chip there is " + found->name +
                                                 "; give --imu i2c:" + place.device + "," +
                                                 found->name + ",address=" + hex(place.address));
  }
  if (found != nullptr) {
    throw link::LinkError(Kind::kUnsuitable,
                          where +
                              "it answers, and does not begin to measure: it is reset again "
                              "and again, or its supply dips; check RST and 3.3 V");
  }
  const std::string other = place.serial ? "" : elsewhere(place, calls);
  if (!other.empty()) {
    throw link::LinkError(Kind::kNoDevice, where + "no chip answers there; give --imu " + other);
  }
  throw link::LinkError(
      Kind::kNoDevice,
      where + "no such chip answers" +
          (place.serial ? " at 115200 baud; check 3.3 V, its TX to RX here and RX to TX, "
                        : "; check 3.3 V, SDA and SCL, which sudo i2cdetect -y BUS shows, ") +
          wanted.wiring);
}

}  // namespace verp::imu
