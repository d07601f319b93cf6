#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "hal/contract/frame_bus.hpp"
#include "host/twin/bus/device.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

/// A FrameBus in memory with devices on a plant, in simulated time: the same frames give the same
/// replies at the same times.
///
/// In lockstep a broadcast (Fast) Sync Read of Present Position begins a tick and waits on the wire
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

  /// A device that `params` does not name; call before the first frame.
  void add(std::unique_ptr<Device> device) { devices_.push_back(std::move(device)); }

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
  static bool begins_tick(const dxl::Packet& packet);

  /// In real time no read waits for a period, and bring_until() advances time. The half-duplex wire
  /// loses bytes that the master sends before an answer is over (real_time_line.cpp). An incomplete
  /// packet ends at the next header or after a pause.
  void set_real_time(bool real_time) { real_time_ = real_time; }
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
  void hung_up() { line_.reset(); }
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

 private:
  struct Chunk {
    std::uint64_t asked_ns = 0;  ///< its sender is deaf from here on
    std::uint64_t start_ns = 0;
    std::size_t taken = 0;
    std::vector<std::uint8_t> bytes;
  };

  /// A broadcast Ping is answered in slots: id n in slot n.
  static constexpr std::uint64_t kPingSlot_us = 3000;

  std::uint64_t bytes_ns(std::size_t count) const;
  /// More than one only if ids are duplicated.
  std::vector<Device*> devices(std::uint8_t id);
  std::uint64_t begin_tick(std::uint64_t ready_ns);
  std::size_t arrive(std::uint64_t deadline_ns, std::uint8_t* buffer, std::size_t capacity);

  // real_time_line.cpp
  void talk(const std::uint8_t* data, std::size_t size);
  /// True if an answer is in progress; `byte` then corrupts the part of it on the line.
  bool jams(std::uint8_t byte, std::uint64_t start_ns, std::uint64_t end_ns);
  bool hears(const Device& device) const;
  /// Advances the plant, and runs the devices' own actions on the way.
  void advance_plant(std::uint64_t time_us);
  void wait_us(std::uint32_t delay_us);
  template <class Say>
  void speak(const std::vector<Device*>& speakers, bool at_once, Say&& say);
  void put_on_wire(std::vector<std::uint8_t> bytes);

  // instructions.cpp
  void handle(const dxl::Packet& packet, std::uint64_t end_ns);
  /// `for_group`: by Secondary ID too. Only a device addressed by its own id replies.
  template <class Apply>
  void command(std::uint8_t id, bool for_group, Apply apply);
  void ping(std::uint8_t id);
  void identify(std::uint8_t id);
  void read(const dxl::Packet& packet);
  void factory_reset(const dxl::Packet& packet);
  void read_each(const dxl::Packet& packet);
  void read_fast(const dxl::Packet& packet);
  void write_each(const dxl::Packet& packet);

  sim::Plant& plant_;
  std::uint64_t period_ns_;
  std::uint32_t baud_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::array<bool, 256> unplugged_{};
  std::array<bool, 256> unpowered_{};
  dxl::Parser line_;
  std::deque<Chunk> replies_;
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
  std::uint32_t last_four_ = 0;  ///< last four bytes of the master, in real time
  bool jammed_ = false;
  bool ticking_ = false;
  bool real_time_ = false;
  bool held_ = false;
};

}  // namespace verp::bus
