#pragma once
#include <string>

#include "host/os/link/port.hpp"

namespace verp::link {

/// One part at a CAN interface that only one program of this PC may play: two masters, or two
/// copies of the same nodes, hear each other's frames as their own. It is given back when this
/// goes, or the program, however that ends.
class CanClaim {
 public:
  /// Who has the part "watcher", in words: it alone asks the controller's node for its State.
  static constexpr const char* kWatcher = "`verp shadow`, or `verp hil` without --operator,";

  /// Throws LinkError (kBusy) that says who has it, and to end that; `who` plays the part
  /// ("`verp run`").
  CanClaim(const std::string& interface, const std::string& part, const std::string& who);

 private:
  Descriptor socket_;
};

}  // namespace verp::link
