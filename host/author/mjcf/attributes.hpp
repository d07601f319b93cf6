#pragma once
#include <string>
#include <vector>

#include "host/robot/model/xml_source.hpp"

namespace verp::mjcf {

/// Attributes that MuJoCo has in no part of a body: `part` has them misspelled.
std::vector<std::string> unknown_attributes(const model::XmlElement& part);

}  // namespace verp::mjcf
