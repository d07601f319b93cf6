#pragma once
#include "tests/contract/can_chips.hpp"
#include "tests/contract/chip_models.hpp"
#include "tests/contract/fakes.hpp"

/// Register models are slow there, so only one chip.
namespace verp::test {

using FrameBuses = ::testing::Types<Scripted, ScriptedInPieces, UsartBus>;
using CanBuses =
    ::testing::Types<ScriptedWire, Sja1000Chip, ZynqmpSilicon, ZynqmpQemu, ChipCan<Family::kF405>>;
using ByteLinks = ::testing::Types<MemoryPair, UsartPair>;
using Stores = ::testing::Types<InMemory, InFlash<1>, InFlash<2>, InFlash<4>, InFlash<8>,
                                ChipFlash<Family::kF405>>;
using TickSources = ::testing::Types<Manual, ChipTicks>;
using Watchdogs =
    ::testing::Types<FakeDog<100>, FakeDog<150>, FakeDog<100 * hal::kWatchdogSlack>,
                     ChipWatchdog<17'000>, ChipWatchdog<32'000>, ChipWatchdog<47'000>>;
using RangeFinders = ::testing::Types<ScriptedLaser>;
using Cameras = ::testing::Types<ScriptedEye>;
using Imus = ::testing::Types<ScriptedChip, Mpu9250, Icm20648>;

}  // namespace verp::test
