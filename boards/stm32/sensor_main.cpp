#include "boards/stm32/hardware.hpp"
#include "boards/stm32/no_time.hpp"
#include "common/model/image.hpp"
#include "firmware/app/sensor_device.hpp"
#include "firmware/app/start_fault.hpp"
#include "firmware/boot/boot.hpp"
#include "sensor_chip.hpp"

/// sensor_<board>, foot_<board>: the board as the IMU device, or a foot, of a robot on its
/// Dynamixel bus, at the servo port. The robot in its flash decides id, rate and scales. The LED
/// blinks while samples come and stays lit otherwise; it counts a start fault, and then no device
/// answers.
extern "C" const std::uint8_t verp_params_begin[];
extern "C" const std::uint8_t verp_params_bytes[];  ///< the address is the size (memory.ld)

namespace verp::board {
namespace {

using app::table::StartFault;

constexpr std::uint32_t kWatchdog_us = 100'000;
/// A sample that waits must not delay an answer, so it begins in a pause on the bus, but not never.
constexpr std::uint64_t kPause_us = 200;
constexpr std::uint64_t kPatience_us = 5'000;

[[noreturn]] void refuse(StartFault fault) {
  app::LifeSign life;
  for (;;) stm32::Gpio<Io>().write(kLed, life.at(timer.now_us(), fault).lit);
}

const Params& robot() {
  const auto size = reinterpret_cast<std::uintptr_t>(verp_params_bytes);
  if (check_image(verp_params_begin, size) != ImageFault::kNone) refuse(StartFault::kSelfTest);
  return reinterpret_cast<const ParamsImage*>(verp_params_begin)->params;
}

/// Once the answer has left.
[[noreturn]] void start_anew(std::uint64_t now_us) {
  while (timer.now_us() < now_us + kPatience_us) {
  }
  verp_exit(0);
}

[[noreturn]] void serve(app::SensorDevice& device, SensorChip& chip,
                        stm32::IndependentWatchdog<Io>& dog) {
  stm32::Gpio<Io> gpio;
  app::LifeSign life;
  std::uint64_t heard_us = 0, sampled_us = 0;
  for (;;) {
    dog.feed();
    const std::uint64_t now_us = timer.now_us();
    device.registers().set_time(now_us);
    const std::uint64_t since_us = now_us - sampled_us;
    const bool pause = !SensorChip::kWaits || now_us - heard_us > kPause_us;
    if (since_us > kPatience_us || (since_us >= SensorChip::kSample_us && pause)) {
      sampled_us = now_us;
      chip.sample(device.registers());
      const bool blink = life.at(now_us, StartFault::kNone).lit;
      gpio.write(kLed, blink || !device.registers().fresh());
    }
    if (device.poll() || device.reply_waits()) heard_us = now_us;
    if (device.reboot_asked()) start_anew(now_us);
  }
}

}  // namespace
}  // namespace verp::board

extern "C" int verp_main() {
  using namespace verp;
  using board::StartFault;
  const board::Start start = board::start_hardware();
  hal::stm32::Gpio<board::Io>().output(board::kLed, false);
  if (!start.good) board::refuse_without_time(start);
  const Params& params = board::robot();
  if (params.bus_protocol != BusProtocol::kDynamixel2) board::refuse(StartFault::kProtocol);
  static board::SensorChip chip(params);
  if (!chip.open(start) || chip.id() == 0) board::refuse(StartFault::kSelfTest);
  if (!board::open_robot_port(start, params.baud)) board::refuse(StartFault::kServoPort);
  static app::SensorDevice device(board::robot_port, chip.id(), chip.kModel, params.baud);
  hal::stm32::IndependentWatchdog<board::Io> dog(start.cause);
  dog.start(board::kWatchdog_us);
  board::serve(device, chip, dog);
}
