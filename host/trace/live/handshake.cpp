#include "host/trace/live/handshake.hpp"

#include <fmt/format.h>
#include <sha1.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

#include "host/os/files/base64.hpp"

namespace verp::live {
namespace {

constexpr std::string_view kEnd = "\r\n\r\n";
// Equal messages; Foxglove's newer libraries use the second name.
constexpr std::array<std::string_view, 2> kProtocols = {"foxglove.websocket.v1", "foxglove.sdk.v1"};
constexpr std::string_view kServerKey = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";  // RFC 6455, 1.3

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; end != text.npos;) {
    end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end != text.npos) text.remove_prefix(end + separator.size());
  }
  return parts;
}

/// A header's values in lower case; lists are split at commas.
std::vector<std::string_view> values(std::string_view head, std::string_view name) {
  std::vector<std::string_view> found;
  for (const std::string_view line : split(head, "\r\n")) {
    const std::size_t colon = line.find(':');
    if (colon == line.npos || lower(line.substr(0, colon)) != name) continue;
    for (const std::string_view value : split(line.substr(colon + 1), ",")) found.push_back(value);
  }
  return found;
}

bool has(std::string_view head, std::string_view name, std::string_view value) {
  const auto all = values(head, name);
  return std::any_of(all.begin(), all.end(), [&](const auto& v) { return lower(v) == value; });
}

std::optional<std::string_view> protocol_of(std::string_view head) {
  const auto offered = values(head, "sec-websocket-protocol");
  for (const std::string_view known : kProtocols) {
    if (std::find(offered.begin(), offered.end(), known) != offered.end()) return known;
  }
  return {};
}

HandshakeAnswer refuse(std::string_view status, std::string_view why) {
  return {.accepted = false,
          .text = fmt::format("HTTP/1.1 {}\r\nSec-WebSocket-Version: 13\r\nUpgrade: websocket\r\n"
                              "Content-Type: text/plain\r\nContent-Length: {}\r\n"
                              "Connection: close\r\n\r\n{}\n",
                              status, why.size() + 1, why)};
}

std::string accept_key(std::string_view key) {
  const std::string text = std::string(key) + std::string(kServerKey);
  SHA1_CTX context;
  ::SHA1Init(&context);
  ::SHA1Update(&context, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  std::array<std::uint8_t, SHA1_DIGEST_LENGTH> digest{};
  ::SHA1Final(digest.data(), &context);
  return files::base64({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

/// The host of "http://host:port"; empty: no web page.
std::string_view web_host(std::string_view origin) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view host = origin.substr(scheme.size());
    // An IPv6 address has colons within brackets.
    const std::string_view name = host.starts_with("[::1]:") || host == "[::1]"
                                      ? host.substr(0, 5)
                                      : host.substr(0, host.rfind(':'));
    return name.empty() ? "nameless" : name;
  }
  return {};
}

}  // namespace

bool is_welcome(std::string_view origin, std::span<const std::string> more) {
  const std::string told = lower(origin);
  // Any page can get the origin "null" by a sandboxed frame.
  if (told == "null") return false;
  const std::string_view host = web_host(told);
  if (host.empty() || host == "localhost" || host == "127.0.0.1" || host == "[::1]") return true;
  if (told == "https://app.foxglove.dev") return true;
  return std::any_of(more.begin(), more.end(),
                     [&](const std::string& each) { return lower(each) == told; });
}

std::size_t head_length(std::string_view bytes) {
  const std::size_t end = bytes.find(kEnd);
  return end == bytes.npos ? bytes.npos : end + kEnd.size();
}

HandshakeAnswer answer_handshake(std::string_view head, std::span<const std::string> origins) {
  const std::string_view line = head.substr(0, head.find("\r\n"));
  if (!line.starts_with("GET ") || !line.ends_with(" HTTP/1.1"))
    return refuse("400 Bad Request", "This port takes WebSocket connections only.");
  const auto key = values(head, "sec-websocket-key");
  if (!has(head, "upgrade", "websocket") || !has(head, "connection", "upgrade") ||
      !has(head, "sec-websocket-version", "13") || key.size() != 1 || key[0].size() != 24) {
    return refuse("426 Upgrade Required",
                  "A robot's live stream (WebSocket, foxglove.websocket.v1): open this address as "
                  "a Foxglove WebSocket connection in Foxglove, Lichtblick or PlotJuggler.");
  }
  for (const std::string_view origin : values(head, "origin")) {
    if (is_welcome(origin, origins)) continue;
    return refuse("403 Forbidden",
                  "A page of another site may not see this robot. If it is your viewer's: start "
                  "the stream with --live-origin and the page's https://HOST.");
  }
  const auto protocol = protocol_of(head);
  if (!protocol) {
    return refuse("400 Bad Request",
                  "No protocol in common: this server speaks foxglove.websocket.v1.");
  }
  return {.accepted = true,
          .text = fmt::format("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\n"
                              "Connection: Upgrade\r\nSec-WebSocket-Accept: {}\r\n"
                              "Sec-WebSocket-Protocol: {}\r\n\r\n",
                              accept_key(key[0]), *protocol)};
}

}  // namespace verp::live
