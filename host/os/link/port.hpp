#pragma once
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "hal/contract/byte_link.hpp"
#include "host/os/link/endpoint.hpp"

namespace verp::link {

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

/// One per kind of endpoint; not thread-safe.
class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  /// A non-blocking descriptor, owned by this Port; -1: no peer yet. Never waits long. Throws
  /// LinkError.
  virtual int open() = 0;
  /// Called after a loss.
  virtual void close() = 0;
  virtual std::uint32_t retry_us() const = 0;
  virtual std::string place() const = 0;
  /// Baud set by a peer; 0: none.
  virtual std::uint32_t rate() const { return 0; }
  /// A peer finds it and may change it; a rate that it set before stays.
  virtual void set_rate(std::uint32_t) {}
  /// Errors since construction, without losses.
  virtual hal::LinkErrors counted() { return {}; }
};

/// Creates a listening socket or pseudo-terminal; throws LinkError.
std::unique_ptr<Port> make_port(const Endpoint& endpoint);

std::unique_ptr<Port> make_serial_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_pty_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_tcp_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_tcp_listener(const Endpoint& endpoint);
std::unique_ptr<Port> make_unix_port(const Endpoint& endpoint);
std::unique_ptr<Port> make_unix_listener(const Endpoint& endpoint);

}  // namespace verp::link
