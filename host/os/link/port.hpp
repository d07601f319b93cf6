#pragma once
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "hal/contract/byte_link.hpp"
#include "host/os/link/endpoint.hpp"

namespace verp::link {

/// A file descriptor with one owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    reset(std::exchange(other.number_, -1));
    return *this;
  }
  ~Descriptor() { reset(); }
  int get() const { return number_; }
  void reset(int number = -1) {
    if (number_ >= 0) ::close(number_);
    number_ = number;
  }

 private:
  int number_;
};

/// What a Link is opened on; one for each kind of endpoint. Not for threads.
class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  /// A descriptor that never blocks, of this Port's, to a peer; -1: nobody is there yet. Never
  /// waits for long. Throws LinkError.
  virtual int open() = 0;
  /// After a loss: the descriptor is of no more use.
  virtual void close() = 0;
  /// When to try open() again.
  virtual std::uint32_t retry_us() const = 0;
  /// What a peer may be told to open; see Link::place().
  virtual std::string place() const = 0;
  /// The rate in baud that a peer has set; 0: there is none, or it is nothing to the peer.
  virtual std::uint32_t rate() const { return 0; }
  /// The rate that a peer finds, and may change. One that came first, and has set its own, keeps
  /// it.
  virtual void set_rate(std::uint32_t) {}
  /// Since this Port was made, without losses.
  virtual hal::LinkErrors counted() { return {}; }
};

/// Makes what can be made at once (a listening socket, a pseudo-terminal); throws LinkError.
std::unique_ptr<Port> make_port(const Endpoint& endpoint);

std::unique_ptr<Port> make_serial_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_pty_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_tcp_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_tcp_listener(const Endpoint& endpoint);
std::unique_ptr<Port> make_unix_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_unix_listener(const Endpoint& endpoint);

}  // namespace verp::link
