#pragma once
#include <sdf/Model.hh>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/urdf_prepare.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Turns a model that libsdformat has read, and the facts beside it, into an Entity: lumps fixed
/// joints, brings all frames to the body's axes at the zero pose, joins servos to joints, finds the
/// limbs. `names`: what its import changed. Throws LoadError.
Entity assemble(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                const UrdfNames& names);

}  // namespace verp::model
