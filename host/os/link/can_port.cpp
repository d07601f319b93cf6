#include "host/os/link/can_port.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <string>

#include "host/os/link/can_batch.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::link {
namespace {

using Kind = LinkError::Kind;

// Retry interval: a queue full of other programs' frames gives no event.
constexpr std::uint64_t kRetry_ns = 1'000'000;
constexpr std::uint64_t kLook_ns = 10'000'000;  // retry interval for a missing interface
// Half a second at 1 Mbit/s; the kernel may grant less.
constexpr int kReceiveBuffer = 4 << 20;

[[noreturn]] void cannot_open(const Endpoint& endpoint, int error) {
  const std::string head = to_text(endpoint) + ": ";
  if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT) {
    throw LinkError(Kind::kUnsuitable,
                    head +
                        "this kernel has no CAN sockets; sudo modprobe can-raw, or use one that "
                        "is built with CONFIG_CAN");
  }
  if (error == EPERM || error == EACCES) {
    throw LinkError(Kind::kPermission, head + "no permission; ask for CAP_NET_RAW, or use sudo");
  }
  throw LinkError(Kind::kUnsuitable, head + std::strerror(error) +
                                         "; see what `ip -details link show " + endpoint.place +
                                         "` says");
}

std::uint64_t wall_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000 +
         static_cast<std::uint64_t>(now.tv_nsec);
}

template <class Value>
void set_option(int socket, int level, int option, const Value& value) {
  ::setsockopt(socket, level, option, &value, sizeof value);
}

}  // namespace

CanPort::CanPort(const Endpoint& endpoint, const std::vector<CanFilter>& filters, bool stamps)
    : endpoint_(endpoint), filters_(filters), stamps_(stamps), opened_ns_(monotonic_ns()) {
  open();
}

void CanPort::open() {
  Descriptor made(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (made.get() < 0) cannot_open(endpoint_, errno);
  interface_ = find_can_interface(endpoint_.place);
  set_up(made.get(), filters_);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_.index;
  if (::bind(made.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    cannot_open(endpoint_, errno);
  }
  socket_ = std::move(made);
  queue_drops_ = 0;
}

void CanPort::set_up(int socket, const std::vector<CanFilter>& filters) {
  const int on = 1;
  if (stamps_) set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, on);
  set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, on);
  set_option(socket, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  set_option(socket, SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBuffer);  // root gets the full size
  set_option(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, can_err_mask_t{CAN_ERR_MASK});
  if (interface_.fd) set_option(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on);
  if (filters.empty()) {
    // Our own frames show which still wait and when the last one left.
    set_option(socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, on);
    return;
  }
  std::vector<can_filter> rules;
  for (const CanFilter& each : filters) {
    rules.push_back({each.id | (each.extended ? CAN_EFF_FLAG : 0), each.mask | CAN_EFF_FLAG});
  }
  if (::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, rules.data(),
                   static_cast<socklen_t>(rules.size() * sizeof rules[0])) != 0) {
    cannot_open(endpoint_, errno);
  }
}

std::uint64_t CanPort::us_since_opened(std::uint64_t time_ns) const {
  return time_ns > opened_ns_ ? (time_ns - opened_ns_) / 1000 : 0;
}

void CanPort::drop_what_waits() {
  trouble_.dropped += static_cast<std::uint32_t>(outbox_.size() + in_kernel_);
  outbox_.clear();
  in_kernel_ = 0;
}

void CanPort::lose(int error) {
  if (!away_) ++trouble_.losses;
  away_ = true;
  bus_off_ = false;
  drop_what_waits();
  // A socket works again when its interface is up; it is useless when that was removed.
  if (error != ENETDOWN) socket_.reset();
}

