#include "host/os/link/link.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>

#include "host/os/link/system_clock.hpp"

namespace verp::link {
namespace {

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK;
}

bool wait_for(int descriptor, short events, std::uint64_t deadline_ns) {
  const std::uint64_t now_ns = monotonic_ns();
  if (now_ns >= deadline_ns) return false;
  pollfd one{descriptor, events, 0};
  const timespec left = to_timespec(deadline_ns - now_ns);
  const int ready = ::ppoll(&one, 1, &left, nullptr);
  return ready > 0 || (ready < 0 && errno == EINTR);
}

// A lost peer must cause an error, not a signal.
ssize_t put(int descriptor, const void* data, std::size_t size) {
  const ssize_t sent = ::send(descriptor, data, size, MSG_NOSIGNAL);
  return sent < 0 && errno == ENOTSOCK ? ::write(descriptor, data, size) : sent;
}

}  // namespace

std::unique_ptr<Port> make_port(const Endpoint& endpoint) {
  switch (endpoint.kind) {
    case Endpoint::Kind::kSerial:
      return make_serial_port(endpoint);
    case Endpoint::Kind::kPty:
      return make_pty_port(endpoint);
    case Endpoint::Kind::kTcp:
      return make_tcp_port(endpoint);
    case Endpoint::Kind::kTcpListen:
      return make_tcp_listener(endpoint);
    case Endpoint::Kind::kUnix:
      return make_unix_port(endpoint);
    case Endpoint::Kind::kUnixListen:
      return make_unix_listener(endpoint);
    case Endpoint::Kind::kCan:
      break;
  }
  throw LinkError(LinkError::Kind::kUnsuitable,
                  to_text(endpoint) +
                      ": a CAN bus carries frames, not a stream of bytes; give a "
                      "serial:, pty:, tcp: or unix: link here");
}

Link::Link(const Endpoint& endpoint) : port_(make_port(endpoint)), descriptor_(port_->open()) {}

void Link::lose() {
  port_->close();
  descriptor_ = -1;
  ++losses_;
}

bool Link::unread() const {
  int bytes = 0;
  return ::ioctl(descriptor_, FIONREAD, &bytes) == 0 && bytes > 0;
}

bool Link::connect_until(std::uint64_t deadline_ns) {
  while (descriptor_ < 0) {
    try {
      descriptor_ = port_->open();
    } catch (const LinkError&) {  // it may come back
    }
    if (descriptor_ >= 0) break;
    const std::uint64_t now_ns = monotonic_ns();
    if (now_ns >= deadline_ns) return false;
    sleep_until_ns(std::min(deadline_ns, now_ns + std::uint64_t{port_->retry_us()} * 1000));
  }
  return true;
}

bool Link::wait_connected(std::uint32_t timeout_us) {
  return connect_until(monotonic_ns() + std::uint64_t{timeout_us} * 1000);
}

std::size_t Link::write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) {
  const std::uint64_t deadline_ns = monotonic_ns() + std::uint64_t{timeout_us} * 1000;
  if (size == 0 || !connect_until(deadline_ns)) return 0;
  std::size_t queued = 0;
  while (queued < size) {
    const ssize_t count = put(descriptor_, data + queued, size - queued);
    if (count > 0) {
      queued += static_cast<std::size_t>(count);
    } else if (count < 0 && would_block(errno)) {
      if (!wait_for(descriptor_, POLLOUT, deadline_ns)) break;
    } else if (count == 0 || errno != EINTR) {
      if (!unread()) lose();  // else read() handles the loss
      break;
    }
  }
  return queued;
}

std::size_t Link::read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
  const std::uint64_t deadline_ns = monotonic_ns() + std::uint64_t{timeout_us} * 1000;
  if (capacity == 0 || !connect_until(deadline_ns)) return 0;
  for (;;) {
    const ssize_t count = ::read(descriptor_, buffer, capacity);
    if (count > 0) return static_cast<std::size_t>(count);
    if (count < 0 && would_block(errno)) {
      if (!wait_for(descriptor_, POLLIN, deadline_ns)) return 0;
    } else if (count == 0 || errno != EINTR) {
      lose();
      return 0;
    }
  }
}

hal::LinkErrors Link::errors() const {
  hal::LinkErrors errors = port_->counted();
  errors.losses = losses_;
  return errors;
}

}  // namespace verp::link
