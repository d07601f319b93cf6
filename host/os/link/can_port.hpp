#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/can_outbox.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/os/link/can_interface.hpp"
#include "host/os/link/can_trouble.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/port.hpp"

namespace verp::link {

struct CanBatch;

/// Accepts identifiers equal to `id` in the bits of `mask`.
struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;
  bool extended = false;
};

/// The PC's CanBus, in wall time: a raw SocketCAN socket for one thread.
///
/// Time is the monotonic clock; frames have the kernel's receive time. Frames in the kernel's short
/// queue leave in its order, those here by priority. An interface that is down or gone acts like a
/// silent bus, and is used again when it is back. Waiting frames are then dropped and counted, as
/// at a bus-off: old goals must not leave later.
class CanPort : public hal::CanBus {
 public:
  /// `filters`: any of them accepts; empty: all. With filters, a poll's timeout starts at an
  /// accepted frame, not when that left. Without `stamps` frames have the time of this port's read,
  /// which saves clock reads. Throws LinkError.
  explicit CanPort(const Endpoint& endpoint, const std::vector<CanFilter>& filters = {},
                   bool stamps = true);

  virtual ~CanPort() = default;

  // CanBus
  bool send(const CanFrame& frame) override;
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override;
  /// Sends in one kernel call if possible, in this order. Returns the number before the first
  /// refused frame.
  std::size_t send_all(const CanFrame* frames, std::size_t count);
  /// Like poll(), but the timeout starts now.
  bool await(CanFrame& frame, std::uint32_t wait_us);
  std::uint64_t now_us() override;
  hal::CanErrors errors() const override;

  /// Errors by kind; updated by each send and poll.
  const CanTrouble& trouble() const { return trouble_; }
  /// Interface up and this node on the bus, as of the last send or poll.
  bool connected() const { return !away_ && !bus_off_; }
  const CanInterface& interface() const { return interface_; }

 private:
  struct Arrived {
    CanFrame frame;
    std::uint64_t time_us;
  };
  static constexpr std::size_t kInbox = 256;

  void open();
  void set_up(int socket, const std::vector<CanFilter>& filters);
  void look_for_it();
  void lose(int error);
  void drop_what_waits();
  /// Reads frames as far as there is room.
  void drain();
  bool receive_some();
  void take(CanBatch& batch, std::size_t index, std::uint64_t now_ns, std::uint64_t now_wall_ns);
  bool take_from_inbox(CanFrame& frame);
  void take_error_frame(const std::uint8_t* data, std::uint32_t kinds);
  bool may_leave(const CanFrame& frame) const;
  /// Sends while the kernel accepts frames.
  void push();
  /// Like push(), for frames that have not waited; returns the number accepted.
  std::size_t push_at_once(const CanFrame* frames, std::size_t count);
  bool receive_waiting(CanFrame& frame);
  bool receive(CanFrame& frame, const std::uint64_t& since_us, std::uint32_t wait_us);
  void wait(std::uint64_t most_ns) const;
  std::uint64_t us_since_opened(std::uint64_t time_ns) const;

  Endpoint endpoint_;
  std::vector<CanFilter> filters_;
  bool stamps_;
  CanInterface interface_;
  Descriptor socket_;
  std::uint64_t opened_ns_;
  std::uint64_t anchor_us_ = 0;  ///< when the last accepted frame left
  std::uint64_t last_us_ = 0;
  bool stands_ = false;  ///< now_us() is frozen since a poll returned a frame
  bool away_ = false;
  bool bus_off_ = false;
  std::uint64_t looked_ns_ = 0;
  std::size_t in_kernel_ = 0;  ///< frames given to the kernel, not confirmed
  std::uint32_t queue_drops_ = 0;
  CanTrouble trouble_;
  CanOutbox<hal::kCanQueue> outbox_;
  std::size_t inbox_first_ = 0;
  std::size_t inbox_count_ = 0;
  Arrived inbox_[kInbox];
};

}  // namespace verp::link