void CanPort::look_for_it() {
  if (!away_) return;
  const std::uint64_t now_ns = monotonic_ns();
  if (now_ns - looked_ns_ < kLook_ns) return;
  looked_ns_ = now_ns;
  try {
    if (socket_.get() < 0) {
      open();
    } else if (find_can_interface(endpoint_.place).index != interface_.index) {
      socket_.reset();
      open();
    }
    away_ = false;
  } catch (const LinkError&) {  // it may come back
  }
}

void CanPort::take_error_frame(const std::uint8_t* data, std::uint32_t kinds) {
  count_error_frame(trouble_, kinds, data);
  if ((kinds & CAN_ERR_BUSOFF) != 0) {
    bus_off_ = true;
    drop_what_waits();
  }
  if ((kinds & CAN_ERR_RESTARTED) != 0) bus_off_ = false;
}

bool CanPort::receive_some() {
  const std::size_t most = std::min(CanBatch::kMost, kInbox - inbox_count_);
  CanBatch batch(most);
  batch.expect_control();
  int count = 0;
  do {
    count = ::recvmmsg(socket_.get(), batch.message, static_cast<unsigned>(most), 0, nullptr);
  } while (count < 0 && errno == EINTR);
  if (count < 0) {
    if (errno != EAGAIN && errno != EWOULDBLOCK) lose(errno);
    return false;
  }
  const std::uint64_t now_wall_ns = stamps_ ? wall_ns() : 0, now_ns = monotonic_ns();
  const auto received = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < received; ++i) take(batch, i, now_ns, now_wall_ns);
  return received == most;
}

void CanPort::take(CanBatch& batch, std::size_t index, std::uint64_t now_ns,
                   std::uint64_t now_wall_ns) {
  const canfd_frame& raw = batch.raw[index];
  mmsghdr& message = batch.message[index];
  const CanBeside beside = read_beside(message.msg_hdr);
  if (beside.drops_told) {
    trouble_.socket_overruns += beside.drops - queue_drops_;
    queue_drops_ = beside.drops;
  }
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    return take_error_frame(raw.data, raw.can_id & CAN_ERR_MASK);
  }
  // Only the stamp's age counts: the wall clock may be set.
  const std::uint64_t age_ns = now_wall_ns > beside.wall_ns ? now_wall_ns - beside.wall_ns : 0;
  const std::uint64_t time_us = us_since_opened(now_ns > age_ns ? now_ns - age_ns : 0);
  bus_off_ = false;  // a node that receives is not bus-off
  if ((message.msg_hdr.msg_flags & MSG_CONFIRM) != 0) {
    if (in_kernel_ > 0) --in_kernel_;
    anchor_us_ = std::max(anchor_us_, time_us);
    return;
  }
  inbox_[(inbox_first_ + inbox_count_++) % kInbox] = {
      from_kernel(raw, message.msg_len == CANFD_MTU), time_us};
}

void CanPort::drain() {
  while (socket_.get() >= 0 && inbox_count_ < kInbox && receive_some()) {
  }
}

bool CanPort::may_leave(const CanFrame& frame) const {
  return is_sound(frame) && (!frame.fd || interface_.fd) && connected();
}

std::size_t CanPort::push_at_once(const CanFrame* frames, std::size_t count) {
  std::size_t size = 0;
  while (size < std::min(count, CanBatch::kMost) && may_leave(frames[size])) ++size;
  CanBatch batch(size);
  for (std::size_t i = 0; i < size; ++i) {
    batch.raw[i] = to_kernel(frames[i]);
    batch.part[i].iov_len = frames[i].fd ? CANFD_MTU : CAN_MTU;
  }
  int sent = 0;
  do {
    sent = ::sendmmsg(socket_.get(), batch.message, static_cast<unsigned>(size), 0);
  } while (sent < 0 && errno == EINTR);
  if (sent < 0) {
    if (errno != ENOBUFS && errno != EAGAIN) lose(errno);
    return 0;
  }
  if (filters_.empty()) in_kernel_ += static_cast<std::size_t>(sent);
  return static_cast<std::size_t>(sent);
}

