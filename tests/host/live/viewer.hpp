#pragma once
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

/// Shares no code with the server (RFC 6455 and Foxglove's protocol). A minute without a byte fails
/// the test.
namespace verp::live::test {

struct Received {
  int opcode = -1;  ///< 1 text, 2 binary, 8 close; -1: closed socket
  std::string bytes;
};

class Viewer {
 public:
  static constexpr std::string_view kGreeting =
      "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: keep-alive, Upgrade\r\n"
      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n";

  /// `buffer`: of the socket, bytes; 0: default.
  explicit Viewer(std::uint16_t port, int buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval minute{60, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &minute, sizeof(minute));
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &minute, sizeof(minute));
    if (buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof(buffer));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof(place)) != 0)
      ADD_FAILURE() << "no connection to port " << port << ": " << std::strerror(errno);
  }
  ~Viewer() { leave(); }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void leave() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

  /// False if the peer is gone.
  bool put(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  void lose_patience() const {
    const timeval moment{0, 200'000};
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &moment, sizeof(moment));
  }

  std::string greet(std::string_view words = kGreeting) const {
    put(words);
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string byte = take(1);
      if (byte.empty()) break;
      head += byte;
    }
    return head;
  }

  static std::string frame(int opcode, std::string_view bytes) {
    std::string out(1, static_cast<char>(0x80 | opcode));
    if (bytes.size() < 126) {
      out += static_cast<char>(0x80 | bytes.size());
    } else {
      out += static_cast<char>(0x80 | 126);
      out += static_cast<char>(bytes.size() >> 8);
      out += static_cast<char>(bytes.size());
    }
    const std::array<char, 4> mask = {0x12, 0x34, 0x56, 0x78};
    out.append(mask.data(), mask.size());
    for (std::size_t i = 0; i < bytes.size(); ++i)
      out += static_cast<char>(bytes[i] ^ mask[i % mask.size()]);
    return out;
  }
  bool say(std::string_view text) const { return put(frame(1, text)); }
  bool subscribe(std::uint32_t subscription, std::uint32_t channel) const {
    return say(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(subscription) +
               R"(,"channelId":)" + std::to_string(channel) + "}]}");
  }

  Received next() const {
    const std::string head = take(2);
    if (head.size() < 2) return {};
    EXPECT_EQ(head[1] & 0x80, 0) << "a server masks nothing";
    std::uint64_t length = static_cast<unsigned char>(head[1]) & 0x7f;
    if (length >= 126) {
      const std::string bytes = take(length == 126 ? 2 : 8);
      length = 0;
      for (const char c : bytes) length = length << 8 | static_cast<unsigned char>(c);
    }
    return {head[0] & 0x0f, take(static_cast<std::size_t>(length))};
  }
  /// "" if no text has `needle`.
  std::string next_text(std::string_view needle) const {
    for (Received got = next(); got.opcode >= 0 && got.opcode != 8; got = next()) {
      if (got.opcode == 1 && got.bytes.find(needle) != std::string::npos) return got.bytes;
    }
    return "";
  }

 private:
  /// Fewer than `size` bytes if the peer is gone.
  std::string take(std::size_t size) const {
    std::string bytes(size, '\0');
    std::size_t have = 0;
    while (have < size) {
      const ssize_t count = ::recv(socket_, bytes.data() + have, size - have, 0);
      if (count <= 0) break;
      have += static_cast<std::size_t>(count);
    }
    bytes.resize(have);
    return bytes;
  }

  int socket_;
};

struct Data {
  std::uint32_t subscription = 0;
  std::uint64_t time_ns = 0;
  std::string bytes;
};

/// Data of opcode 1; empty for others.
inline std::optional<Data> data_of(const Received& got) {
  if (got.opcode != 2 || got.bytes.size() < 13 || got.bytes[0] != 1) return {};
  Data data;
  std::memcpy(&data.subscription, got.bytes.data() + 1, 4);
  std::memcpy(&data.time_ns, got.bytes.data() + 5, 8);
  data.bytes = got.bytes.substr(13);
  return data;
}

/// Empty if the stream ended.
inline std::optional<Data> next_data(const Viewer& viewer) {
  for (Received got = viewer.next(); got.opcode >= 0; got = viewer.next()) {
    if (auto data = data_of(got)) return data;
  }
  return {};
}

}  // namespace verp::live::test
