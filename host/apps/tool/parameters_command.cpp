#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "common/model/tuning_ranges.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

/// Listed in the order of Tuning's fields (common/model/tuning.hpp).
constexpr const char* kMeaning[] = {
    "two steps",
    "share of a step during which both feet carry",
    "height of the swing sole at mid-swing",
    "from the body's midline to each foot's centre",
    "hip centre above the ankle axes while walking",
    "lean of the trunk, nose down",
    "ZMP reference in the sole, forward",
    "ZMP reference, outward from the body's midline",
    "how high the swing sole is aimed to end",
    "longest admitted step, one foot past the other",
    "largest turn per step",
    "largest change of step length from step to step",
    "from standing until the first step",
    "lag of each further joint of a limb",
    "goals are computed for this much later",
    "planned ZMP keeps this distance from the edge",
    "share of the heading error a step turns back",
    "lift grows by this for each unit of a step's haste",
    "1: gravity is fed forward; 0: not",
    "share of the rotors' inertia fed forward",
    "share of the gears' friction fed forward",
    "1: multibody ZMP correction; 0: none",
    "1: gyro and tilt feedback; 0: none",
    "1: what was learnt of the legs, zero errors and landings; 0: nothing",
    "ankle pitch per tilt",
    "ankle pitch per tilt rate",
    "ankle roll per tilt",
    "ankle roll per tilt rate",
    "hip pitch per tilt",
    "hip pitch per tilt rate",
    "hip roll per tilt",
    "hip roll per tilt rate",
    "swing ankle turned back per tilt",
    "largest correction on any joint",
    "share of what the legs turn about the vertical that the arms take; 0: arms rest",
    "tilt beyond which the robot has fallen",
    "how long that tilt must last",
    "servo or IMU silent this long: hold",
    "servo or IMU silent this long: sit, let go",
    "operator silent this long: stand",
    "operator silent this long: sit, let go",
    "from the pose at power-up to the stand",
    "from the pose held to the sitting pose",
    "supply below which the robot sits",
    "servo temperature above which the robot sits",
    "feet carry nothing this long: sit, let go; a robot that hangs needs more",
};
static_assert(std::size(kMeaning) == kTuningCount);

/// The unit is the name's end. Without unit: shares, switches, and gains in rad per rad.
std::string unit_of_number(std::string_view name) {
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"_m", "m"}, {"_rad", "rad"}, {"_s", "s"}, {"_v", "V"}, {"_c", "C"}};
  for (const auto& [end, unit] : kUnits) {
    if (name.ends_with(end)) return unit;
  }
  return "";
}

/// Prints like the float: 0.06, not 0.0599999987.
double shortest(float value) {
  return std::stod(fmt::format("{}", value));
}

struct ParametersWords {
  std::string model = "generic21", bus, word;
  bool json = false;
};

int tell(const ParametersWords& options) {
  const model::Entity entity = model::load_robot(model::find_model(options.model), options.bus);
  const Tuning tuning = model::make_params(entity).tuning;
  const std::vector<std::string> names = model::tuning_names();
  cli::Json rows = cli::Json::array();
  std::string text =
      fmt::format("{}: numbers that --set NAME=VALUE changes for one run\n", entity.name);
  text += fmt::format("  {:<29} {:>10} {:<4} {:>7} .. {:<6}  {}\n", "name", "value", "unit", "from",
                      "to", "is");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int id = static_cast<int>(i);
    const Range& range = kTuningRanges[i];
    const std::string unit = unit_of_number(names[i]);
    const float value = tuning_value(tuning, id);
    rows.push_back({{"name", names[i]},
                    {"value", shortest(value)},
                    {"unit", unit},
                    {"low", shortest(range.low)},
                    {"high", shortest(range.high)},
                    {"meaning", kMeaning[i]}});
    text += fmt::format("  {:<29} {:>10.6g} {:<4} {:>7g} .. {:<6g}  {}\n", names[i], value,
                        unit.empty() ? "-" : unit, range.low, range.high, kMeaning[i]);
  }
  cli::print_answer(options.json, {{"model", entity.name}, {"parameters", rows}},
                    text + "  The robot's own values stand in its file, as verp:tuning.\n");
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_parameters(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "parameters", "The numbers that --set changes: value, unit, range and meaning of each");
  auto options = std::make_shared<ParametersWords>();
  cli::add_model(*app, options->model)->capture_default_str();
  cli::add_json_flag(*app, options->json);
  return {app, [options] { return tell(*options); }};
}

}  // namespace verp::tool
