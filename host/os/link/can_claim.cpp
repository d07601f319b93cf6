#include "host/os/link/can_claim.hpp"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

#include "host/os/link/link_error.hpp"

namespace verp::link {

// An abstract socket's name is free when the socket closes; like the interface, it belongs to a
// network namespace.
CanClaim::CanClaim(const std::string& interface, const std::string& part, const std::string& who)
    : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const std::string name = "verp/can/" + interface + "/" + part;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t size = std::min(name.size(), sizeof address.sun_path - 1);
  std::copy_n(name.begin(), size, address.sun_path + 1);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + size);
  if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), length) == 0) return;
  if (errno != EADDRINUSE) return;  // a system without such names has no guard
  throw LinkError(LinkError::Kind::kBusy,
                  "can:" + interface + ": another " + who + " has this interface; end it first");
}

}  // namespace verp::link
