#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "common/model/leg.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/scenario/field_bugs.hpp"

namespace verp::scenario {
namespace {

std::string filled(std::string text, const model::Entity& entity) {
  const Params params = model::make_params(entity);
  const int knee = params.leg[0].joint[3], foot = verp::model::last_joint(params.leg[0]) + 1;
  const auto node = [&](int index) { return entity.nodes[static_cast<std::size_t>(index)].name; };
  const std::pair<std::string, std::string> all[] = {{"{trunk}", node(0)},
                                                     {"{knee}", params.joint[knee].name},
                                                     {"{thigh}", node(params.joint[knee].parent)},
                                                     {"{foot}", node(foot)}};
  for (const auto& [key, value] : all) {
    const std::size_t found = text.find(key);
    if (found != std::string::npos) text.replace(found, key.size(), value);
  }
  return text;
}

/// "*F": each number times F.
std::string changed(const std::string& old, const std::string& value) {
  if (value[0] != '*') return value;
  std::istringstream numbers(old);
  std::string out;
  for (double number = 0; numbers >> number;)
    out += fmt::format("{}{:g}", out.empty() ? "" : " ", number * std::stod(value.substr(1)));
  return out;
}

}  // namespace

const FieldBug& field_bug(const std::string& name) {
  std::vector<std::string> names;
  for (const FieldBug& bug : field_bugs()) {
    if (bug.name == name) return bug;
    names.emplace_back(bug.name);
  }
  throw ScenarioError("fault", fmt::format("there is no field bug '{}'", name), names);
}

std::string how(const FieldBug& bug, const model::Entity& entity) {
  const Injection& in = bug.injection;
  if (in.change != nullptr) return in.text;
  if (!bug.in_file()) return fmt::format("--at '{:g}: {}'", kBegins_s, filled(in.text, entity));
  const std::string place = filled(in.text, entity) + " ... " + filled(in.tag, entity);
  return fmt::format("file: {}{}", place,
                     in.value[0] == '*' ? fmt::format(" times {}", in.value + 1) : in.value);
}

Params params_of(const FieldBug& bug, const model::Entity& entity) {
  if (!bug.in_file()) return model::make_params(entity);
  const std::string part = filled(bug.injection.text, entity);
  const std::string tag = filled(bug.injection.tag, entity);
  std::string text = files::read(entity.file).value_or("");
  const std::size_t begin = text.find(part), found = text.find(tag, begin);
  if (begin == std::string::npos || found == std::string::npos) {
    throw ScenarioError("fault",
                        fmt::format("this bug changes {} ... {} in the robot's file, and {} has no "
                                    "such place",
                                    part, tag, entity.file));
  }
  const std::size_t from = found + tag.size(), size = text.find_first_of("<\"", from) - from;
  text.replace(from, size, changed(text.substr(from, size), bug.injection.value));
  return model::make_params(model::load_robot_text(entity.file, text));
}

void inject(const FieldBug& bug, session::WalkPlan& plan) {
  const Injection& in = bug.injection;
  if (in.change != nullptr) return in.change(plan);
  if (bug.in_file()) return;
  const std::string setting = fmt::format("{:g}: {}", kBegins_s, filled(in.text, plan.entity));
  plan.interventions.push_back(session::read_setting(setting));
}

}  // namespace verp::scenario
