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

/// The PC's ByteLink: a serial port, a pseudo-terminal or a socket. After a loss it finds the other
/// end again by itself, within read() and write(). Use one Link from one thread.
class Link {
 public:
  /// Opens it. A listener or pseudo-terminal is not connected before somebody came. Throws
  /// LinkError.
  explicit Link(const Endpoint& endpoint);

  /// What somebody else can be told to open: `/dev/pts/4`, `tcp:127.0.0.1:6000`.
  std::string place() const { return port_->place(); }
  /// Of a pseudo-terminal: the rate in baud that its other end has set, or found; else 0.
  std::uint32_t rate() const { return port_->rate(); }
  void set_rate(std::uint32_t baud) { port_->set_rate(baud); }

  // ByteLink
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us);
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us);
  bool connected() const { return descriptor_ >= 0; }
  hal::LinkErrors errors() const;

  /// Waits until somebody is there; false: timeout_us has passed. Also what read() and write() do.
  bool wait_connected(std::uint32_t timeout_us);

 private:
  /// In nanoseconds of the monotonic clock.
  bool connect_until(std::uint64_t deadline_ns);
  void lose();
  bool unread() const;

  std::unique_ptr<Port> port_;
  int descriptor_ = -1;
  std::uint32_t losses_ = 0;
};

static_assert(hal::ByteLink<Link>);

}  // namespace verp::link
