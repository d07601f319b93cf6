#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/link_messages.hpp"
#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// Byte streams to a controller in another process.
struct ByteStreams {
  /// Waits for at least one byte; 0: the controller has closed.
  std::function<std::size_t(void* data, std::size_t capacity)> read_some;
  /// False: the controller has closed.
  std::function<bool(const void* data, std::size_t size)> write;
};

/// Members may be empty.
struct ServerHooks {
  std::function<app::OperatorOrder(std::uint32_t tick)> order;  ///< at the start of each tick
  /// Called in this order within a tick. `state` is not sent in every tick.
  std::function<void(const State&)> state;
  std::function<void(const Outputs&)> outputs;
  std::function<void(const TickRecord&)> record;
  std::function<bool()> stop;  ///< called at each poll; true ends the run
};

struct RunOptions {
  std::uint32_t ticks = 0;  ///< 0: run until `stop`
  std::uint32_t state_every = 125;
  std::span<const std::uint32_t> actions = {};
};

/// exit_code is that of the verp program; 3: broken link or invalid data.
struct ServerResult {
  std::uint32_t exit_code = 3;
  std::string reason;
};

/// Serves one controller over firmware/app/link_messages.hpp until it quits.
class BusServer {
 public:
  BusServer(const Params& params, VirtualBus& bus, ByteStreams streams, ServerHooks hooks,
            RunOptions options);
  ServerResult serve();

 private:
  bool receive(std::size_t size);
  bool handle(const link::MessageHeader& header, const std::uint8_t* payload);
  bool hello(const link::Hello& message);
  bool poll(const link::Poll& message);
  bool end(std::uint32_t exit_code, std::string reason);

  const Params& params_;
  VirtualBus& bus_;
  ByteStreams streams_;
  ServerHooks hooks_;
  RunOptions options_;
  std::vector<std::uint8_t> inbox_;
  std::size_t used_ = 0;  ///< already handled
  ServerResult result_;
  app::OperatorOrder order_;
  std::uint32_t ordered_tick_ = 0;
  bool ordered_ = false;
  bool greeted_ = false;
  bool send_failed_ = false;
};

}  // namespace verp::bus
