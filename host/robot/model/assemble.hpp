#pragma once
#include <sdf/Model.hh>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/urdf_prepare.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Makes an Entity from a model read by libsdformat and its facts. Lumps fixed joints, transforms
/// all frames to the body's axes at the zero pose, assigns servos to joints and finds the limbs.
/// `names`: the import's renamings. Throws LoadError.
Entity assemble(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                const UrdfNames& names);

}  // namespace verp::model
