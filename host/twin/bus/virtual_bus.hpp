#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "hal/contract/frame_bus.hpp"
#include "host/twin/bus/bus_device.hpp"
#include "host/twin/bus/bus_words.hpp"
#include "host/twin/bus/collision.hpp"
#include "host/twin/bus/device.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

/// A FrameBus in memory with devices on a plant, in simulated time: the same frames give the same
/// replies at the same times. It is the line: bytes, rate, time and collisions. What the bytes mean
/// is BusWords', in the protocol of Params.
///
/// In lockstep a broadcast read of Present Position begins a tick and waits on the wire
/// for the next multiple of the control period. Otherwise only bytes, reply delays and poll's
/// timeouts advance time. Registers are sampled when a reply begins; writes apply when their last
/// byte arrives.
///
/// In a Sync or Bulk Read a silent device silences those behind it. Replies of devices with the
/// same id collide (collision.hpp). A device at another baud rate neither hears nor answers.
class VirtualBus final : public hal::FrameBus {
 public:
  /// The plant must outlive the bus and be at time 0.
  VirtualBus(const Params& params, sim::Plant& plant);

  ~VirtualBus();
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  /// A Dynamixel device that `params` does not name; call before the first frame, on a Dynamixel
  /// bus.
  void add(std::unique_ptr<Device> device);

  bool send(const std::uint8_t* data, std::size_t size) override;
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override;
  std::uint64_t now_us() override { return now_ns_ / 1000; }

  /// Control periods since the first tick, as the controller counts them; 0 before it.
  std::uint32_t tick() const { return tick_; }
  bool ticking() const { return ticking_; }
  /// A disconnected device neither hears nor answers.
  void set_connected(std::uint8_t id, bool connected);
  /// Without power a device is disconnected; with power it restarts.
  void set_powered(std::uint8_t id, bool powered);
  const BusWords& words() const { return *words_; }

  /// In real time no read waits for a period, and bring_until() advances time. The half-duplex wire
  /// loses bytes that the master sends before an answer is over (real_time_line.cpp). An incomplete
  /// packet ends at the next header or after a pause.
  void set_real_time(bool real_time) { real_time_ = real_time; }
  /// A transceiver whose receiver stays on while it sends: the master hears its own bytes.
  void set_echo(bool echo) { echo_ = echo; }
  void set_baud(std::uint32_t baud);
  /// Holds the plant: only bytes advance time.
  void hold_plant() { held_ = true; }
  /// Releases the plant and restarts time at 0; devices keep their settings, bytes on the wire are
  /// lost.
  void begin_time();
  bool held() const { return held_; }
  bool torque_on() const;
  bool quiet() const { return replies_.empty() && master_free_ns_ <= now_ns_; }
  std::size_t unsent() const;
  /// The master closed its port: discards its incomplete packet.
  void hung_up() { words_->forget(); }
  /// Requests that arrived during an answer.
  std::uint32_t lost_requests() const { return lost_requests_; }
  /// Advances to `time_us`; stores arriving bytes and returns their number. At `capacity` bytes,
  /// time stops with the last one.
  std::size_t bring_until(std::uint64_t time_us, std::uint8_t* buffer, std::size_t capacity);
  /// Advances time to `time_us` and discards what arrives.
  void let_pass(std::uint64_t time_us) {
    std::uint8_t unheard[hal::kMaxFrame];
    while (now_us() < time_us) bring_until(time_us, unheard, sizeof unheard);
  }

  std::uint64_t bytes_on_wire() const { return bytes_on_wire_; }
  /// A passive listener, called for what the master or the devices put on the line; begin and end
  /// of the bytes are known then, and may lie ahead. The call for an
  /// answer may come before that for its request.
  using Listener = std::function<void(bool master, std::span<const std::uint8_t> bytes,
                                      std::uint64_t begin_ns, std::uint64_t end_ns)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  // For the words.
  /// Brings the plant to the end of a request, and lets every device know.
  void request_ended(std::uint64_t end_ns);
  bool hears(const BusDevice& device) const;
  /// Lets devices answer together, after their delays unless `at_once`. say(device) returns the
  /// bytes; call advance_to_answer() in it before reading the plant.
  template <class Speaker, class Say>
  void speak(const std::vector<Speaker*>& speakers, bool at_once, Say&& say);
  void advance_to_answer() { advance_plant(wire_free_ns_ / 1000); }
  std::uint64_t wire_free_ns() const { return wire_free_ns_; }
  void hold_wire_until(std::uint64_t time_ns) { wire_free_ns_ = std::max(wire_free_ns_, time_ns); }

