#include "host/apps/libverp/robot_file.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <sstream>

#include "common/model/tuning_ranges.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/number.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/scenario/expand.hpp"

namespace verp::abi {
namespace {

/// Parses "gait.lift_m=0.012 balance.zeros_enable=0".
std::map<std::string, double> tuning_of(const std::string& text) {
  std::map<std::string, double> tuning;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const int id = tuning_id_of(name);
    const auto value =
        model::parse_number(equals == std::string::npos ? "" : word.substr(equals + 1));
    if (!value) {
      throw Failure(VERP_BAD_ARGUMENT,
                    fmt::format("tuning '{}' is not NAME=VALUE, such as gait.lift_m=0.012", word));
    }
    tuning[name] = static_cast<double>(tuning_value_for(id, name, *value));
  }
  return tuning;
}

}  // namespace

int tuning_id_of(const std::string& name) {
  if (const auto id = model::tuning_id(name)) return *id;
  throw Failure(
      VERP_BAD_ARGUMENT,
      fmt::format("the tuning has no number '{}'; `verp parameters` lists those it has", name));
}

float tuning_value_for(int id, const std::string& name, double value) {
  // Ranges are float32: 0.03 is inside one that ends at 0.03F.
  const auto number = static_cast<float>(value);
  if (in_range(id, number)) return number;
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("{} may be {} to {}, not {}", name, kTuningRanges[id].low,
                            kTuningRanges[id].high, value));
}

scenario::Robot robot_of(const char* model, const char* bus, const char* tuning) {
  need_text(model, "model");
  need_text_or_null(bus, "bus");
  scenario::Robot robot;
  robot.model = model;
  if (bus != nullptr) robot.bus = bus;
  if (tuning != nullptr) robot.tuning = tuning_of(tuning);
  return robot;
}

model::Entity load(const scenario::Robot& robot) {
  static std::mutex one_at_a_time;  // libsdformat has global settings
  const std::lock_guard lock(one_at_a_time);
  return model::load_robot(model::find_model(robot.model), robot.bus);
}

Loaded load(const char* model, const char* bus, const char* tuning) {
  const scenario::Robot robot = robot_of(model, bus, tuning);
  Loaded loaded{load(robot), {}};
  loaded.params = model::make_params(loaded.entity);
  scenario::tune(robot.tuning, loaded.params.tuning);
  return loaded;
}

}  // namespace verp::abi
