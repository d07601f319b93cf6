#include "host/apps/tool/bit_rate.hpp"

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {

void check_bit_rate(const std::string& command, const link::CanInterface& interface,
                    const Params& params) {
  const std::string known = link::advice(interface);
  if (!known.empty()) cli::complain(command + ": " + known);
  const std::string trouble = link::bit_rate_trouble(interface, params.name, params.baud);
  if (!trouble.empty()) throw cli::ToolError(cli::kBadInput, command + ": " + trouble);
}

}  // namespace verp::tool
