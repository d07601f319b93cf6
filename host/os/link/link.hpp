#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "hal/contract/byte_link.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/port.hpp"

namespace verp::link {

/// The PC's ByteLink: a serial port, a pseudo-terminal or a socket. After a loss, read() and
/// write() reconnect by themselves. Use one Link from one thread.
class Link {
 public:
  /// Opens the endpoint. A listener or pseudo-terminal is connected only when a peer has come.
  /// Throws LinkError.
  explicit Link(const Endpoint& endpoint);

  /// Endpoint that a peer can open: `/dev/pts/4`, `tcp:127.0.0.1:6000`.
  std::string place() const { return port_->place(); }
  /// For a pseudo-terminal: the rate in baud that its other end has set or found; otherwise 0.
  std::uint32_t rate() const { return port_->rate(); }
  void set_rate(std::uint32_t baud) { port_->set_rate(baud); }

  // ByteLink
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us);
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us);
  bool connected() const { return descriptor_ >= 0; }
  hal::LinkErrors errors() const;

  /// Waits for a peer; false: timeout_us has passed. read() and write() do this too.
  bool wait_connected(std::uint32_t timeout_us);

 private:
  /// Deadline in nanoseconds of the monotonic clock.
  bool connect_until(std::uint64_t deadline_ns);
  void lose();
  bool unread() const;

  std::unique_ptr<Port> port_;
  int descriptor_ = -1;
  std::uint32_t losses_ = 0;
};

static_assert(hal::ByteLink<Link>);

}  // namespace verp::link
