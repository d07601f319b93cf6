#pragma once
#include <cstdint>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/pacer.hpp"
#include "host/twin/bus/bus_clock.hpp"
#include "host/twin/bus/faulty_line.hpp"
#include "tests/hil/operator_desk.hpp"
#include "tests/hil/safe_table.hpp"

namespace verp::test {

using bus::BusClock;
using bus::FaultyLine;
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
