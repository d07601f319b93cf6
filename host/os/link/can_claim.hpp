#pragma once
#include <string>

#include "host/os/link/port.hpp"

namespace verp::link {

/// Claims a role on a CAN interface for one program of this PC. Two masters, or two copies of the
/// same nodes, would take each other's frames for their own. The claim ends with this object or
/// with the program, however that ends.
class CanClaim {
 public:
  /// Description of the role "watcher": only it may request State from the controller's node.
  static constexpr const char* kWatcher = "`verp shadow`, or `verp hil` without --operator,";

  /// Throws LinkError (kBusy) if another program has the role. `who` describes the role in the
  /// message ("`verp run`").
  CanClaim(const std::string& interface, const std::string& part, const std::string& who);

 private:
  Descriptor socket_;
};

}  // namespace verp::link
