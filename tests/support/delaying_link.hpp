#pragma once
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/dynamixel_words.hpp"

/// A cable that delays bytes as USB adapters do: the first byte starts a timer; all bytes go on
/// when it expires. A thread carries them.
namespace verp::test {

struct Latency {
  std::uint64_t to_device_us = 0;
  std::uint64_t to_pc_us = 0;
};

class DelayingLink {
 public:
  /// Opens `device` as soon as it exists.
  DelayingLink(const std::string& pc, std::string device, const Latency& latency)
      : pc_(link::parse_endpoint(pc)), device_place_(std::move(device)), latency_(latency) {
    thread_ = std::thread([this] { carry(); });
  }
  ~DelayingLink() {
    over_ = true;
    thread_.join();
  }
  DelayingLink(const DelayingLink&) = delete;
  DelayingLink& operator=(const DelayingLink&) = delete;

  /// For so many ticks of the PC's loop; bytes under way are lost.
  void cut_for(std::uint32_t ticks) { mended_at_ = ticks_ + ticks; }
  /// Delays all that comes in `time_us` to their end; calls add up.
  void stall(std::uint64_t time_us) { stall_until_us_ = now_us() + time_us; }

  void lose_replies(int count) { to_lose_ = count; }

  /// The PC's reads of Present Position from all servos.
  std::uint32_t ticks() const { return ticks_; }

 private:
  static constexpr std::uint64_t kTurn_us = 100;

  struct Way {
    std::vector<std::uint8_t> held;
    std::uint64_t due_us = 0;
  };

  bool cut() const { return ticks_ < mended_at_; }
  static std::uint64_t now_us() { return link::monotonic_ns() / 1000; }

  void carry() {
    const sched_param urgent{.sched_priority = 30};
    ::sched_setscheduler(0, SCHED_FIFO, &urgent);  // if permitted
    while (!over_) {
      link::sleep_until_ns(link::monotonic_ns() + kTurn_us * 1000);
      if (!open_device()) continue;
      take(pc_, to_device_, latency_.to_device_us, true);
      take(*device_, to_pc_, latency_.to_pc_us, false);
      pass(to_device_, *device_);
      pass(to_pc_, pc_);
    }
  }

  bool open_device() {
    if (device_) return true;
    try {
      device_.emplace(link::parse_endpoint(device_place_));
    } catch (const link::LinkError&) {
    }
    return device_.has_value();
  }

  void take(link::Link& from, Way& way, std::uint64_t latency_us, bool watched) {
    std::uint8_t piece[1024];
    const std::size_t count = from.read(piece, sizeof piece, 0);
    if (count == 0) return;
    if (way.held.empty()) way.due_us = now_us() + latency_us;
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = watched && line_.push(piece[i]); found; found = line_.next()) watch();
    }
    if (!watched && lost(piece, count)) return;
    if (!cut()) way.held.insert(way.held.end(), piece, piece + count);
  }

  /// A reply comes in one piece; all pieces of a torn one are lost.
  bool lost(const std::uint8_t* piece, std::size_t count) {
    if (to_lose_ <= 0) return false;
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = replies_.push(piece[i]); found; found = replies_.next()) --to_lose_;
    }
    return true;
  }

  void watch() {
    const dxl::Packet& packet = line_.packet();
    if (!packet.is_status() && bus::DynamixelWords::begins_tick(packet)) ++ticks_;
  }

  void pass(Way& way, link::Link& to) {
    if (cut()) way.held.clear();
    if (way.held.empty() || now_us() < std::max(way.due_us, stall_until_us_.load())) return;
    to.write(way.held.data(), way.held.size(), 0);
    way.held.clear();
  }

  link::Link pc_;
  std::string device_place_;
  std::optional<link::Link> device_;
  Latency latency_;
  Way to_device_, to_pc_;
  dxl::Parser line_, replies_;
  std::atomic<int> to_lose_ = 0;
  std::atomic<std::uint32_t> ticks_ = 0;
  std::atomic<std::uint64_t> stall_until_us_ = 0;
  std::atomic<std::uint32_t> mended_at_ = 0;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace verp::test
