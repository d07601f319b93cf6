#pragma once
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/app/operator_device.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/realtime_server.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::test {

inline std::string pty_path(const char* name) {
  return (std::filesystem::temp_directory_path() /
          ("verp-" + std::string(name) + "-" + std::to_string(::getpid())))
      .string();
}

class PtyThread {
 public:
  template <class Turn>
  PtyThread(const std::string& path, Turn turn)
      : link_(link::parse_endpoint("pty:" + path)), thread_([this, turn] {
          while (!over_) turn(link_);
        }) {}
  ~PtyThread() {
    over_ = true;
    thread_.join();
  }

 private:
  link::Link link_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

class PtyServos {
 public:
  PtyServos(const Params& params, FakePlant& plant, const std::string& path)
      : bus_(params, plant),
        server_(bus_),
        thread_(path, [this](link::Link& link) { turn(link); }) {}

 private:
  void turn(link::Link& link) {
    constexpr std::uint32_t kTurn_us = 500;
    std::uint8_t heard[512];
    const std::size_t count = link.read(heard, sizeof heard, kTurn_us);
    answer_.clear();
    server_.turn(clock_.now_us(), {heard, count}, answer_);
    if (!answer_.empty()) link.write(answer_.data(), answer_.size(), 100'000);
  }
  link::SystemClock clock_;
  bus::VirtualBus bus_;
  bus::RealtimeServer server_;
  std::vector<std::uint8_t> answer_;
  PtyThread thread_;
};

class PtyController {
 public:
  PtyController(const Params& params, const State& state, const std::string& path)
      : thread_(path, [this, &params, &state](link::Link& link) {
          if (!device_) {
            device_ = std::make_unique<Device>(link, params, app::OperatorSetup{});
            device_->record(TickRecord{state.digest, Inputs{}}, state, Outputs{});
          }
          if (!device_->poll()) std::this_thread::sleep_for(std::chrono::microseconds(500));
          reboot_asked = device_->reboot_asked();
        }) {}
  std::atomic<bool> reboot_asked = false;

 private:
  using Device = app::OperatorDevice;
  std::unique_ptr<Device> device_;
  PtyThread thread_;
};

/// Through libserial.
class SerialMaster {
 public:
  explicit SerialMaster(const std::string& path)
      : link_(link::parse_endpoint("serial:" + path + "@2000000")) {}

  /// Returns up to `wanted` bytes of the reply.
  std::vector<std::uint8_t> exchange(const std::vector<std::uint8_t>& bytes, std::size_t wanted,
                                     std::uint32_t timeout_us = 5'000'000) {
    link_.write(bytes.data(), bytes.size(), 1'000'000);
    std::vector<std::uint8_t> reply;
    const link::SystemClock clock;
    const std::uint64_t end_us = clock.now_us() + timeout_us;
    while (reply.size() < wanted && clock.now_us() < end_us) {
      std::uint8_t piece[512];
      const std::size_t count = link_.read(piece, sizeof piece, 10'000);
      reply.insert(reply.end(), piece, piece + count);
    }
    return reply;
  }
  std::vector<std::uint8_t> expect_silence(const std::vector<std::uint8_t>& bytes) {
    return exchange(bytes, 1, 150'000);
  }

 private:
  link::Link link_;
};

}  // namespace verp::test
