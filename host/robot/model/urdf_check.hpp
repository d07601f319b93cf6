#pragma once
#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// What a URDF file holds, by urdfdom's reading; libsdformat must end up with the same.
struct UrdfTotals {
  int moving_joints = 0;
  double mass_kg = 0;
};

/// Throws LoadError for what libsdformat's import would lose without a word, unless <verp:drop> or
/// <verp:fix> declares it: shapes without mass. What urdfdom cannot read is refused with its cause,
/// where the link or joint it names stands in `source`.
UrdfTotals check_urdf(const XmlSource& source, const XmlElement& robot, const Facts& facts);

}  // namespace verp::model
