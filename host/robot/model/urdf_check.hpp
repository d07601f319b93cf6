#pragma once
#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Contents of a URDF file according to urdfdom; libsdformat must get the same.
struct UrdfTotals {
  int moving_joints = 0;
  double mass_kg = 0;
};

/// Throws LoadError for what libsdformat's import would lose silently, unless <verp:drop> or
/// <verp:fix> declares it: shapes without mass. Reports urdfdom's errors with the cause, where the
/// link or joint that it names is in `source`.
UrdfTotals check_urdf(const XmlSource& source, const XmlElement& robot, const Facts& facts);

}  // namespace verp::model
