#include "host/os/link/endpoint.hpp"

#include <net/if.h>
#include <sys/un.h>

#include <array>
#include <charconv>
#include <optional>
#include <string_view>

namespace verp::link {
namespace {

struct Scheme {
  const char* name;
  Endpoint::Kind kind;
  const char* example;
};
constexpr std::array<Scheme, 7> kSchemes = {{
    {"serial", Endpoint::Kind::kSerial, "serial:/dev/ttyUSB0@2000000"},
    {"pty", Endpoint::Kind::kPty, "pty: or pty:/tmp/robot"},
    {"tcp", Endpoint::Kind::kTcp, "tcp:localhost:6000"},
    {"tcp-listen", Endpoint::Kind::kTcpListen, "tcp-listen:6000"},
    {"unix", Endpoint::Kind::kUnix, "unix:/tmp/robot.sock"},
    {"unix-listen", Endpoint::Kind::kUnixListen, "unix-listen:/tmp/robot.sock"},
    {"can", Endpoint::Kind::kCan, "can:can0"},
}};
constexpr std::uint32_t kLeastBaud = 1200;
constexpr std::uint32_t kMostBaud = 12'000'000;  // USB 2.0 full speed, FT232H
constexpr const char* kLocalHost = "127.0.0.1";

const Scheme& scheme_of(Endpoint::Kind kind) {
  for (const Scheme& scheme : kSchemes) {
    if (scheme.kind == kind) return scheme;
  }
  return kSchemes[0];
}

[[noreturn]] void refuse(const std::string& text, const std::string& why, const Scheme& scheme) {
  throw EndpointError("link '" + text + "': " + why + "; write for example " + scheme.example);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& each : lower) {
    if (each >= 'A' && each <= 'Z') each = static_cast<char>(each - 'A' + 'a');
  }
  return lower;
}

/// All of `digits` as a number up to `most`.
std::optional<std::uint32_t> number(std::string_view digits, std::uint32_t most) {
  std::uint32_t value = 0;
  const char* end = digits.data() + digits.size();
  const auto [last, error] = std::from_chars(digits.data(), end, value);
  if (digits.empty() || error != std::errc{} || last != end || value > most) return std::nullopt;
  return value;
}

Endpoint serial(const std::string& text, std::string_view rest, const Scheme& scheme) {
  Endpoint endpoint{.kind = scheme.kind, .place = std::string(rest), .baud = kDefaultBaud};
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    const auto baud = number(rest.substr(at + 1), kMostBaud);
    if (!baud || *baud < kLeastBaud) {
      refuse(text, "the rate after '@' must be from 1200 to 12000000 baud", scheme);
    }
    endpoint.baud = *baud;
    endpoint.place = std::string(rest.substr(0, at));
  }
  if (endpoint.place.empty()) refuse(text, "it names no device", scheme);
  if (endpoint.place[0] != '/') refuse(text, "a device is a path that begins with '/'", scheme);
  return endpoint;
}

Endpoint tcp(const std::string& text, std::string_view rest, const Scheme& scheme) {
  constexpr std::string_view kToken = ",token=";
  Endpoint endpoint{.kind = scheme.kind, .place = kLocalHost};
  if (const std::size_t at = rest.find(kToken); at != std::string_view::npos) {
    endpoint.token_file = std::string(rest.substr(at + kToken.size()));
    if (endpoint.token_file.empty()) refuse(text, "it names no file after token=", scheme);
    rest = rest.substr(0, at);
  }
  const std::size_t colon = rest.rfind(':');
  if (colon != std::string_view::npos) {
    std::string_view host = rest.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
      host = host.substr(1, host.size() - 2);
    } else if (host.find_first_of(":[]") != std::string_view::npos) {
      refuse(text, "an IPv6 address stands in brackets, as [::1]", scheme);
    }
    if (host.empty()) refuse(text, "it names no host", scheme);
    endpoint.place = std::string(host);
  } else if (scheme.kind == Endpoint::Kind::kTcp) {
    refuse(text, "it needs a host and a port", scheme);
  }
  const auto port = number(rest.substr(colon == std::string_view::npos ? 0 : colon + 1), 65535);
  if (!port || (*port == 0 && scheme.kind == Endpoint::Kind::kTcp)) {
    refuse(text, "the port must be a number from 1 to 65535", scheme);
  }
  endpoint.port = static_cast<std::uint16_t>(*port);
  return endpoint;
}

