#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "host/os/link/link_error.hpp"
#include "host/os/link/port.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::link {
namespace {

constexpr int kConnectTimeout_ms = 2000;
constexpr std::uint32_t kRetryClient_us = 50'000;
constexpr std::uint32_t kRetryListener_us = 1000;
constexpr std::size_t kLeastToken = 16, kMostToken = 256;
constexpr std::uint64_t kGreeting_ns = 1'000'000'000;  // for a peer's secret

using Kind = LinkError::Kind;

struct Address {
  int family = AF_UNIX;
  socklen_t size = 0;
  sockaddr_storage storage{};
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

bool is_no_socket(const Endpoint& endpoint) {
  struct stat status {};
  return endpoint.kind == Endpoint::Kind::kUnixListen &&
         ::lstat(endpoint.place.c_str(), &status) == 0 && !S_ISSOCK(status.st_mode);
}

[[noreturn]] void fail(const Endpoint& endpoint, int error) {
  const bool listens =
      endpoint.kind == Endpoint::Kind::kTcpListen || endpoint.kind == Endpoint::Kind::kUnixListen;
  Kind kind = Kind::kNoDevice;
  std::string remedy = "is the other end started, and the name right?";
  if (error == EACCES || error == EPERM) {
    kind = Kind::kPermission;
    remedy = listens ? "choose a port above 1023, or a folder of yours"
                     : "ask who started the other end to let you in";
  } else if (error == EADDRINUSE && is_no_socket(endpoint)) {
    kind = Kind::kUnsuitable;
    remedy = "what is there is no socket; choose another path";
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

/// IPv4's 127.0.0.0/8 and IPv6's ::1.
bool is_loopback(const Address& address) {
  if (address.family == AF_INET6) {
    const auto* name = reinterpret_cast<const sockaddr_in6*>(address.get());
    return IN6_IS_ADDR_LOOPBACK(&name->sin6_addr);
  }
  const auto* name = reinterpret_cast<const sockaddr_in*>(address.get());
  return ntohl(name->sin_addr.s_addr) >> 24 == IN_LOOPBACKNET;
}

/// The line that a peer says first; empty: none.
std::string greeting_of(const Endpoint& endpoint) {
  if (endpoint.token_file.empty()) return "";
  std::ifstream in(endpoint.token_file);
  std::string token;
  std::getline(in, token);
  if (token.size() >= kLeastToken && token.size() <= kMostToken) return token + '\n';
  throw EndpointError("link '" + to_text(endpoint) + "': " + endpoint.token_file +
                      " has no secret of 16 to 256 characters in its first line; write one, as "
                      "`openssl rand -hex 16` makes it, into a file of both ends");
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
      : endpoint_(std::move(endpoint)), address_(address), greeting_(greeting_of(endpoint_)) {}

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
    const ssize_t size = static_cast<ssize_t>(greeting_.size());
    if (::send(made.get(), greeting_.data(), greeting_.size(), MSG_NOSIGNAL) != size)
      fail(endpoint_, ECONNREFUSED);
    peer_ = std::move(made);
    return peer_.get();
  }
  void close() override { peer_.reset(); }
  std::uint32_t retry_us() const override { return kRetryClient_us; }
  std::string place() const override { return to_text(endpoint_); }

 private:
  Endpoint endpoint_;
  Address address_;
  std::string greeting_;
  Descriptor peer_;
};

/// The next peer waits for the last one to leave.
class Listener final : public Port {
 public:
  Listener(Endpoint endpoint, const Address& address)
      : endpoint_(std::move(endpoint)), greeting_(greeting_of(endpoint_)) {
    if (address.family != AF_UNIX && greeting_.empty() && !is_loopback(address)) {
      throw EndpointError("link '" + to_text(endpoint_) +
                          "': whoever reaches this address could move the robot; add ,token=FILE "
                          "with a secret on both ends, or write tcp-listen:" +
                          std::to_string(endpoint_.port));
    }
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
    if (candidate_.get() < 0) {
      candidate_.reset(::accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      said_.clear();
      accepted_ns_ = monotonic_ns();
    }
    if (candidate_.get() < 0 || !knows_the_secret()) return -1;
    peer_ = std::move(candidate_);
    send_at_once(peer_.get());
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
  /// False: not yet, or the candidate is gone.
  bool knows_the_secret() {
    while (said_.size() < greeting_.size()) {
      std::array<char, kMostToken + 1> bytes{};
      const ssize_t count =
          ::recv(candidate_.get(), bytes.data(), greeting_.size() - said_.size(), 0);
      const bool waits = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK) &&
                         monotonic_ns() - accepted_ns_ < kGreeting_ns;
      if (waits) return false;
      if (count <= 0) return turn_away();
      said_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    unsigned wrong = 0;  // equally long wherever they differ
    for (std::size_t i = 0; i < said_.size(); ++i)
      wrong |= static_cast<unsigned char>(said_[i] ^ greeting_[i]);
    return wrong == 0 || turn_away();
  }
  bool turn_away() {
    candidate_.reset();
    return false;
  }

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
  const std::string greeting_;
  Descriptor listening_;
  Descriptor candidate_;  ///< has not said the secret yet
  std::string said_;
  std::uint64_t accepted_ns_ = 0;
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
