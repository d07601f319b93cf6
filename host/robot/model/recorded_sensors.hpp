#pragma once
#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/link_tree.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// <verp:truth> and <verp:latency>. Throws LoadError.
void add_truths_and_latencies(const Facts& facts, const LinkTree& tree, Entity& entity);

/// Each recorded sensor needs its own trace channel. Throws LoadError.
void check_channels(const XmlSource& source, const Facts& facts, const Entity& entity);

}  // namespace verp::model
