#pragma once
#include <string>
#include <vector>

#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

/// Two joints on one motor: URDF's <mimic>, or <verp:mimic>. Errors point to the coupling.
namespace verp::model {

/// Mimics that the wrapper neither fixes nor drops. Throws LoadError for an invalid number.
std::vector<MimicFact> urdf_mimics(const XmlElement& robot, const Facts& facts);

/// Throws LoadError for a driver that is fixed, a mimic, the same joint or missing, and for a ratio
/// or offset that no gears have. `turning`: moving joints; `fixed`: others.
void check_mimics(const Facts& facts, const std::vector<std::string>& turning,
                  const std::vector<std::string>& fixed);

/// Gives followers their drivers' servos, and both joints common limits and speeds. Throws
/// LoadError if no range remains.
void join_followers(const Facts& facts, Entity& entity);

/// Each leg joint needs a motor; only hip yaws may share one, if they turn the feet opposite ways.
/// Else throws LoadError.
void check_coupled_legs(const Facts& facts, const Entity& entity);

/// Throws LoadError on a contradiction.
void pose_followers(const Facts& facts, Entity& entity);

/// One line per coupling: "r_hip_yaw follows l_hip_yaw: -1 times its angle".
std::vector<std::string> describe_couplings(const Entity& entity);

}  // namespace verp::model
