#pragma once
#include <cstdint>
#include <stdexcept>

#include "firmware/app/contracts.hpp"

namespace verp::bus {

struct ControllerReport {
  std::uint32_t tick = 0;
  std::uint64_t digest = 0;
};

/// Exit status 3. what() is one line with a remedy.
class SinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class OrderSink {
 public:
  virtual ~OrderSink() = default;
  /// Sends `order` unless null and asks for the report. Call it between two ticks; the order holds
  /// from the next tick on. Throws SinkError.
  virtual ControllerReport exchange(const app::OperatorOrder* order) = 0;
  /// 0: no action for getting up. Throws SinkError.
  virtual int action_count() = 0;
};

}  // namespace verp::bus
