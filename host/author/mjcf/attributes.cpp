#include "host/author/mjcf/attributes.hpp"

#include <string_view>

namespace verp::mjcf {
namespace {

constexpr std::string_view kParts = " body frame geom joint freejoint inertial site ";

/// All attributes that MuJoCo 3 has for one of these elements or more.
constexpr std::string_view kAttributes =
    " name class childclass user group align pos quat axisangle xyaxes zaxis euler mocap gravcomp "
    "sleep type contype conaffinity condim priority size material friction mass density "
    "shellinertia solmix solref solimp margin gap fromto hfield mesh fitscale rgba fluidshape "
    "fluidcoef axis springdamper solreflimit solimplimit solreffriction solimpfriction stiffness "
    "range limited actuatorfrcrange actuatorfrclimited actuatorgravcomp ref springref armature "
    "damping frictionloss diaginertia fullinertia ";

bool has_word(std::string_view words, const std::string& word) {
  return words.find(" " + word + " ") != std::string_view::npos;
}

}  // namespace

std::vector<std::string> unknown_attributes(const model::XmlElement& part) {
  std::vector<std::string> found;
  if (!has_word(kParts, part.name())) return found;
  for (const auto* a = part.raw().FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string name = a->Name();
    if (!has_word(kAttributes, name) && name.find(':') == name.npos) found.push_back(name);
  }
  return found;
}

}  // namespace verp::mjcf
