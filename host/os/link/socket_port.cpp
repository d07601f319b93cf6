#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/os/link/link_error.hpp"
#include "host/os/link/port.hpp"

namespace verp::link {
namespace {

constexpr int kConnectTimeout_ms = 2000;
constexpr std::uint32_t kRetryClient_us = 50'000;
constexpr std::uint32_t kRetryListener_us = 1000;

using Kind = LinkError::Kind;

struct Address {
  int family = AF_UNIX;
  socklen_t size = 0;
  sockaddr_storage storage{};
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

[[noreturn]] void fail(const Endpoint& endpoint, int error) {
  const bool listens =
      endpoint.kind == Endpoint::Kind::kTcpListen || endpoint.kind == Endpoint::Kind::kUnixListen;
  Kind kind = Kind::kNoDevice;
  std::string remedy = "is the other end started, and the name right?";
  if (error == EACCES || error == EPERM) {
    kind = Kind::kPermission;
    remedy = listens ? "choose a port above 1023, or a folder of yours"
                     : "ask who started the other end to let you in";
  } else if (error == EADDRINUSE) {
    kind = Kind::kBusy;
    remedy = "another program listens there; end it, or choose another";
  } else if (error == ECONNREFUSED || error == ETIMEDOUT) {
    kind = Kind::kRefused;
    remedy = "nobody listens there; start the other end first";
  } else if (listens) {
    remedy = "choose an address or a folder of this PC";
  }
  throw LinkError(kind, to_text(endpoint) + ": " + std::strerror(error) + "; " + remedy);
}

Address unix_address(const Endpoint& endpoint) {
  Address address;
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::memcpy(name.sun_path, endpoint.place.data(), endpoint.place.size());
  std::memcpy(&address.storage, &name, sizeof name);
  address.size = sizeof name;
  return address;
}

Address tcp_address(const Endpoint& endpoint) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error =
      ::getaddrinfo(endpoint.place.c_str(), std::to_string(endpoint.port).c_str(), &hints, &found);
  if (error != 0) {
    throw LinkError(LinkError::Kind::kNoDevice, to_text(endpoint) + ": " + ::gai_strerror(error) +
                                                    "; write a host's name or address");
  }
  Address address;
  address.family = found->ai_family;
  address.size = found->ai_addrlen;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  ::freeaddrinfo(found);
  return address;
}

Descriptor new_socket(const Endpoint& endpoint, const Address& address) {
  Descriptor made(::socket(address.family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (made.get() < 0) fail(endpoint, errno);
  return made;
}

// Frames are small and wait for answers, so TCP must not delay them.
void send_at_once(int descriptor) {
  const int on = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

class SocketPort final : public Port {
 public:
  SocketPort(Endpoint endpoint, const Address& address)
      : endpoint_(std::move(endpoint)), address_(address) {}

  int open() override {
    Descriptor made = new_socket(endpoint_, address_);
    if (::connect(made.get(), address_.get(), address_.size) != 0) {
      if (errno != EINPROGRESS) fail(endpoint_, errno);
      pollfd one{made.get(), POLLOUT, 0};
      if (::poll(&one, 1, kConnectTimeout_ms) <= 0) fail(endpoint_, ETIMEDOUT);
      int error = 0;
      socklen_t size = sizeof error;
      ::getsockopt(made.get(), SOL_SOCKET, SO_ERROR, &error, &size);
      if (error != 0) fail(endpoint_, error);
    }
    send_at_once(made.get());
    peer_ = std::move(made);
    return peer_.get();
  }
  void close() override { peer_.reset(); }
  std::uint32_t retry_us() const override { return kRetryClient_us; }
  std::string place() const override { return to_text(endpoint_); }

 private:
  Endpoint endpoint_;
  Address address_;
  Descriptor peer_;
};

/// The next peer waits for the last one to leave.
class Listener final : public Port {
 public:
  Listener(Endpoint endpoint, const Address& address) : endpoint_(std::move(endpoint)) {
    listening_ = new_socket(endpoint_, address);
    if (address.family == AF_UNIX) remove_dead_socket(address);
    const int on = 1;
    ::setsockopt(listening_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (::bind(listening_.get(), address.get(), address.size) != 0 ||
        ::listen(listening_.get(), 1) != 0) {
      fail(endpoint_, errno);
    }
    bound_ = true;
    if (address.family == AF_UNIX) return;
    sockaddr_storage name{};
    socklen_t size = sizeof name;
    ::getsockname(listening_.get(), reinterpret_cast<sockaddr*>(&name), &size);
    // The port is at the same offset in both families.
    endpoint_.port = ntohs(reinterpret_cast<const sockaddr_in*>(&name)->sin_port);
  }
  ~Listener() override {
    if (bound_ && endpoint_.kind == Endpoint::Kind::kUnixListen) ::unlink(endpoint_.place.c_str());
  }

  int open() override {
    peer_.reset(::accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (peer_.get() >= 0) send_at_once(peer_.get());
    return peer_.get();
  }
  void close() override { peer_.reset(); }
  std::uint32_t retry_us() const override { return kRetryListener_us; }
  std::string place() const override {
    Endpoint peer = endpoint_;
    peer.kind =
        endpoint_.kind == Endpoint::Kind::kTcpListen ? Endpoint::Kind::kTcp : Endpoint::Kind::kUnix;
    return to_text(peer);
  }

 private:
  // A killed program leaves its socket behind; connecting to it is refused.
  void remove_dead_socket(const Address& address) const {
    struct stat status {};
    if (::stat(endpoint_.place.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return;
    const Descriptor probe = new_socket(endpoint_, address);
    if (::connect(probe.get(), address.get(), address.size) != 0 && errno == ECONNREFUSED) {
      ::unlink(endpoint_.place.c_str());
    }
  }

  Endpoint endpoint_;
  Descriptor listening_;
  Descriptor peer_;
  bool bound_ = false;
};

}  // namespace

std::unique_ptr<Port> make_tcp_port(const Endpoint& endpoint) {
  return std::make_unique<SocketPort>(endpoint, tcp_address(endpoint));
}
std::unique_ptr<Port> make_tcp_listener(const Endpoint& endpoint) {
  return std::make_unique<Listener>(endpoint, tcp_address(endpoint));
}
std::unique_ptr<Port> make_unix_port(const Endpoint& endpoint) {
  return std::make_unique<SocketPort>(endpoint, unix_address(endpoint));
}
std::unique_ptr<Port> make_unix_listener(const Endpoint& endpoint) {
  return std::make_unique<Listener>(endpoint, unix_address(endpoint));
}

}  // namespace verp::link
