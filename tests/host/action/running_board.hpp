#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/action/kept.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/robot_images.hpp"
#include "firmware/store/flash_store.hpp"
#include "firmware/store/shared_page.hpp"
#include "hal/fake/fake_flash.hpp"
#include "tests/host/tool/link_controller.hpp"

/// A board without servos, in a thread. Robot, actions and log are in its flash; it restarts with
/// the actions it receives.
namespace verp::test {

class RunningBoard {
 public:
  static constexpr std::size_t kPage = 128 * 1024, kActionsAt = kPage / 2;
  using Flash = hal::FakeFlash<kPage, 4>;
  using Log = store::FlashStore<Flash>;
  using Room = store::WaitingRoom<Flash, Flash, Log>;
  using Images = app::RobotImages<Room>;
  using Device = app::OperatorDevice;

  RunningBoard(const Params& params, const std::vector<std::uint8_t>& actions,
               const std::string& endpoint, const std::function<void(RunningBoard&)>& prepare = {})
      : port(endpoint) {
    ParamsImage robot;
    robot.params = params;
    seal_image(robot);
    const auto nothing = [] {};
    store::program_bytes(*home, 0, 0, reinterpret_cast<const std::uint8_t*>(&robot), sizeof robot,
                         nothing);
    store::program_bytes(*home, 0, kActionsAt, actions.data(), actions.size(), nothing);
    if (prepare) prepare(*this);
    thread_ = std::thread([this] {
      while (!stop_) run();
    });
  }
  ~RunningBoard() { stop(); }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  bool holds(const std::vector<std::uint8_t>& actions) const {
    return std::equal(actions.begin(), actions.end(), home->memory(0) + kActionsAt);
  }

  ControllerPort port;
  std::unique_ptr<Flash> home = std::make_unique<Flash>(), other = std::make_unique<Flash>(7);
  bool armed = false;
  std::atomic<int> starts = 0;

 private:
  void run() {
    store::finish_waiting(*home, *other, [] {});
    const auto& robot = *reinterpret_cast<const ParamsImage*>(home->memory(0));
    const std::uint8_t* actions = home->memory(0) + kActionsAt;
    auto log = std::make_unique<Log>(*other);
    log->open();
    Room room(*home, kActionsAt, kPage - kActionsAt, *other, *log);
    auto images = std::make_unique<Images>(robot, actions, kPage - kActionsAt, room);
    auto device = std::make_unique<Device>(port, robot.params, app::OperatorSetup{}, *images);
    const action::KeptLibrary kept(actions, kPage - kActionsAt, robot.params);
    device->offer_actions(kept.library.count(), kept.fault);
    if (armed) {
      auto state = std::make_unique<State>();
      Outputs outputs;
      outputs.torque_enable = 1;
      device->record({state->digest, Inputs{}}, *state, outputs);
    }
    ++starts;
    while (!stop_ && images->accepted_actions() == 0) {
      if (!device->poll()) std::this_thread::sleep_for(std::chrono::microseconds(50));
      room.work(!device->armed());
    }
    if (images->accepted_actions() == 0) return;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(40);
    while (std::chrono::steady_clock::now() < end) device->poll();
    room.replace(nullptr, sizeof(ParamsImage), images->accepted_actions(), images->actions_bytes(),
                 [] {});
  }

  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace verp::test
