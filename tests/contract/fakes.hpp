#pragma once
#include <cstdint>
#include <vector>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/store/flash_store.hpp"
#include "hal/fake/fake_flash.hpp"
#include "hal/fake/fake_watchdog.hpp"
#include "hal/fake/manual_clock.hpp"
#include "hal/fake/memory_link.hpp"
#include "hal/fake/memory_store.hpp"
#include "hal/fake/scripted_bus.hpp"
#include "hal/fake/scripted_camera.hpp"
#include "hal/fake/scripted_can.hpp"
#include "hal/fake/scripted_imu.hpp"
#include "hal/fake/scripted_range_finder.hpp"

namespace verp::test {

/// A FrameBus backend for `pings` pings of servo 1, which kPlenty_us suffices to answer. kSlack_us:
/// its clock's error while it should stand; 0 in simulated time.
inline const std::vector<std::uint8_t> kPing = {0xFF, 0xFF, 0xFD, 0x00, 0x01,
                                                0x03, 0x00, 0x01, 0x19, 0x4E};

inline std::vector<std::uint8_t> ping_reply() {
  std::vector<std::uint8_t> reply(32);
  const std::uint8_t identity[] = {0x06, 0x04, 45};
  reply.resize(dxl::encode_status(reply.data(), reply.size(), 1, 0, identity, 3));
  return reply;
}

struct SimulatedTime {
  static constexpr std::uint32_t kPlenty_us = 20'000;
  static constexpr std::uint64_t kSlack_us = 0;
};

struct Scripted : SimulatedTime {
  explicit Scripted(int pings) {
    const auto reply = ping_reply();
    for (int i = 0; i < pings; ++i) {
      bus.expect(kPing.data(), kPing.size(), reply.data(), reply.size(), 200);
    }
  }
  hal::ScriptedBus bus;
};

struct ScriptedInPieces : Scripted {
  explicit ScriptedInPieces(int pings) : Scripted(pings) { bus.set_piece(3); }
};

/// A CanBus backend: `bus` is one node, the test the other. far_send() sends once the wire is free;
/// far_take() returns the next frame received there. kPlenty_us suffices for hal::kCanQueue frames.
struct ScriptedWire : SimulatedTime {
  static constexpr bool kBusOff = true;
  void far_send(const CanFrame& frame) { bus.inject(frame, bus.now_us() + 100); }
  bool far_take(CanFrame& frame) { return bus.take_sent(frame); }
  void fill_and_bus_off(const CanFrame& frame, int count) {
    bus.hold(true);
    for (int i = 0; i < count; ++i) bus.send(frame);
    bus.bus_off();
    bus.hold(false);
  }
  hal::ScriptedCan bus;
};

/// A ByteLink backend: near() is under test; cut() removes the far end, mend() restores it.
struct MemoryPair {
  static constexpr bool kDetectsLoss = true;
  static constexpr bool kKeepsBytesOnLoss = true;
  hal::MemoryLink& near() { return wire.left(); }
  hal::MemoryLink& far() { return wire.right(); }
  void cut() { wire.cut(); }
  void mend() { wire.mend(); }
  std::uint64_t now_us() const { return wire.now_us(); }
  hal::MemoryWire wire;
};

struct InMemory {
  hal::MemoryStore store;
};

template <std::size_t kUnit>
struct InFlash {
  using Flash = hal::FakeFlash<4096, kUnit>;
  InFlash() { store.open(); }
  Flash flash;
  store::FlashStore<Flash> store{flash};
};

struct Manual {
  void spend(std::uint32_t time_us) { source.advance(time_us); }
  hal::ManualClock source;
};

/// The watchdog waits kPercent of its timeout.
template <std::uint32_t kPercent>
struct FakeDog {
  hal::FakeWatchdog dog{kPercent};
};

/// An Imu backend. measure(gyro_x) takes one sample with this value. break_chip(yes) stops or
/// restores answers. settle() gives time to come up, without samples.
struct ScriptedChip {
  void measure(std::int16_t gyro_x) { imu.measure({{gyro_x, 0, 0}, {0, 0, 0}, time_us += 8000}); }
  void break_chip(bool yes) { broken = yes; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    if (broken) imu.fail(1);
    return imu.read(sample);
  }
  std::uint32_t faults() const { return imu.faults(); }
  void settle() {}

  hal::ScriptedImu imu;
  std::uint64_t time_us = 0;
  bool broken = false;
};

struct ScriptedLaser {
  static constexpr std::size_t kSteps = 21;
  static constexpr bool kBreaks = true;
  /// 1 m ahead, nothing elsewhere.
  void turn() {
    hal::RangeScan scan;
    scan.time_us = time_us += 50'000;
    scan.steps = kSteps;
    scan.range_mm[kSteps / 2] = 1000;
    laser.measure(scan);
  }
  void break_it(bool silent) { broken = silent; }
  void wait() {}
  hal::RangeStatus read(hal::RangeScan& scan) {
    if (broken) laser.fail(1);
    return laser.read(scan);
  }
  std::uint32_t faults() const { return laser.faults(); }

  hal::ScriptedRangeFinder laser;
  std::uint64_t time_us = 0;
  bool broken = false;
};

/// A Camera backend. show() makes the next picture; is(frame, n) checks that the bytes are picture
/// n, from 0. break_it(yes) unplugs or replugs it; after wait() the next read looks for it.
struct ScriptedEye {
  static constexpr std::uint32_t kWidth = 4, kHeight = 2;
  static constexpr bool kBreaks = true;
  void show() {
    std::uint8_t* bytes = pictures[next % kPictures];
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i)
      bytes[i] = static_cast<std::uint8_t>(7 * next + i);
    camera.show({.width_px = kWidth,
                 .height_px = kHeight,
                 .format = hal::PixelFormat::kGrey,
                 .stride_bytes = kWidth,
                 .time_us = time_us += 33'000,
                 .data = bytes,
                 .size_bytes = kWidth * kHeight});
    ++next;
  }
  bool is(const hal::CameraFrame& frame, std::uint32_t number) const {
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      if (frame.data[i] != static_cast<std::uint8_t>(7 * number + i)) return false;
    }
    return true;
  }
  void break_it(bool unplugged) { broken = unplugged; }
  void wait() {}
  hal::CameraStatus read(hal::CameraFrame& frame) {
    if (broken) camera.fail(1);
    return camera.read(frame);
  }
  std::uint32_t faults() const { return camera.faults(); }

  static constexpr std::uint32_t kPictures = 32;
  std::uint8_t pictures[kPictures][kWidth * kHeight] = {};
  hal::ScriptedCamera camera;
  std::uint32_t next = 0;
  std::uint64_t time_us = 0;
  bool broken = false;
};

}  // namespace verp::test
