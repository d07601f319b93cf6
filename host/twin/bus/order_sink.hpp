#pragma once
#include <cstdint>
#include <stdexcept>

#include "firmware/app/contracts.hpp"

namespace verp::bus {

/// What a controller says of the last tick it has finished.
struct ControllerReport {
  std::uint32_t tick = 0;
  std::uint64_t digest = 0;
};

/// The controller's operator did not take an order: exit status 3. what() is one line with a
/// remedy.
class SinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where the orders for a controller in lockstep go.
class OrderSink {
 public:
  virtual ~OrderSink() = default;
  /// Gives `order`, if it is not null, and asks for the report; returns when the controller has
  /// answered both. Between two ticks, so the order holds from the next one on. Throws SinkError.
  virtual ControllerReport exchange(const app::OperatorOrder* order) = 0;
  /// How many actions the controller offers; 0: it has none to get up by. Throws SinkError.
  virtual int action_count() = 0;
};

}  // namespace verp::bus
