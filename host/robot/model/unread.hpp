#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/robot/model/xml_source.hpp"

/// What a robot's file says and nobody here reads, or what was guessed for it.
namespace verp::model {

/// Names of parts, by what is lost with them: {"<kinematic> of links", {"trunk"}}.
using Lost = std::map<std::string, std::vector<std::string>>;

/// Below a <model> of SDF or a <robot> of URDF, by one table of the elements that are read. Values
/// that change nothing, such as <kinematic>0, are left out.
void find_unread(const XmlElement& top, Lost& lost);

/// Adds one element, unless it changes nothing.
void tell_unread(const XmlElement& parent, const XmlElement& child, Lost& lost);

inline constexpr const char* kMissingMeshes = "meshes that are not there";
void find_missing_meshes(const Entity& robot, Lost& lost);

/// One line for each thing that is lost, with the names once.
std::vector<std::string> lines_of(const Lost& lost);

}  // namespace verp::model
