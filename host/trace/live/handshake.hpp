#pragma once
#include <span>
#include <string>
#include <string_view>

namespace verp::live {

/// What an HTTP request for a WebSocket is answered.
struct HandshakeAnswer {
  bool accepted = false;
  std::string text;
};

/// Whether a request's head is whole: up to and with its empty line. npos: not yet.
std::size_t head_length(std::string_view bytes);

/// To a whole head (RFC 6455, section 4.2). Total: any bytes get an answer. Accepted is who knows
/// one of Foxglove's protocols and is no page of a stranger; others are told in words what this
/// port is. `origins`: pages that are welcome besides those that always are.
HandshakeAnswer answer_handshake(std::string_view head, std::span<const std::string> origins = {});

/// Whether a page of that origin ("https://app.foxglove.dev") is welcome: of this PC, of Foxglove,
/// or one of `more`. A browser tells of whom a page is; whatever page somebody has open could else
/// read the robot's stream. What is no page (a program with windows) tells none, or its own scheme.
bool is_welcome(std::string_view origin, std::span<const std::string> more);

}  // namespace verp::live
