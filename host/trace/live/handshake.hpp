#pragma once
#include <span>
#include <string>
#include <string_view>

namespace verp::live {

/// The answer to an HTTP request for a WebSocket.
struct HandshakeAnswer {
  bool accepted = false;
  std::string text;
};

/// Length of a request's head, with its empty line; npos: incomplete.
std::size_t head_length(std::string_view bytes);

/// Answers a complete head (RFC 6455, section 4.2). Total: any bytes get an answer. Accepts clients
/// that speak a Foxglove protocol and whose Origin passes is_welcome(); a refusal explains what
/// this port is. `origins`: further allowed Origins.
HandshakeAnswer answer_handshake(std::string_view head, std::span<const std::string> origins = {});

/// Whether a page of that origin ("https://app.foxglove.dev") may connect: one of this PC, of
/// Foxglove, or in `more`. Otherwise any web page open on this PC could read the robot's stream.
/// Desktop programs send no origin or their own scheme, and may connect.
bool is_welcome(std::string_view origin, std::span<const std::string> more);

}  // namespace verp::live
