#pragma once
#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/link_tree.hpp"
#include "host/robot/model/xml_source.hpp"

/// What is to be said of a robot's sensors beside what SDF has words for.
namespace verp::model {

/// Of <verp:truth> and <verp:latency>. Throws LoadError.
void add_truths_and_latencies(const Facts& facts, const LinkTree& tree, Entity& entity);

/// Each sensor that is recorded has a channel of its own in a trace. Throws LoadError.
void check_channels(const XmlSource& source, const Facts& facts, const Entity& entity);

}  // namespace verp::model
