#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/protocol/controller_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "host/os/link/link.hpp"
#include "host/twin/bus/order_sink.hpp"

namespace verp::bus {

/// Operator port: Dynamixel device 200 (common/protocol/controller_table.hpp).
class OperatorPort final : public OrderSink {
 public:
  /// `give_up` is called while the controller is silent. Throws LinkError and EndpointError.
  OperatorPort(const std::string& endpoint, std::function<bool()> give_up);

  ControllerReport exchange(const app::OperatorOrder* order) override;
  int action_count() override;
  std::uint32_t params_crc();

 private:
  static constexpr std::uint8_t kId = dxl::controller::kDefaultId;
  void add_write(std::uint16_t address, const std::vector<std::uint8_t>& data);
  void add_read(std::uint16_t address, std::uint16_t length);
  void add_order(const app::OperatorOrder& order);
  ControllerReport ask_report();
  /// Sends the queue until all is answered; returns the last answer's data.
  std::vector<std::uint8_t> ask();
  bool collect(std::vector<std::uint8_t>& data);

  std::string text_;
  std::function<bool()> give_up_;
  link::Link link_;
  std::vector<std::uint8_t> outbox_;
  std::size_t asked_ = 0;
  bool refused_ = false;  ///< all answered, the first with "not now"
};

}  // namespace verp::bus
