#pragma once
#include <sdf/Model.hh>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/urdf_prepare.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Entity from libsdformat's model and the facts. Lumps fixed joints, transforms frames to the
/// body's axes at the zero pose, assigns servos and finds limbs. `names`: import's renamings.
/// Throws LoadError.
Entity assemble(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                const UrdfNames& names);

}  // namespace verp::model