void CanPort::push() {
  while (!outbox_.empty() && !away_) {
    if (push_at_once(&outbox_.best(), 1) == 0) return;  // queue full, or interface lost
    outbox_.pop();
  }
}

bool CanPort::send(const CanFrame& frame) {
  stands_ = false;
  look_for_it();
  drain();
  if (!may_leave(frame) || !outbox_.push(frame)) return false;
  anchor_us_ = us_since_opened(monotonic_ns());
  push();
  if (connected()) return true;
  --trouble_.dropped;  // not accepted, so not dropped
  return false;
}

std::size_t CanPort::send_all(const CanFrame* frames, std::size_t count) {
  stands_ = false;
  look_for_it();
  std::size_t accepted = 0;
  while (accepted < count && outbox_.empty() && may_leave(frames[accepted])) {
    anchor_us_ = us_since_opened(monotonic_ns());
    const std::size_t taken = push_at_once(frames + accepted, count - accepted);
    if (taken == 0) break;
    accepted += taken;
  }
  while (accepted < count && send(frames[accepted])) ++accepted;
  return accepted;
}

void CanPort::wait(std::uint64_t most_ns) const {
  if (!outbox_.empty()) most_ns = std::min(most_ns, kRetry_ns);
  if (away_) most_ns = std::min(most_ns, kLook_ns);
  pollfd one{socket_.get(), POLLIN, 0};
  const timespec time = to_timespec(most_ns);
  ::ppoll(&one, socket_.get() < 0 ? 0 : 1, &time, nullptr);
}

bool CanPort::take_from_inbox(CanFrame& frame) {
  if (inbox_count_ == 0) return false;
  const Arrived& first = inbox_[inbox_first_];
  frame = first.frame;
  last_us_ = std::max(last_us_, first.time_us);
  stands_ = true;
  inbox_first_ = (inbox_first_ + 1) % kInbox;
  --inbox_count_;
  return true;
}

bool CanPort::receive_waiting(CanFrame& frame) {
  // A frame behind another one needs no look at the bus.
  if (outbox_.empty() && take_from_inbox(frame)) return true;
  look_for_it();
  drain();
  push();
  return take_from_inbox(frame);
}

// `since_us` changes when one of our frames turns out to have left.
bool CanPort::receive(CanFrame& frame, const std::uint64_t& since_us, std::uint32_t wait_us) {
  for (;;) {
    const std::uint64_t now_us = us_since_opened(monotonic_ns());
    if (receive_waiting(frame)) return true;
    const std::uint64_t deadline_us = since_us + wait_us;
    if (now_us >= deadline_us) {
      stands_ = false;
      return false;
    }
    wait((deadline_us - now_us) * 1000);
  }
}

bool CanPort::poll(CanFrame& frame, std::uint32_t timeout_us) {
  if (outbox_.empty() && take_from_inbox(frame)) return true;
  return receive(frame, anchor_us_, timeout_us);
}

bool CanPort::await(CanFrame& frame, std::uint32_t wait_us) {
  if (outbox_.empty() && take_from_inbox(frame)) return true;
  stands_ = false;
  if (wait_us == 0) return receive_waiting(frame);
  const std::uint64_t now_us = us_since_opened(monotonic_ns());
  wait(std::uint64_t{wait_us} * 1000);  // at once if something is there
  return receive(frame, now_us, wait_us);
}

std::uint64_t CanPort::now_us() {
  if (!stands_) last_us_ = std::max(last_us_, us_since_opened(monotonic_ns()));
  return last_us_;
}

hal::CanErrors CanPort::errors() const {
  return {.errors = trouble_.error_frames,
          .overruns = trouble_.socket_overruns + trouble_.controller_overruns,
          .bus_offs = trouble_.bus_offs,
          .dropped = trouble_.dropped};
}

}  // namespace verp::link
