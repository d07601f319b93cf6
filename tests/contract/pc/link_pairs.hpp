#pragma once
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "host/os/link/endpoint.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"

/// As MemoryPair of fakes.hpp.
namespace verp::test {

class Folder {
 public:
  Folder() {
    if (::mkdtemp(path_) == nullptr) throw std::runtime_error("no folder in /tmp");
  }
  ~Folder() {
    ::unlink((std::string(path_) + "/link").c_str());
    ::rmdir(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string link() const { return std::string(path_) + "/link"; }

 private:
  char path_[32] = "/tmp/verp-link-XXXXXX";
};

/// `Server` is there first; kNearServes: it is under test.
template <bool kNearServes>
class HostPair {
 public:
  static constexpr bool kDetectsLoss = true;
  HostPair(const std::string& server, const std::string& client)
      : server_text_(server), client_text_(client) {
    server_.emplace(link::parse_endpoint(server));
    if (client_text_.empty()) client_text_ = server_->place();
    if (server_->place().starts_with("tcp:")) {  // the same port
      server_text_ = "tcp-listen" + server_->place().substr(3);
    }
    client_.emplace(link::parse_endpoint(client_text_));
    server_->wait_connected(kAWhile_us);
  }
  link::Link& near() { return kNearServes ? *server_ : *client_; }
  link::Link& far() { return kNearServes ? *client_ : *server_; }
  void cut() { kNearServes ? client_.reset() : server_.reset(); }
  void mend() {
    if (kNearServes) {
      client_.emplace(link::parse_endpoint(client_text_));
    } else {
      server_.emplace(link::parse_endpoint(server_text_));
    }
  }
  std::uint64_t now_us() const { return clock_.now_us(); }

 private:
  static constexpr std::uint32_t kAWhile_us = 5'000'000;
  std::string server_text_;
  std::string client_text_;
  std::optional<link::Link> server_;
  std::optional<link::Link> client_;
  link::SystemClock clock_;
};

template <bool kNearServes>
struct SerialPair : Folder, HostPair<kNearServes> {
  static constexpr bool kKeepsBytesOnLoss = kNearServes;  // unplugging discards them
  SerialPair() : HostPair<kNearServes>("pty:" + link(), "serial:" + link() + "@2000000") {}
};
template <bool kNearServes>
struct TcpPair : HostPair<kNearServes> {
  static constexpr bool kKeepsBytesOnLoss = true;
  TcpPair() : HostPair<kNearServes>("tcp-listen:0", "") {}
};
template <bool kNearServes>
struct UnixPair : Folder, HostPair<kNearServes> {
  static constexpr bool kKeepsBytesOnLoss = true;
  UnixPair() : HostPair<kNearServes>("unix-listen:" + link(), "unix:" + link()) {}
};

}  // namespace verp::test
