#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

namespace verp::link {

/// Where a link goes, as users write it:
///
///     serial:/dev/ttyUSB0@2000000   a serial port and its rate in baud (2000000 if none is given)
///     pty:  pty:PATH                makes a pseudo-terminal; PATH becomes a symbolic link to it
///     tcp:HOST:PORT                 connects; HOST is a name, an IPv4 address or [an IPv6 address]
///     tcp-listen:PORT               waits for one peer of this PC; PORT 0 takes a free one
///     tcp-listen:HOST:PORT,token=FILE
///                                   ... on an address of the network: a peer first says the secret
///                                   in FILE, as tcp:HOST:PORT,token=FILE does
///     unix:PATH  unix-listen:PATH   a socket in the file system
///     can:can0                      a CAN interface of this PC, as `ip link` names it
struct Endpoint {
  enum class Kind : std::uint8_t { kSerial, kPty, kTcp, kTcpListen, kUnix, kUnixListen, kCan };
  Kind kind = Kind::kPty;
  std::string place;            ///< device, host, path, interface; pty: may be empty
  std::uint32_t baud = 0;       ///< kSerial
  std::uint16_t port = 0;       ///< kTcp, kTcpListen
  std::string token_file = {};  ///< kTcp, kTcpListen; may be empty
  bool operator==(const Endpoint&) const = default;
};

inline constexpr std::uint32_t kDefaultBaud = 2'000'000;

/// Exit status 2. what() is one line with the correct form.
class EndpointError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

Endpoint parse_endpoint(const std::string& text);

/// parse_endpoint() makes an equal endpoint from this text.
std::string to_text(const Endpoint& endpoint);

}  // namespace verp::link
