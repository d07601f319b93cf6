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

/// A robot's servo bus in memory: a FrameBus whose devices stand on a plant, in simulated time.
///
/// Lockstep: a broadcast (Fast) Sync Read that covers Present Position begins a tick. It waits on
/// the wire for the next multiple of the control period; nothing else lets time pass but bytes,
/// reply delays and poll's timeouts. Registers are sampled when a device's reply begins, writes
/// take effect when their last byte has arrived.
///
/// In a Sync or Bulk Read each device waits for the one before it: a silent one silences those
/// behind it. Devices with the same id answer over each other, and what arrives is neither's packet
/// (collision.hpp). One set to another baud rate hears and says nothing. Deterministic: the same
/// frames give the same replies at the same times.
class VirtualBus {
 public:
  /// Servos, IMU and feet as `params` names them. The plant must outlive the bus and stand at time
  /// 0.
  VirtualBus(const Params& params, sim::Plant& plant);

  /// One more, that `params` do not name; before the first frame.
  void add(std::unique_ptr<Device> device) { devices_.push_back(std::move(device)); }

  bool send(const std::uint8_t* data, std::size_t size);
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us);
  std::uint64_t now_us() const { return now_ns_ / 1000; }

  /// Control periods since the first tick; 0 before it. The controller counts the same ticks.
  std::uint32_t tick() const { return tick_; }
  /// True once the first tick has begun.
  bool ticking() const { return ticking_; }
  /// Unplugs a device or plugs it in again; unplugged it neither hears nor answers.
  void set_connected(std::uint8_t id, bool connected);
  /// Cuts a device's power or gives it back: it is unplugged meanwhile and begins anew.
  void set_powered(std::uint8_t id, bool powered);
  /// Whether a packet makes a tick begin, if time does not go on by itself.
  static bool begins_tick(const dxl::Packet& packet);

  /// In real time no read waits for a period to begin; bring_until() lets time go on. The master
  /// speaks when it likes (real_time_line.cpp): what it says before an answer is over is lost, as
  /// on a wire that all share, and half a packet ends where the next begins, or with a pause.
  void set_real_time(bool real_time) { real_time_ = real_time; }
  /// The rate of the master's port: devices set to another one hear and say nothing.
  void set_baud(std::uint32_t baud);
  /// While the plant is held, time goes on for bytes only.
  void hold_plant() { held_ = true; }
  /// Lets the plant go: it is 0 o'clock again, what the devices were told stays. What is still on
  /// the wire is lost.
  void begin_time();
  bool held() const { return held_; }
  bool torque_on() const;
  /// Nothing is on the wire, nor is anything about to be.
  bool quiet() const { return replies_.empty() && master_free_ns_ <= now_ns_; }
  /// Bytes of the master's that have not left its port yet.
  std::size_t unsent() const;
  /// The master's port is closed: nobody will end its last packet.
  void hung_up() { line_.reset(); }
  /// Of the master's, which came while an answer was under way.
  std::uint32_t lost_requests() const { return lost_requests_; }
  /// Lets time go on up to `time_us`, and the plant follow; stores the bytes that arrive until then
  /// and returns how many. If there are more than `capacity`, time stops with the last one stored.
  std::size_t bring_until(std::uint64_t time_us, std::uint8_t* buffer, std::size_t capacity);
  /// Lets time go on up to there; what arrives meanwhile, nobody hears.
  void let_pass(std::uint64_t time_us) {
    std::uint8_t unheard[hal::kMaxFrame];
    while (now_us() < time_us) bring_until(time_us, unheard, sizeof unheard);
  }

  /// Bytes that crossed the wire in either direction.
  std::uint64_t bytes_on_wire() const { return bytes_on_wire_; }

 private:
  struct Chunk {
    std::uint64_t asked_ns = 0;  ///< from here on who says it hears nothing else
    std::uint64_t start_ns = 0;  ///< when its first byte's start bit began
    std::size_t taken = 0;
    std::vector<std::uint8_t> bytes;
  };

  /// A Ping to all is answered in slots: the device with id n after n of them.
  static constexpr std::uint64_t kPingSlot_us = 3000;

  std::uint64_t bytes_ns(std::size_t count) const;
  /// All that have this id; only ids given twice make them more than one.
  std::vector<Device*> devices(std::uint8_t id);
  std::uint64_t begin_tick(std::uint64_t ready_ns);
  std::size_t arrive(std::uint64_t deadline_ns, std::uint8_t* buffer, std::size_t capacity);

  // real_time_line.cpp
  void talk(const std::uint8_t* data, std::size_t size);
  /// An answer is under way then; what of it is on the line is spoilt by `byte`.
  bool jams(std::uint8_t byte, std::uint64_t start_ns, std::uint64_t end_ns);
  /// False for a device that is unplugged, or set to another baud rate.
  bool hears(const Device& device) const;
  /// Takes the plant there, and on the way lets devices do what they do by themselves.
  void advance_plant(std::uint64_t time_us);
  /// Lets a Return Delay Time pass; the reply's bytes come next.
  void wait_us(std::uint32_t delay_us);
  /// Lets each of `speakers` say what `say` makes of it, all after the shortest of their delays, or
  /// at once.
  template <class Say>
  void speak(const std::vector<Device*>& speakers, bool at_once, Say&& say);
  void put_on_wire(std::vector<std::uint8_t> bytes);

  // instructions.cpp
  void handle(const dxl::Packet& packet, std::uint64_t end_ns);
  /// Does it to all devices addressed, by a Secondary ID too if it is `for_group`; one that was
  /// asked by its own id replies.
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
  dxl::Parser line_;  ///< what the devices hear
  std::deque<Chunk> replies_;
  std::uint64_t now_ns_ = 0;
  std::uint64_t wire_free_ns_ = 0;    ///< when the last byte on the wire ends
  std::uint64_t asked_ns_ = 0;        ///< when the device that speaks next was asked
  std::uint64_t master_free_ns_ = 0;  ///< real time: when the master's last byte ends
  std::uint64_t send_start_ns_ = 0;   ///< when the last frame sent began
  std::uint64_t tick_start_ns_ = 0;
  std::uint64_t first_tick_ns_ = 0;
  std::uint64_t bytes_on_wire_ = 0;
  std::uint32_t tick_ = 0;
  std::uint32_t lost_requests_ = 0;
  std::uint32_t last_four_ = 0;  ///< bytes of the master's, real time
  bool jammed_ = false;          ///< its last byte
  bool ticking_ = false;
  bool real_time_ = false;
  bool held_ = false;
};

static_assert(hal::FrameBus<VirtualBus>);

}  // namespace verp::bus
