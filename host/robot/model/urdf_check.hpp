#pragma once
#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Contents of a URDF file according to urdfdom; libsdformat must get the same.
struct UrdfTotals {
  int moving_joints = 0;
  double mass_kg = 0;
};

/// Throws LoadError for losses of libsdformat's import that no <verp:drop> or <verp:fix> declares:
/// shapes without mass. `copy`: the prepared file, which urdfdom reads (urdf_prepare.hpp). Reports
/// its errors at the named link or joint in `source`.
UrdfTotals check_urdf(const XmlSource& source, const XmlElement& robot, const Facts& facts,
                      const std::string& copy);

}  // namespace verp::model
