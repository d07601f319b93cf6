#pragma once
#include <concepts>
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
template <std::derived_from<hal::CanBus> Bus, Images Store = NoImages>
class OperatorNode final : public hal::CanBus {
 public:
  static constexpr std::uint8_t kNode = canopen::plan::kControllerNode;

  OperatorNode(Bus& bus, const Params& params, OperatorRegisters<Store>& registers, Store& images)
      : bus_(bus),
        bus_imu_(params.imu.device_id != 0),
        registers_(registers),
        objects_(registers_, images),
        device_(objects_, controller_identity(), kNode) {
    publish_ticks(device_.objects(), kNode,
                  canopen::plan::has_room_to_publish(params, !imu_on_bus()));
    device_.objects().producer.set_period_ms(canopen::plan::heartbeat_ms(params));
    device_.start();
    constexpr std::uint64_t kBegin_us = 0;  // the bus may not be open yet
    // As NMT master it must start itself.
    device_.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, kNode), kBegin_us);
  }

  bool send(const CanFrame& frame) override { return bus_.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    for (int taken = 0; bus_.poll(frame, timeout_us); ++taken) {
      if (!is_for_node(frame)) return true;
      if (frame.id != kWatchers) ++asked_;
      device_.receive(frame, bus_.now_us());
      if (!ticks_) answer();
      if (taken == kMostTaken) return false;  // a flooded bus must not block
    }
    return false;
  }
  std::uint64_t now_us() override { return bus_.now_us(); }
  hal::CanErrors errors() const override { return bus_.errors(); }

  // OperatorLink
  OperatorOrder order(std::uint32_t tick) {
    if (registers_.slept_until(tick)) registers_.withdraw_orders();
    return registers_.order();
  }

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    registers_.record(record, state, outputs);
    tell(record.inputs);
  }

  /// Call after the tick, when the registers show it.
  void tell(const Inputs& inputs) {
    ticks_ = true;
    publish(inputs);
    answer();
  }

  /// Sends a few pending answers, for a loop that does not tick.
  void answer() {
    CanFrame frame;
    for (int sent = 0; sent < kMostAnswers && device_.next(frame, bus_.now_us()); ++sent) {
      bus_.send(frame);
    }
  }

  void brought_up(const BringUpReport& report) {
    registers_.report().bring_up(report);
    registers_.withdraw_orders();
  }
  void report(const LoopHealth& health) { registers_.report().health(health); }
  /// Frames for the node, except those of tick followers, which keep no pace.
  std::uint32_t asked() const { return asked_; }

 private:
  using Objects = ControllerObjects<Store>;
  static constexpr std::uint32_t kWatchers =
      canopen::further_sdo(canopen::plan::kWatcherSdo).request;
  static constexpr int kMostTaken = 64;
  /// Frames at the end of each tick for reading a block.
  static constexpr int kMostAnswers = 4;
  static_assert(most_sent(kMaxJoints) + canopen::published::kFrames +
                    canopen::published::kMostParts + kMostAnswers <=
                hal::kCanQueue);

  // NMT frames are not for the node: it is the master.
  static bool is_for_node(const CanFrame& frame) {
    if (!canopen::is_canopen(frame)) return false;
    if (canopen::plan::is_to_controllers_sdo(frame.id)) return true;
    const canopen::Connection to = canopen::connection_of(frame.id);
    return to.node == kNode &&
           (to.service == canopen::Service::kSdoRequest || to.service == canopen::Service::kRpdo);
  }

  bool imu_on_bus() const { return bus_imu_ && registers_.imu_source() == table::ImuSource::kBus; }

  void publish(const Inputs& inputs) {
    namespace published = canopen::published;
    parts_.find(before_, inputs, imu_on_bus());
    before_ = inputs;
    registers_.report().publish_flags(parts_.flags());
    send_pdo(published::kDigestPdo);
    send_pdo(published::kRecordPdo);
    for (int i = 0; i < parts_.count(); ++i) {
      registers_.report().publish_part(parts_.part(i).value());
      send_pdo(published::kPartPdo);
    }
  }
  // Sends one TPDO ahead of other frames.
  void send_pdo(unsigned number) {
    CanFrame frame;
    device_.trigger(number - 1);
    if (device_.next_pdo(number - 1, frame, bus_.now_us())) bus_.send(frame);
  }

  Bus& bus_;
  const bool bus_imu_;
  OperatorRegisters<Store>& registers_;
  Objects objects_;
  canopen::Device<Objects, kControllerSize> device_;
  canopen::published::Parts parts_;
  Inputs before_;
  bool ticks_ = false;
  std::uint32_t asked_ = 0;
};

}  // namespace verp::app
