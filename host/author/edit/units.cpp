#include "host/author/edit/units.hpp"

#include <string_view>

namespace verp::edit {
namespace {

struct UnitRow {
  const char *name, *unit;
};

constexpr UnitRow kUnitNamed[] = {{"mass", "kg"},
                                  {"mass@value", "kg"},
                                  {"pose", "m, rad"},
                                  {"origin@xyz", "m"},
                                  {"rpy", "rad"},
                                  {"size", "m"},
                                  {"radius", "m"},
                                  {"length", "m"},
                                  {"lower", "rad"},
                                  {"upper", "rad"},
                                  {"velocity", "rad/s"},
                                  {"effort", "N m"},
                                  {"damping", "N m s/rad"},
                                  {"kp", "N/m"},
                                  {"kd", "N s/m"},
                                  {"update_rate", "Hz"},
                                  {"horizontal_fov", "rad"},
                                  {"baud", "bit/s"},
                                  {"centre", "m"},
                                  {"com", "m"},
                                  {"rad", "rad"},
                                  {"near", "m"},
                                  {"far", "m"},
                                  {"min_angle", "rad"},
                                  {"max_angle", "rad"},
                                  {"newton_per_count", "N"}};

constexpr UnitRow kEndings[] = {
    {"_rad_s", "rad/s"}, {"_kg_m2", "kg m²"},   {"_n_m_s", "N m s"}, {"_n_m_a", "N m/A"},
    {"_n_s_m", "N s/m"}, {"_rev_min", "1/min"}, {"_n_m", "N m"},     {"_us", "µs"},
    {"_ms", "ms"},       {"_percent", "%"},     {"_deg", "°"},       {"_ohm", "Ω"},
    {"_rad", "rad"},     {"_m", "m"},           {"_v", "V"},         {"_a", "A"}};

bool is_moment(std::string_view name) {
  return name.size() == 3 && name[0] == 'i' && name.find_first_not_of("xyz", 1) == name.npos;
}

}  // namespace

std::string unit_of(const std::string& path) {
  const std::string_view all = path;
  const std::string_view last = all.substr(all.rfind('/') + 1);  // npos + 1 is 0
  const std::string_view name = last.substr(last.rfind('@') + 1);
  if (is_moment(name)) return "kg m²";
  for (const UnitRow& row : kUnitNamed) {
    if (last == row.name || name == row.name) return row.unit;
  }
  for (const UnitRow& row : kEndings) {
    const std::string_view ending = row.name;
    if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending)
      return row.unit;
  }
  return "";
}

}  // namespace verp::edit
