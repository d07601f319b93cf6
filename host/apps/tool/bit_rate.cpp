#include "host/apps/tool/bit_rate.hpp"

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {

void check_bit_rate(const std::string& command, const wire::CanInterface& interface,
                    const Params& params) {
  const std::string known = wire::advice(interface);
  if (!known.empty()) complain(command + ": " + known);
  const std::string trouble = wire::bit_rate_trouble(interface, params.name, params.baud);
  if (!trouble.empty()) throw ToolError(kBadInput, command + ": " + trouble);
}

}  // namespace verp::tool
