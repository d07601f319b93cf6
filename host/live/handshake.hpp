#pragma once
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
/// one of Foxglove's protocols; others are told in words what this port is.
HandshakeAnswer answer_handshake(std::string_view head);

}  // namespace verp::live
