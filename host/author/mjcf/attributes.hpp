#pragma once
#include <string>
#include <vector>

#include "host/robot/model/xml_source.hpp"

namespace verp::mjcf {

/// Attributes of a part of a body that MuJoCo has in none of them: misspelled ones.
std::vector<std::string> unknown_attributes(const model::XmlElement& part);

}  // namespace verp::mjcf
