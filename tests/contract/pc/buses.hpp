#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "firmware/app/link_bus.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "firmware/app/remote_bus.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/bus_server.hpp"
#include "host/twin/bus/lockstep_server.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/contract/fakes.hpp"
#include "tests/contract/pc/link_pairs.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/bus/pipes.hpp"
#include "tests/support/link_pump.hpp"
#include "tests/support/link_stream.hpp"

/// Only on the PC, prepared as in fakes.hpp.
namespace verp::test {

struct Virtual : SimulatedTime {
  explicit Virtual(int) {}
  Params params = bus_params(2);
  FakePlant plant;
  bus::VirtualBus bus{params, plant};
};

/// Over FIFOs, as an emulated microcontroller.
struct Remote : SimulatedTime {
  explicit Remote(int) {
    server = std::thread(
        [this] { bus::BusServer(params, virtual_bus, server_streams(pipes), {}, {}).serve(); });
    EXPECT_TRUE(bus.hello(received));
  }
  ~Remote() {
    pipes.from_controller.close_write_end();
    server.join();
  }
  Params params = bus_params(2);
  Params received;
  FakePlant plant;
  bus::VirtualBus virtual_bus{params, plant};
  PipePair pipes;
  PipeEnd in{pipes.to_controller};
  PipeEnd out{pipes.from_controller};
  std::thread server;
  app::RemoteBus<PipeEnd, PipeEnd> bus{in, out};
};

/// Over any ByteLink.
template <class Pair>
struct RemoteOver : SimulatedTime {
  using Stream = app::LinkStream<link::Link>;
  explicit RemoteOver(int) {
    server = std::thread([this] {
      bus::ByteStreams streams;
      streams.read_some = [this](void* data, std::size_t size) {
        return far.read_some(data, size);
      };
      streams.write = [this](const void* data, std::size_t size) { return far.write(data, size); };
      bus::BusServer(params, virtual_bus, streams, {}, {}).serve();
    });
    EXPECT_TRUE(bus.hello(received));
  }
  ~RemoteOver() {
    bus.quit(0, "done");
    server.join();
  }
  Params params = bus_params(2);
  Params received;
  FakePlant plant;
  bus::VirtualBus virtual_bus{params, plant};
  Pair pair;
  Stream near{pair.near()};
  Stream far{pair.far()};
  std::thread server;
  app::RemoteBus<Stream, Stream> bus{near, near};
};

/// In lockstep, as a board with a serial port.
template <class Pair>
struct LockstepOver : SimulatedTime {
  explicit LockstepOver(int) {
    server = std::thread([this] {
      bus::LinkPump pump(pair.far(), service);
      while (!over) pump.turn(1000);
    });
    EXPECT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  }
  ~LockstepOver() {
    over = true;
    server.join();
  }
  struct Idle {
    bool operator()() const { return true; }
  };
  Params params = bus_params(2);
  FakePlant plant;
  bus::VirtualBus virtual_bus{params, plant};
  bus::LockstepServer service{params, virtual_bus, {}};
  Pair pair;
  std::atomic<bool> over = false;
  std::thread server;
  app::LockstepBus<link::Link, Idle> bus{pair.near(), Idle{}};
};

/// In real time at a ByteLink's far end.
template <class Pair>
struct LinkBusOver {
  static constexpr std::uint32_t kPlenty_us = 300'000;
  static constexpr std::uint64_t kSlack_us = 150'000;

  explicit LinkBusOver(int pings) {
    servo = std::thread([this, pings] {
      std::vector<std::uint8_t> heard;
      std::uint8_t piece[64];
      for (int answered = 0; !over;) {
        const std::size_t count = pair.far().read(piece, sizeof piece, 5000);
        heard.insert(heard.end(), piece, piece + count);
        if (heard.size() < kPing.size()) continue;
        heard.erase(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(kPing.size()));
        if (answered++ == pings) continue;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const std::vector<std::uint8_t> reply = ping_reply();
        pair.far().write(reply.data(), reply.size(), kPlenty_us);
      }
    });
  }
  ~LinkBusOver() {
    over = true;
    servo.join();
  }
  Pair pair;
  link::SystemClock clock;
  app::LinkBus<link::Link, link::SystemClock> bus{pair.near(), clock};
  std::atomic<bool> over = false;
  std::thread servo;
};

}  // namespace verp::test
