#pragma once
#include <chrono>
#include <thread>

#include "host/os/link/system_clock.hpp"
#include "tests/contract/can_chips.hpp"
#include "tests/contract/chip_models.hpp"
#include "tests/contract/fakes.hpp"
#include "tests/contract/pc/buses.hpp"
#include "tests/contract/pc/cameras.hpp"
#include "tests/contract/pc/imus.hpp"
#include "tests/contract/pc/lasers.hpp"
#include "tests/contract/pc/link_pairs.hpp"
#include "tests/contract/pc/virtual_wire.hpp"
#include "tests/contract/usb_pair.hpp"

namespace verp::test {

struct System {
  static void spend(std::uint32_t time_us) {
    std::this_thread::sleep_for(std::chrono::microseconds(time_us));
  }
  link::SystemClock source;
};

using FrameBuses = ::testing::Types<
    Scripted, ScriptedInPieces, UsartBus, Virtual, Remote, RemoteOver<SerialPair<false>>,
    RemoteOver<TcpPair<false>>, RemoteOver<TcpPair<true>>, RemoteOver<UnixPair<false>>,
    LockstepOver<SerialPair<false>>, LockstepOver<SerialPair<true>>, LockstepOver<TcpPair<false>>,
    LockstepOver<UnixPair<true>>, LinkBusOver<SerialPair<false>>, LinkBusOver<TcpPair<false>>,
    LinkBusOver<UnixPair<true>>>;
using CanBuses =
    ::testing::Types<ScriptedWire, VirtualWire, Sja1000Chip, ZynqmpSilicon, ZynqmpQemu,
                     ChipCan<Family::kF405>, ChipCan<Family::kF446>, ChipCan<Family::kF746>>;
using ByteLinks =
    ::testing::Types<MemoryPair, UsartPair, UsbPair<Family::kF405, true>,
                     UsbPair<Family::kF746, false>, SerialPair<false>, SerialPair<true>,
                     TcpPair<false>, TcpPair<true>, UnixPair<false>, UnixPair<true>>;
using Stores = ::testing::Types<InMemory, InFlash<1>, InFlash<2>, InFlash<4>, InFlash<8>,
                                ChipFlash<Family::kF405>, ChipFlash<Family::kF746>>;
using TickSources = ::testing::Types<Manual, ChipTicks, System>;
using Watchdogs =
    ::testing::Types<FakeDog<100>, FakeDog<150>, FakeDog<100 * hal::kWatchdogSlack>,
                     ChipWatchdog<17'000>, ChipWatchdog<32'000>, ChipWatchdog<47'000>>;
using RangeFinders = ::testing::Types<ScriptedLaser, ScipLaser, TwinLaser>;
using Cameras = ::testing::Types<ScriptedEye, KernelEye, KernelEyeOfFiles, TwinEye>;
using Imus = ::testing::Types<ScriptedChip, Mpu9250, Icm20648, Bno055OnI2c, Bno055OnUart,
                              Mpu6050Rig, Icm42688Rig>;

}  // namespace verp::test
