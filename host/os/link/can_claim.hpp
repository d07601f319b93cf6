#pragma once
#include <string>

#include "host/os/link/port.hpp"

namespace verp::link {

/// A role on a CAN interface, for one program of this PC. Two masters, or two copies of nodes,
/// would take each other's frames for their own. It ends with this object or the program.
class CanClaim {
 public:
  /// Only the watcher may request State from the controller's node.
  static constexpr const char* kWatcher = "`verp shadow`, or `verp hil` without --operator,";

  /// Throws LinkError (kBusy) if the role is taken. `who`: the role in the message ("`verp run`").
  CanClaim(const std::string& interface, const std::string& part, const std::string& who);

 private:
  Descriptor socket_;
};

}  // namespace verp::link
