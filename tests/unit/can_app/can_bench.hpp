#pragma once
#include <cstdint>

#include "common/protocol/canopen/bus_load.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/control_table.hpp"
#include "hal/contract/can_bus.hpp"
#include "tests/unit/can_app/can_bench_nodes.hpp"

/// Seven drives, an IMU and two feet on a simulated CAN bus.
namespace verp::test {

inline constexpr int kBenchJoints = 7;
inline constexpr std::uint8_t kBenchImu = 100;
inline constexpr std::uint8_t kBenchFoot = 101;

class CanBench final : public hal::CanBus {
 public:
  CanBench() {
    params.period_us = 10'000;
    params.baud = 1'000'000;
    params.joint_count = kBenchJoints;
    for (int j = 0; j < kBenchJoints; ++j) {
      JointParams& joint = params.joint[j];
      joint.servo_id = static_cast<std::uint8_t>(11 + j);
      joint.counts_per_rad = j % 2 == 0 ? 1000.0F : -1000.0F;
      joint.zero_count = 100;
      joint.lower_rad = -1;
      joint.upper_rad = 2;
    }
    params.servo[0].model_number = DriveNode::kProduct;
    params.imu.device_id = kBenchImu;
    params.feet.device_id[0] = kBenchFoot;
    params.feet.device_id[1] = kBenchFoot + 1;
    for (int axis = 0; axis < 3; ++axis) {
      imu.application.numbers[axis] = {canopen::plan::kGyro[axis],
                                       static_cast<std::uint16_t>(-10 - axis)};
      imu.application.numbers[3 + axis] = {canopen::plan::kAccel[axis],
                                           static_cast<std::uint16_t>(20 + axis)};
    }
    for (int i = 0; i < kFootSensors; ++i) {
      left.application.numbers[i] = {canopen::plan::kFoot[i], static_cast<std::uint16_t>(30 + i)};
      right.application.numbers[i] = {canopen::plan::kFoot[i], static_cast<std::uint16_t>(40 + i)};
    }
  }

  bool send(const CanFrame& frame) override {
    if (down || waiting_ == hal::kCanQueue) return false;
    if (free_us_ < now_us_) free_us_ = now_us_;
    due_us_[waiting_] = free_us_;
    if (begins_tick(frame)) {
      due_us_[waiting_] = (free_us_ / params.period_us + 1) * params.period_us;
    }
    queue_[waiting_++] = frame;
    begun_ = false;
    ++sent;
    return true;
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    for (;;) {
      const std::uint64_t deadline_us = begun_us_ + timeout_us;
      std::uint64_t start_us = 0;
      int from = 0;
      const bool any = next_frame(start_us, from);
      if (begun_ && (!any || start_us > deadline_us)) {
        if (now_us_ < deadline_us) now_us_ = deadline_us;
        return false;
      }
      if (!any) return false;
      if (carry(start_us, from, frame)) return true;
    }
  }
  std::uint64_t now_us() override { return now_us_; }
  hal::CanErrors errors() const override { return {}; }

  Params params;
  DriveNode drives[kBenchJoints] = {DriveNode(11), DriveNode(12), DriveNode(13), DriveNode(14),
                                    DriveNode(15), DriveNode(16), DriveNode(17)};
  SensorNode imu{dxl::kModelImu, kBenchImu};
  SensorNode left{dxl::kModelFoot, kBenchFoot};
  SensorNode right{dxl::kModelFoot, kBenchFoot + 1};
  bool down = false;    ///< the bus accepts no frame
  bool babble = false;  ///< a foreign node answers each SYNC with the highest priority
  CanFrame of_other;    ///< frame that another master sends
  int others = 0;       ///< how often it is sent, as soon as the wire is free
  std::uint32_t sent = 0;
  std::uint64_t bits = 0;
  std::uint64_t tick_us = 0;  ///< start of the last SYNC 1
  std::uint32_t deaf_to = 0;  ///< the nodes miss this identifier
  std::uint32_t lost = 0;     ///< the controller misses this identifier
  std::uint32_t trouble = 0;  ///< per mille of lost frames, and of doubled ones
  std::uint32_t seed = 1;
  std::uint32_t random(std::uint32_t most) {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<std::uint32_t>(std::uint64_t{seed} * most >> 32);
  }

