#include "host/apps/tool/walk_load.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/study/report/maybe.hpp"

namespace verp::tool {

using report::or_dash;

std::string hardest_used(const WalkPlan& plan, const sim::WalkMetrics& metrics) {
  const auto most = std::max_element(metrics.torque_use.begin(), metrics.torque_use.end(),
                                     [](const auto& a, const auto& b) { return a.mean < b.mean; });
  if (most == metrics.torque_use.end()) return "-";
  const auto joint = static_cast<std::size_t>(most - metrics.torque_use.begin());
  return fmt::format("{}: {:.0f} % of its stall torque on average, {:.0f} % at its peak",
                     plan.entity.joints[joint].name, 100 * most->mean, 100 * most->peak);
}

std::string transport_text(const sim::WalkMetrics& metrics) {
  return fmt::format("{} from the supply, {} as work on the joints",
                     or_dash(metrics.cost_of_transport, 2, ""),
                     or_dash(metrics.cost_of_transport_mechanical, 2, ""));
}

report::Fact transport_fact(const sim::WalkMetrics& metrics) {
  return {"Cost of transport", or_dash(metrics.cost_of_transport, 2, ""),
          fmt::format("energy from the supply over weight and way; work on the joints alone: {}",
                      or_dash(metrics.cost_of_transport_mechanical, 2, ""))};
}

cli::Json load_json(const WalkPlan& plan, const sim::WalkMetrics& metrics) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? cli::Json(*value) : cli::Json();
  };
  cli::Json use = cli::Json::array();
  for (std::size_t j = 0; j < metrics.torque_use.size(); ++j) {
    use.push_back({{"joint", plan.entity.joints[j].name},
                   {"mean", metrics.torque_use[j].mean},
                   {"peak", metrics.torque_use[j].peak}});
  }
  return {{"torque_use", use},
          {"supply_energy_j", metrics.supply_energy_j},
          {"joint_work_j", metrics.joint_work_j},
          {"cost_of_transport", or_null(metrics.cost_of_transport)},
          {"cost_of_transport_mechanical", or_null(metrics.cost_of_transport_mechanical)}};
}

}  // namespace verp::tool
