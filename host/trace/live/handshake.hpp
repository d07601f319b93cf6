#pragma once
#include <span>
#include <string>
#include <string_view>

namespace verp::live {

/// The answer to a request for a WebSocket.
struct HandshakeAnswer {
  bool accepted = false;
  std::string text;
};

/// Length with the empty line; npos: incomplete.
std::size_t head_length(std::string_view bytes);

/// A complete head (RFC 6455, section 4.2). Total: any bytes get an answer. Accepts clients with a
/// Foxglove protocol and an Origin that passes is_welcome(); a refusal explains this port.
HandshakeAnswer answer_handshake(std::string_view head, std::span<const std::string> origins = {});

/// May a page of that origin ("https://app.foxglove.dev") connect? This PC's, Foxglove's and those
/// in `more` may; others could read the stream from any web page open on this PC. Desktop programs
/// send no origin or their own scheme.
bool is_welcome(std::string_view origin, std::span<const std::string> more);

}  // namespace verp::live
