#pragma once
#include <cstdint>

#include "firmware/app/app.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/pacer.hpp"
#include "tests/hil/line_faults.hpp"
#include "tests/hil/operator_desk.hpp"
#include "tests/hil/safe_table.hpp"

/// The control loop and its operator's port, as a board puts them together.
namespace verp::test {

/// A board's timer, which here goes by the bus.
class BusClock {
 public:
  explicit BusClock(FaultyLine& line) : line_(line) {}
  bool start(std::uint32_t period_us) {
    period_us_ = period_us;
    next_us_ = line_.now_us() + period_us;
    return true;
  }
  std::uint32_t wait() {
    line_.wait_until(next_us_);
    const std::uint64_t begun = 1 + (line_.now_us() - next_us_) / period_us_;
    next_us_ += begun * period_us_;
    return static_cast<std::uint32_t>(begun);
  }
  std::uint64_t now_us() const { return line_.now_us(); }
  /// When the next tick begins.
  std::uint64_t due_us() const { return next_us_; }

 private:
  FaultyLine& line_;
  std::uint32_t period_us_ = 0;
  std::uint64_t next_us_ = 0;
};
static_assert(hal::TickSource<BusClock>);

using Device = app::OperatorDevice<hal::MemoryLink>;

/// One life of a controller, from power-up to reset.
struct Controller {
  struct Sink {
    void record(const TickRecord& record, const State& state, const Outputs& outputs) {
      safe.tick(record.inputs, outputs);
      device.record(record, state, outputs);
    }
    Device& device;
    SafeTable& safe;
  };

  Controller(const Params& params, FaultyLine& line, OperatorDesk& desk,
             dxl::controller::ResetCause cause)
      : device(desk.controller_end(), params, {.reset_cause = cause}),
        safe(params),
        sink{device, safe},
        loop(params, line, device, sink),
        clock(line),
        pacer(clock) {
    desk.serve = [this] {
      while (device.poll()) {
      }
    };
  }
  void tick() {
    loop.tick(pacer.next());
    device.report({.bus = loop.counters(),
                   .bus_crc_errors = loop.crc_errors(),
                   .bus_noise_bytes = loop.noise_bytes(),
                   .skipped_periods = static_cast<std::uint32_t>(pacer.deadlines().skipped)});
    device.poll();
  }

  Device device;
  SafeTable safe;
  Sink sink;
  app::App<FaultyLine, Device, Sink> loop;
  BusClock clock;
  app::Pacer<BusClock> pacer;
};

}  // namespace verp::test
