#pragma once
#include <cstdint>
#include <vector>

#include "firmware/app/contracts.hpp"

namespace verp::test {

struct Walker {
  app::OperatorOrder order(std::uint32_t tick) const {
    app::OperatorOrder order;
    order.command.request = tick < 20 ? Request::kStand : Request::kWalk;
    order.command.sequence = static_cast<std::uint8_t>(tick);
    order.flags = kCommandFresh;
    return order;
  }
  void record(const TickRecord& record, const State&, const Outputs&) { records.push_back(record); }
  std::vector<TickRecord> records;
};

}  // namespace verp::test
