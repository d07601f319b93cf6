#pragma once
#include <sdf/sdf.hh>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/link_tree.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// All sensors, after the nodes: SDF's, and <verp:imu>, <verp:feet>, <verp:truth> and
/// <verp:latency>. Throws LoadError.
void assemble_sensors(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                      const LinkTree& tree, Entity& entity);

}  // namespace verp::model
