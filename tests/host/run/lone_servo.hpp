#pragma once
#include <fcntl.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "host/os/link/line_rate.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/port.hpp"
#include "host/twin/bus/servo_device.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::test {

/// Factory-new servos, each at its own baud rate. The test turns their horns.
class LoneServo {
 public:
  explicit LoneServo(const std::string& path)
      : link_(link::parse_endpoint("pty:" + path)),
        line_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    thread_ = std::thread([this] { serve(); });
  }
  ~LoneServo() {
    over_ = true;
    thread_.join();
  }
  LoneServo(const LoneServo&) = delete;
  LoneServo& operator=(const LoneServo&) = delete;

  /// Before the first call no servo answers.
  void connect(const bus::ServoIdentity& identity, const sim::ServoMeasurement& measured = {}) {
    const std::scoped_lock lock(mutex_);
    const int joint = static_cast<int>(servos_.size());
    plant_.measured[servos_.size()] = measured;
    servos_.push_back(std::make_unique<bus::ServoDevice>(identity, plant_, joint));
  }
  void disconnect() {
    const std::scoped_lock lock(mutex_);
    servos_.clear();
  }
  /// Turns the first servo to where its encoder reads `count`.
  void turn_to(std::int32_t count) {
    const std::scoped_lock lock(mutex_);
    plant_.measured[0].position_count = count;
  }
  std::int64_t value(std::uint16_t address, std::uint16_t size) {
    const std::scoped_lock lock(mutex_);
    const auto bytes = servos_[0]->read(address, size);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
    }
    return size == 4 ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value);
  }
  int writes() const { return writes_; }

 private:
  void serve() {
    while (!over_) {
      std::uint8_t piece[256];
      const std::size_t count = link_.read(piece, sizeof piece, 10'000);
      const std::uint8_t rate = dxl::baud_rate_code(link::line_rate(line_.get()));
      const std::scoped_lock lock(mutex_);
      for (std::size_t i = 0; i < count; ++i) {
        for (bool found = parser_.push(piece[i]); found; found = parser_.next()) {
          for (const auto& servo : servos_) {
            if (servo->baud_code() == rate) answer(*servo, parser_.packet());
          }
        }
      }
    }
  }

  void answer(bus::Device& servo, const dxl::Packet& packet) {
    const bool to_all = packet.id == dxl::kBroadcast;
    if (packet.is_status() || (!to_all && packet.id != servo.id())) return;
    const std::uint8_t id = servo.id(), level = servo.status_level();
    if (packet.instruction == dxl::Instruction::kPing) {
      std::uint8_t identity[3] = {0, 0, servo.firmware_version()};
      dxl::put_u16(identity, servo.model());
      return reply(id, 0, identity);
    }
    if (to_all || packet.size < 3) return;
    const std::uint16_t address = dxl::get_u16(packet.parameters);
    if (packet.instruction == dxl::Instruction::kRead && level >= 1) {
      reply(id, 0, servo.read(address, dxl::get_u16(packet.parameters + 2)));
    } else if (packet.instruction == dxl::Instruction::kWrite) {
      ++writes_;
      const auto error = servo.write(address, {packet.parameters + 2, packet.size - 2});
      if (level >= 2) reply(id, static_cast<std::uint8_t>(error), {});
    }
  }

  void reply(std::uint8_t id, std::uint8_t error, std::span<const std::uint8_t> data) {
    std::uint8_t frame[128];
    const std::size_t size =
        dxl::encode_status(frame, sizeof frame, id, error, data.data(), data.size());
    link_.write(frame, size, 100'000);
  }

  link::Link link_;
  link::Descriptor line_;  ///< keeps the port open
  FakePlant plant_;
  dxl::Parser parser_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<bus::ServoDevice>> servos_;
  std::atomic<int> writes_ = 0;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace verp::test
