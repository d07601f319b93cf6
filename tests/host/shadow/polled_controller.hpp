#pragma once
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/control/step.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/os/link/link.hpp"
#include "tests/support/random_inputs.hpp"

namespace verp::shadow::test {

using Log = app::TickLog;
using Device = app::OperatorDevice;

/// Plausible inputs, no servos; only its reports matter.
class Controller {
 public:
  Controller(const Params& params, const std::string& endpoint, std::chrono::microseconds period)
      : params_(params),
        inputs_(verp::test::plausible_inputs(4000, 5, 1000, params)),
        period_(period),
        link_(link::parse_endpoint(endpoint)),
        thread_([this] { run(); }) {}
  ~Controller() {
    over = true;
    thread_.join();
  }

  std::atomic<bool> over = false;
  std::atomic<bool> restart = false;
  std::atomic<std::uint32_t> spoil_at = 0;
  /// Some ticks after a client read the State.
  std::atomic<bool> spoil_when_read = false;
  std::atomic<std::uint32_t> spoilt = 0;  ///< first wrong tick
  std::atomic<std::uint32_t> tick = 0;

 private:
  void run() {
    while (!over) live();
  }
  void live() {
    restart = false;
    auto log = std::make_unique<Log>(app::no_images);
    auto device = std::make_unique<Device>(link_, params_, app::OperatorSetup{}, *log);
    State state;
    bool read_seen = false;
    for (std::size_t i = 0; !over && !restart; ++i) {
      const auto end = std::chrono::steady_clock::now() + period_;
      Inputs inputs = inputs_[i % inputs_.size()];
      inputs.tick = static_cast<std::uint32_t>(i + i / 50);  // skips some periods
      if (i % 50 == 0) inputs.flags |= kOverrun;
      Outputs outputs;
      if (spoil_when_read && read_seen) {
        spoil_at = (inputs.tick / 51 + 1) * 51 + 20;  // not a skipped tick
        spoil_when_read = false;
      }
      if (spoil_at == inputs.tick && i > 0) {
        spoil(state);
        spoilt = inputs.tick;
      }
      step(params_, state, inputs, outputs);
      tick = inputs.tick;
      device->record({state.digest, inputs}, state, outputs);
      while (std::chrono::steady_clock::now() < end) {
        read_seen = read_seen || log->size(app::ImageKind::kState) > 0;
        if (!device->poll()) std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    }
  }
  static void spoil(State& state) {
    std::uint32_t bits;
    std::memcpy(&bits, &state.zeros.leg[1].pitch_rad, sizeof bits);
    bits ^= 1;
    std::memcpy(&state.zeros.leg[1].pitch_rad, &bits, sizeof bits);
  }

  const Params params_;
  const std::vector<Inputs> inputs_;
  const std::chrono::microseconds period_;
  link::Link link_;
  std::thread thread_;
};

}  // namespace verp::shadow::test