 private:
  static constexpr int kNodes = kBenchJoints + 4;
  /// Sends short answers, other PDOs, strange identifiers.
  struct Stranger : WireNode {
    explicit Stranger(CanBench& of) : bench(of) {}
    void receive(const CanFrame& frame, std::uint64_t) override {
      if (frame.id == canopen::kSyncId) says = bench.babble ? 4 : 0;
    }
    bool next(CanFrame& frame, std::uint64_t) override {
      if (bench.others > 0) {
        frame = bench.of_other;
        --bench.others;
        return true;
      }
      if (says == 0) return false;
      constexpr std::uint32_t kIds[] = {0, 0x18B, 0x28C, 0x5FF, 0x7FF};
      frame = canopen::classic_frame(kIds[says], 2);
      frame.extended = says == 4;
      --says;
      return true;
    }
    CanBench& bench;
    int says = 0;
  };
  static constexpr int kController = -1;

  WireNode& node(int i) {
    if (i < kBenchJoints) return drives[i];
    if (i == kNodes - 1) return stranger_;
    return i == kBenchJoints ? imu : i == kBenchJoints + 1 ? left : right;
  }
  static bool begins_tick(const CanFrame& frame) {
    return frame.id == canopen::kSyncId && frame.size == 1 && frame.data[0] == 1;
  }
  std::uint64_t ready_us(std::size_t at) const {
    for (std::size_t i = 0; i < at; ++i) {
      if (queue_[i].id == queue_[at].id) return ~std::uint64_t{0};
    }
    return due_us_[at] < free_us_ ? free_us_ : due_us_[at];
  }
  bool next_frame(std::uint64_t& start_us, int& from) {
    std::uint32_t best = 0xFFFFFFFF;
    start_us = ~std::uint64_t{0};
    for (int i = 0; i < kNodes; ++i) {
      if (!loaded_[i]) loaded_[i] = node(i).next(ready_[i], free_us_);
      if (loaded_[i] && ready_[i].id < best) {
        best = ready_[i].id;
        from = i;
        start_us = free_us_;
      }
    }
    for (std::size_t i = 0; i < waiting_; ++i) {
      const std::uint64_t at_us = ready_us(i);
      if (at_us < start_us || (at_us == start_us && queue_[i].id < best)) {
        start_us = at_us;
        best = queue_[i].id;
        from = kController;
        chosen_ = i;
      }
    }
    return best != 0xFFFFFFFF;
  }
  bool carry(std::uint64_t start_us, int from, CanFrame& heard) {
    const CanFrame frame = from == kController ? queue_[chosen_] : ready_[from];
    const std::uint32_t frame_bits = canopen::exact_bits(frame).all();
    bits += frame_bits;
    free_us_ = start_us + frame_bits;
    if (from == kController) {
      if (begins_tick(frame)) tick_us = start_us;
      --waiting_;
      for (std::size_t i = chosen_; i < waiting_; ++i) {
        queue_[i] = queue_[i + 1];
        due_us_[i] = due_us_[i + 1];
      }
      begun_ = waiting_ == 0;
      begun_us_ = start_us;
    } else {
      loaded_[from] = false;
    }
    if (now_us_ < start_us) now_us_ = start_us;
    const std::uint32_t fate = random(1000);
    const bool gone = fate < trouble;
    for (int i = 0; i < kNodes && !gone; ++i) {
      const bool deaf = from == kController && frame.id == deaf_to && deaf_to != 0;
      if (i == from || deaf) continue;
      node(i).receive(frame, free_us_);
      if (fate >= 1000 - trouble) node(i).receive(frame, free_us_);
    }
    if (from == kController || (frame.id == lost && lost != 0) || gone) return false;
    now_us_ = free_us_;
    heard = frame;
    return true;
  }

  Stranger stranger_{*this};
  CanFrame queue_[hal::kCanQueue + 1];
  std::uint64_t due_us_[hal::kCanQueue + 1] = {};
  CanFrame ready_[kNodes];
  bool loaded_[kNodes] = {};
  std::size_t waiting_ = 0;
  std::size_t chosen_ = 0;
  bool begun_ = true;
  std::uint64_t begun_us_ = 0;
  std::uint64_t free_us_ = 0;
  std::uint64_t now_us_ = 0;
};

}  // namespace verp::test