Endpoint unix_socket(const std::string& text, std::string_view rest, const Scheme& scheme) {
  if (rest.empty()) refuse(text, "it names no path", scheme);
  if (rest.size() >= sizeof(sockaddr_un::sun_path)) {
    refuse(text, "a socket's path has at most 107 characters", scheme);
  }
  return {.kind = scheme.kind, .place = std::string(rest)};
}

Endpoint can(const std::string& text, std::string_view rest, const Scheme& scheme) {
  if (rest.empty()) refuse(text, "it names no interface", scheme);
  if (rest.find('@') != std::string_view::npos) {
    refuse(text, "its bit rate is the interface's (ip link set ... type can bitrate)", scheme);
  }
  if (rest[0] == '/') {
    refuse(text,
           "it is a path; a serial CAN adapter becomes an interface with: sudo slcand -o -s8 " +
               std::string(rest) + " can0 && sudo ip link set can0 up",
           scheme);
  }
  if (rest.size() >= IFNAMSIZ) refuse(text, "an interface has at most 15 characters", scheme);
  if (rest.find_first_of("/: \t\n") != std::string_view::npos) {
    refuse(text, "ip link has no such names", scheme);
  }
  return {.kind = scheme.kind, .place = std::string(rest)};
}

}  // namespace

Endpoint parse_endpoint(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = std::string_view(text).substr(0, colon);
  for (const Scheme& scheme : kSchemes) {
    if (colon == std::string::npos || name != scheme.name) continue;
    const std::string_view rest = std::string_view(text).substr(colon + 1);
    if (rest.find('\0') != std::string_view::npos) refuse(text, "a path has no zero byte", scheme);
    switch (scheme.kind) {
      case Endpoint::Kind::kSerial:
        return serial(text, rest, scheme);
      case Endpoint::Kind::kPty:
        return {.kind = Endpoint::Kind::kPty, .place = std::string(rest)};
      case Endpoint::Kind::kTcp:
      case Endpoint::Kind::kTcpListen:
        return tcp(text, rest, scheme);
      case Endpoint::Kind::kUnix:
      case Endpoint::Kind::kUnixListen:
        return unix_socket(text, rest, scheme);
      case Endpoint::Kind::kCan:
        return can(text, rest, scheme);
    }
  }
  if (text.starts_with("/dev/")) {
    throw EndpointError("link '" + text + "': say what it is; write serial:" + text + "@2000000");
  }
  const std::string kind = lower_case(name);
  std::string remedy = std::string("write for example ") + kSchemes[0].example;
  for (const Scheme& scheme : kSchemes) {
    if (colon != std::string::npos && kind == scheme.name) {
      remedy = "in small letters: write " + kind + text.substr(colon);
    }
  }
  throw EndpointError("link '" + text +
                      "': it begins with none of serial: pty: tcp: tcp-listen: unix: unix-listen: "
                      "can:; " +
                      remedy);
}

std::string to_text(const Endpoint& endpoint) {
  const std::string head = std::string(scheme_of(endpoint.kind).name) + ":";
  const bool bracket = endpoint.place.find(':') != std::string::npos;
  switch (endpoint.kind) {
    case Endpoint::Kind::kSerial:
      return head + endpoint.place + "@" + std::to_string(endpoint.baud);
    case Endpoint::Kind::kTcp:
    case Endpoint::Kind::kTcpListen:
      return head + (bracket ? "[" + endpoint.place + "]" : endpoint.place) + ":" +
             std::to_string(endpoint.port) +
             (endpoint.token_file.empty() ? "" : ",token=" + endpoint.token_file);
    case Endpoint::Kind::kPty:
    case Endpoint::Kind::kUnix:
    case Endpoint::Kind::kUnixListen:
    case Endpoint::Kind::kCan:
      break;
  }
  return head + endpoint.place;
}

}  // namespace verp::link
