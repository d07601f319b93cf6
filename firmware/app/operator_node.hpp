#pragma once
#include <cstdint>

#include "common/protocol/canopen/device.hpp"
#include "common/protocol/canopen/published_tick.hpp"
#include "common/protocol/canopen/robot_load.hpp"
#include "firmware/app/can_schedule.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/controller_objects.hpp"
#include "firmware/app/operator_registers.hpp"
#include "hal/contract/can_bus.hpp"

namespace verp::app {

/// The controller as a node on its drives' bus: OperatorLink and Recorder of the loop, and the
/// CanBus between loop and `Bus`, which takes out frames for the node. It publishes each tick in
/// TPDOs (canopen/published_tick.hpp) if the bus has room. An operator may switch them (1801h:1 and
/// following).
///
/// Nothing waits. The node sends only at the end of a tick, behind the goals. Before the first tick
/// it answers at once. In lockstep it sits below the twin's clock, so its frames take no simulated
/// time.
///
/// `bus`, `params`, `registers` and `images` must outlive it. An OperatorDevice with the same
/// registers is then the loop's OperatorLink and Recorder; its user calls tell() after each tick.
class OperatorNode final : public hal::CanBus {
 public:
  static constexpr std::uint8_t kNode = canopen::plan::kControllerNode;

  OperatorNode(hal::CanBus& bus, const Params& params, OperatorRegisters& registers,
               Images& images);
  bool send(const CanFrame& frame) override { return bus_.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override;
  std::uint64_t now_us() override { return bus_.now_us(); }
  hal::CanErrors errors() const override { return bus_.errors(); }

  // OperatorLink
  OperatorOrder order(std::uint32_t tick);

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs);

  /// Call after the tick, when the registers show it.
  void tell(const Inputs& inputs);

  /// Sends a few pending answers, for a loop that does not tick.
  void answer();
  void brought_up(const BringUpReport& report);
  void report(const LoopHealth& health) { registers_.report().health(health); }
  /// Frames for the node, except those of tick followers, which keep no pace.
  std::uint32_t asked() const { return asked_; }

 private:
  static constexpr std::uint32_t kWatchers =
      canopen::further_sdo(canopen::plan::kWatcherSdo).request;
  static constexpr int kMostTaken = 64;
  /// Frames at the end of each tick for reading a block.
  static constexpr int kMostAnswers = 4;
  static_assert(most_sent(kMaxJoints) + canopen::published::kFrames +
                    canopen::published::kMostParts + kMostAnswers <=
                hal::kCanQueue);

  // NMT frames are not for the node: it is the master.
  static bool is_for_node(const CanFrame& frame);
  bool imu_on_bus() const { return bus_imu_ && registers_.imu_source() == table::ImuSource::kBus; }

  void publish(const Inputs& inputs);
  // Sends one TPDO ahead of other frames.
  void send_pdo(unsigned number);

  hal::CanBus& bus_;
  const bool bus_imu_;
  OperatorRegisters& registers_;
  ControllerObjects objects_;
  canopen::Device<ControllerObjects, kControllerSize> device_;
  canopen::published::Parts parts_;
  Inputs before_;
  bool ticks_ = false;
  std::uint32_t asked_ = 0;
};

}  // namespace verp::app
