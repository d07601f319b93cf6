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

/// The PC's ByteLink: serial port, pseudo-terminal or socket. read() and write() reconnect after a
/// loss. For one thread.
class Link final : public hal::ByteLink {
 public:
  /// A listener or pseudo-terminal connects when a peer comes. Throws LinkError.
  explicit Link(const Endpoint& endpoint);

  /// Endpoint that a peer can open: `/dev/pts/4`, `tcp:127.0.0.1:6000`.
  std::string place() const { return port_->place(); }
  /// Baud of a pseudo-terminal's other end; otherwise 0.
  std::uint32_t rate() const { return port_->rate(); }
  void set_rate(std::uint32_t baud) { port_->set_rate(baud); }

  // ByteLink
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) override;
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override;
  bool connected() const override { return descriptor_ >= 0; }
  hal::LinkErrors errors() const override;

  /// Waits for a peer; false: timeout. read() and write() wait too.
  bool wait_connected(std::uint32_t timeout_us);

 private:
  /// The deadline is in ns of the monotonic clock.
  bool connect_until(std::uint64_t deadline_ns);
  void lose();
  bool unread() const;

  std::unique_ptr<Port> port_;
  int descriptor_ = -1;
  std::uint32_t losses_ = 0;
};

}  // namespace verp::link
