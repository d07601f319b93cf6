#pragma once
#include <cstdint>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/pacer.hpp"
#include "tests/hil/line_faults.hpp"
#include "tests/hil/operator_desk.hpp"
#include "tests/hil/safe_table.hpp"

namespace verp::test {

template <class Line>
class BusClock {
 public:
  explicit BusClock(Line& line) : line_(line) {}
  bool start(std::uint32_t period_us) {
    period_us_ = period_us;
    next_us_ = line_.time_us() + period_us;
    return true;
  }
  std::uint32_t wait() {
    line_.wait_until(next_us_);
    const std::uint64_t begun = 1 + (line_.time_us() - next_us_) / period_us_;
    next_us_ += begun * period_us_;
    return static_cast<std::uint32_t>(begun);
  }
  std::uint64_t now_us() const { return line_.time_us(); }
  std::uint64_t due_us() const { return next_us_; }

 private:
  Line& line_;
  std::uint32_t period_us_ = 0;
  std::uint64_t next_us_ = 0;
};

using Device = app::OperatorDevice;

/// From power-up to reset. `Line` is any servo bus with time_us() and wait_until().
template <class Line>
struct ControllerOnBoard {
  static_assert(hal::TickSource<BusClock<Line>>);
  struct Sink {
    void record(const TickRecord& record, const State& state, const Outputs& outputs) {
      safe.tick(record.inputs, outputs);
      device.record(record, state, outputs);
      if (trace != nullptr) trace->push_back(record);
    }
    Device& device;
    SafeTable& safe;
    std::vector<TickRecord>* trace;
  };

  ControllerOnBoard(const Params& params, Line& line, OperatorDesk& desk,
                    dxl::controller::ResetCause cause, std::vector<TickRecord>* trace = nullptr)
      : device(desk.controller_end(), params, {.reset_cause = cause}),
        safe(params),
        sink{device, safe, trace},
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
  app::App<Line, Device, Sink> loop;
  BusClock<Line> clock;
  app::Pacer<BusClock<Line>> pacer;
};
using Controller = ControllerOnBoard<FaultyLine>;

}  // namespace verp::test
