#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "firmware/app/app.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

/// This header defines step(), so each source file is its own program.
namespace verp {

namespace test {
inline Outputs wanted;
}

// Replaces the core's step(); the test sets its outputs.
void step(const Params&, const action::Library&, State& state, const Inputs&,
          Outputs& outputs) noexcept {
  ++state.digest.chain;
  outputs = test::wanted;
}

namespace test {

struct Script {
  app::OperatorOrder order(std::uint32_t tick) {
    asked.push_back(tick);
    return next;
  }
  app::OperatorOrder next;
  std::vector<std::uint32_t> asked;
};

struct Memory {
  void record(const TickRecord& record, const State&, const Outputs&) { records.push_back(record); }
  std::vector<TickRecord> records;
};

/// Can lose, record or corrupt frames.
struct Tap final : hal::FrameBus {
  explicit Tap(bus::VirtualBus& of) : bus(of) {}
  bool send(const std::uint8_t* data, std::size_t size) override {
    frames.emplace_back(data, data + size);
    if (lost.count(frames.size() - 1) > 0) return true;
    if (lose_sends > 0 && --lose_sends >= 0) return true;
    return bus.send(data, size);
  }
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    ++polls;
    std::size_t kept = 0;
    const std::size_t count = bus.poll(buffer, capacity, timeout_us);
    for (std::size_t i = 0; i < count; ++i) {
      const auto fault = faults_per_mille == 0 ? 1000 : noise() % 1000;
      if (fault < faults_per_mille / 2) continue;
      buffer[kept++] = fault < faults_per_mille ? static_cast<std::uint8_t>(noise()) : buffer[i];
    }
    return kept;
  }
  std::uint64_t now_us() override { return bus.now_us(); }
  bus::VirtualBus& bus;
  std::vector<std::vector<std::uint8_t>> frames;
  int lose_sends = 0;
  std::set<std::size_t> lost{};  ///< indices in `frames`
  int polls = 0;
  unsigned faults_per_mille = 0;  ///< of received bytes: lost or changed
  std::minstd_rand noise{};
};

class AppLoop : public ::testing::Test {
 protected:
  static constexpr int kJoints = 21;
  AppLoop() {
    wanted = {};
    for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = 1000 + j;
  }
  void ready() { ASSERT_EQ(app.bring_up().status, app::BringUpStatus::kReady); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) app.tick();
  }
  static std::uint32_t all() { return (1u << kJoints) - 1; }
  static std::uint32_t without(int joint) { return all() & ~(1u << joint); }
  int frames_of(dxl::Instruction instruction) const {
    int count = 0;
    for (const auto& frame : tap.frames) count += frame[7] == static_cast<int>(instruction);
    return count;
  }

  Params params = bus_params(kJoints);
  FakePlant plant;
  bus::VirtualBus bus{params, plant};
  Tap tap{bus};
  Script script;
  Memory memory;
  app::App<Tap, Script, Memory> app{params, tap, script, memory};
};

}  // namespace test
}  // namespace verp
