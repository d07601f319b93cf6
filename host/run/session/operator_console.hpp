#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "firmware/app/operator_device.hpp"
#include "host/run/session/robot.hpp"

namespace verp::session {

/// Source of orders for a controller in this process. As on a board, the controller is device 200
/// and orders are register writes, so it rejects the same. Implements the loop's OperatorLink and
/// Recorder.
class OperatorConsole {
 public:
  explicit OperatorConsole(Robot& robot);

  void brought_up(const app::BringUpReport& report) { device_.brought_up(report); }
  /// Throws bus::SinkError if the controller rejects an order.
  app::OperatorOrder order(std::uint32_t tick);
  void record(const TickRecord& tick, const State& state, const Outputs& outputs);

 private:
  /// The controller's end; the buffers are the other.
  struct Wire final : hal::ByteLink {
    std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t) override {
      told.insert(told.end(), data, data + size);
      return size;
    }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t) override {
      const std::size_t count = std::min(capacity, asked.size());
      std::copy_n(asked.begin(), count, buffer);
      asked.erase(asked.begin(), asked.begin() + static_cast<std::ptrdiff_t>(count));
      return count;
    }
    bool connected() const override { return true; }
    hal::LinkErrors errors() const override { return {}; }
    std::vector<std::uint8_t> asked, told;
  };

  void hand_over(std::size_t packets);

  Robot& robot_;
  Wire wire_;
  app::OperatorDevice device_;
  bool relaxed_ = false;  ///< without it a new controller obeys no order
  bool stopped_ = false;  ///< emergency stop
};

}  // namespace verp::session
