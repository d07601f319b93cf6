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

/// Lets frames in whose identifier has `id`'s bits where `mask` has ones.
struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;
  bool extended = false;
};

/// The PC's CanBus, in wall time: a raw SocketCAN socket. Use one CanPort from one thread.
///
/// Bus time is Linux's monotonic clock; a frame's is the kernel's stamp as it came in. Frames that
/// the kernel has queued leave in its order, not in that of their identifiers: as a rule its queue
/// is short, and what waits here leaves best first. An interface that goes down, or away, is a bus
/// on which nobody answers; it is used again when it is back. As at a bus-off, what waited is
/// dropped then and counted: goals of the past must not leave later.
class CanPort {
 public:
  /// `filters`: lets in what one of them lets in; none: all. With filters, polls count their
  /// timeout from when a frame was accepted, not from when it left. Without `stamps` a frame's time
  /// is when this port read it, which saves looks at clocks. Throws LinkError.
  explicit CanPort(const Endpoint& endpoint, const std::vector<CanFilter>& filters = {},
                   bool stamps = true);

  // CanBus
  bool send(const CanFrame& frame);
  bool poll(CanFrame& frame, std::uint32_t timeout_us);
  /// As send() of one after another, in one call of the kernel where it takes them; they leave in
  /// this order. How many were accepted: those before the first that was refused.
  std::size_t send_all(const CanFrame* frames, std::size_t count);
  /// As poll(), but the time counts from now.
  bool await(CanFrame& frame, std::uint32_t wait_us);
  std::uint64_t now_us();
  hal::CanErrors errors() const;

  /// What went wrong, by kind. Up to date after a send or a poll.
  const CanTrouble& trouble() const { return trouble_; }
  /// The interface is up and this node on the bus. Up to date after a send or a poll.
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
  /// After the interface went: is it back?
  void look_for_it();
  void lose(int error);
  void drop_what_waits();
  /// Reads all that the kernel has, as far as there is room.
  void drain();
  /// False: the kernel has no more for now.
  bool receive_some();
  void take(CanBatch& batch, std::size_t index, std::uint64_t now_ns, std::uint64_t now_wall_ns);
  bool take_from_inbox(CanFrame& frame);
  void take_error_frame(const std::uint8_t* data, std::uint32_t kinds);
  bool may_leave(const CanFrame& frame) const;
  /// Gives the kernel what it takes.
  void push();
  /// The same of frames that have not waited; how many it took.
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
  std::uint64_t anchor_us_ = 0;  ///< when the last accepted frame left, as far as we know
  std::uint64_t last_us_ = 0;    ///< what now_us() said last
  bool stands_ = false;          ///< it stands there since a poll brought a frame
  bool away_ = false;
  bool bus_off_ = false;
  std::uint64_t looked_ns_ = 0;
  std::size_t in_kernel_ = 0;  ///< frames given to the kernel and not confirmed
  std::uint32_t queue_drops_ = 0;
  CanTrouble trouble_;
  CanOutbox<hal::kCanQueue> outbox_;
  std::size_t inbox_first_ = 0;
  std::size_t inbox_count_ = 0;
  Arrived inbox_[kInbox];
};

static_assert(hal::CanBus<CanPort>);

}  // namespace verp::link
