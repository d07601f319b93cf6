#include "host/study/identify/write.hpp"

#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "host/author/edit/change.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::identify {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

Attributes attributes_of(const Result& result, const std::string& source) {
  const model::Servo& servo = result.servo;
  const auto number = [](double value) { return fmt::format("{:.5g}", value); };
  return {{"stall_torque_n_m", number(servo.stall_torque_n_m)},
          {"no_load_rev_min", number(servo.no_load_speed_rad_s * 30 / std::numbers::pi)},
          {"stall_current_a", number(servo.stall_current_a)},
          {"armature_kg_m2", number(servo.gearbox.armature_kg_m2)},
          {"f_base_n_m", number(servo.gearbox.f_base_n_m)},
          {"f_strib_n_m", number(servo.gearbox.f_strib_n_m)},
          {"l_base", number(servo.gearbox.l_base)},
          {"l_strib", number(servo.gearbox.l_strib)},
          {"goal_delay_us", fmt::format("{:.0f}", servo.goal_delay_s * 1e6)},
          {"source", source}};
}

/// Elements with that name and attribute value, in text order.
std::vector<int> elements(const edit::Document& document, const char* name, const char* attribute,
                          const std::string& value) {
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(document.markup().elements().size()); ++i) {
    const edit::Element& each = document.markup()[i];
    if (each.name == name && document.attribute(i, attribute) == value) found.push_back(i);
  }
  return found;
}

void set(edit::Document& document, int element, const std::string& name, const std::string& value) {
  document.apply(edit::set(document, document.path(element) + "@" + name, value));
}

}  // namespace

std::string write(const Result& result, const std::filesystem::path& robot_file,
                  const std::filesystem::path& file, const std::string& source) {
  edit::Document document(file, edit::Document::open(robot_file).text());
  const Attributes attributes = attributes_of(result, source);
  const std::vector<int> own = elements(document, "verp:servo_type", "name", result.type);
  const bool shipped = own.empty();
  const std::string type = shipped ? result.type + "_identified" : result.type;
  if (!shipped && document.markup()[own.front()].attribute("kt_n_m_a") != nullptr) {
    throw model::LoadError(
        robot_file.string(), document.markup()[own.front()].line,
        "its motor is given by kt_n_m_a and resistance_ohm, which are one number "
        "less than were found",
        "give it by stall_torque_n_m and no_load_rev_min");
  }
  for (const int each : elements(document, "verp:servo", "type", result.type)) {
    set(document, each, "backlash_rad", fmt::format("{:.4g}", result.servo.backlash_rad));
    if (shipped) set(document, each, "type", type);
  }
  if (shipped) {
    std::string block = fmt::format(R"(<verp:servo_type name="{}" like="{}")", type, result.type);
    for (const auto& [name, value] : attributes)
      block += fmt::format(R"( {}="{}")", name, edit::escaped(value));
    document.apply(edit::insert(document, document.model(), block + "/>"));
  } else {
    for (const auto& [name, value] : attributes) {
      set(document, elements(document, "verp:servo_type", "name", type).front(), name, value);
    }
  }
  document.save();
  return type;
}

}  // namespace verp::identify