 private:
  struct Chunk {
    std::uint64_t asked_ns = 0;  ///< its sender is deaf from here on
    std::uint64_t start_ns = 0;
    std::size_t taken = 0;
    std::vector<std::uint8_t> bytes;
    bool echo = false;  ///< of the master, not a device's answer
  };

  std::uint64_t bytes_ns(std::size_t count) const;
  std::uint64_t begin_tick(std::uint64_t ready_ns);
  std::size_t arrive(std::uint64_t deadline_ns, std::uint8_t* buffer, std::size_t capacity);

  // real_time_line.cpp
  void talk(const std::uint8_t* data, std::size_t size);
  /// True if an answer is in progress; `byte` then corrupts the part of it on the line.
  bool jams(std::uint8_t byte, std::uint64_t start_ns, std::uint64_t end_ns);
  /// Advances the plant, and runs the devices' own actions on the way.
  void advance_plant(std::uint64_t time_us);
  void wait_us(std::uint32_t delay_us);
  void put_on_wire(std::vector<std::uint8_t> bytes);
  void queue(Chunk chunk);
  void sent(std::span<const std::uint8_t> bytes, std::uint64_t begin_ns);
  void tell(bool master, std::span<const std::uint8_t> bytes, std::uint64_t begin_ns) const {
    if (listener_) listener_(master, bytes, begin_ns, begin_ns + bytes_ns(bytes.size()));
  }

  sim::Plant& plant_;
  std::uint64_t period_ns_;
  std::uint32_t baud_;
  std::vector<std::unique_ptr<BusDevice>> devices_;
  std::unique_ptr<BusWords> words_;
  std::array<bool, 256> unplugged_{};
  std::array<bool, 256> unpowered_{};
  std::deque<Chunk> replies_;
  Listener listener_;
  std::uint64_t now_ns_ = 0;
  std::uint64_t wire_free_ns_ = 0;
  std::uint64_t asked_ns_ = 0;        ///< when the next sender received its request
  std::uint64_t master_free_ns_ = 0;  ///< real time: end of the master's last byte
  std::uint64_t send_start_ns_ = 0;   ///< of the last sent frame
  std::uint64_t tick_start_ns_ = 0;
  std::uint64_t first_tick_ns_ = 0;
  std::uint64_t bytes_on_wire_ = 0;
  std::uint32_t tick_ = 0;
  std::uint32_t lost_requests_ = 0;
  bool jammed_ = false;
  bool ticking_ = false;
  bool real_time_ = false;
  bool held_ = false;
  bool echo_ = false;
};

template <class Speaker, class Say>
void VirtualBus::speak(const std::vector<Speaker*>& speakers, bool at_once, Say&& say) {
  if (speakers.empty()) return;
  const auto delay_us = [&](const Speaker* each) { return at_once ? 0 : each->return_delay_us(); };
  std::uint32_t first_us = delay_us(speakers.front());
  for (const Speaker* each : speakers) first_us = std::min(first_us, delay_us(each));
  wait_us(first_us);
  std::vector<Voice> voices;
  for (std::size_t i = 0; i < speakers.size(); ++i) {
    // No two clocks agree: each device starts one bit later.
    const std::uint64_t late_us = delay_us(speakers[i]) - first_us;
    const auto late_bits = static_cast<std::uint32_t>(late_us * baud_ / 1'000'000 + i);
    voices.push_back({say(*speakers[i]), late_bits});
  }
  put_on_wire(bus::heard(voices));
}

}  // namespace verp::bus
