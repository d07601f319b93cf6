// A viewer's end of the live stream: the handshake, frames of a WebSocket, subscriptions.
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "host/trace/live/connection.hpp"
#include "host/trace/live/handshake.hpp"
#include "host/trace/live/protocol.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace verp::fuzz {
namespace {

constexpr std::string_view kGreeting =
    "GET / HTTP/1.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n";

void talk(bool greet, Bytes& bytes) {
  int ends[2];
  require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends) == 0, "there are sockets");
  {
    live::Connection connection(ends[0], [](bool is_text, std::string_view message) {
      if (is_text) live::parse_request(message);
    });
    std::string_view next = greet ? kGreeting : bytes.take(bytes.word());
    for (int turns = 0; turns < 64 && !next.empty(); ++turns) {
      if (::send(ends[1], next.data(), next.size(), MSG_NOSIGNAL) < 0) break;
      connection.ready(POLLIN | POLLOUT);
      if (turns % 4 == 1) connection.send(false, "picture");
      if (turns == 9) connection.close(1000, "over");
      char answer[4096];
      while (::recv(ends[1], answer, sizeof answer, 0) > 0) {
      }
      next = bytes.take(1 + bytes.byte() * 4U);
    }
  }
  ::close(ends[1]);
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  if (how % 4 == 0) live::parse_request(bytes.rest());
  if (how % 4 == 1) live::answer_handshake(bytes.rest());
  if (how % 4 > 1) fuzz::talk(how % 4 == 2, bytes);
  return 0;
}
