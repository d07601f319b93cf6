#pragma once
#include <deque>
#include <memory>

#include "host/twin/can/virtual_can.hpp"
#include "tests/contract/fakes.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::test {

class VirtualWire : public SimulatedTime {
  class Far final : public can::Node {
   public:
    std::uint8_t id() const override { return 127; }
    void hear(const CanFrame& frame, std::uint64_t) override { heard.push_back(frame); }
    void work(std::uint64_t) override {}
    bool say(CanFrame& frame, std::uint64_t) override {
      if (to_send.empty()) return false;
      frame = to_send.front();
      to_send.pop_front();
      return true;
    }
    void power_on() override {}
    void power_off() override {}
    std::deque<CanFrame> heard, to_send;
  };

 public:
  static constexpr bool kBusOff = true;
  VirtualWire() {
    auto node = std::make_unique<Far>();
    far_ = node.get();
    bus.plug_in(std::move(node));
  }
  void far_send(const CanFrame& frame) { far_->to_send.push_back(frame); }
  bool far_take(CanFrame& frame) {
    if (far_->heard.empty()) return false;
    frame = far_->heard.front();
    far_->heard.pop_front();
    return true;
  }
  void fill_and_bus_off(const CanFrame& frame, int count) {
    for (int i = 0; i < count; ++i) bus.send(frame);
    bus.leave_bus();
  }

 private:
  Params params_ = [] {
    Params params;
    params.bus_protocol = BusProtocol::kCia402;
    params.baud = 1'000'000;
    return params;
  }();
  FakePlant plant_;

 public:
  can::VirtualCan bus{params_, plant_};

 private:
  Far* far_ = nullptr;
};

}  // namespace verp::test
