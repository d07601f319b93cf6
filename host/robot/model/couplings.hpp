#pragma once
#include <string>
#include <vector>

#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

/// Two joints on one motor: URDF's <mimic>, or <verp:mimic>. Errors point to the coupling in the
/// file.
namespace verp::model {

/// The mimics of a URDF that its wrapper neither fixes nor drops. Throws LoadError for an invalid
/// number.
std::vector<MimicFact> urdf_mimics(const XmlElement& robot, const Facts& facts);

/// Throws LoadError for a mimic whose driver is fixed, itself a mimic, the same joint or missing,
/// or whose ratio or offset no gears have. `turning`: names of all moving joints; `fixed`: of the
/// others.
void check_mimics(const Facts& facts, const std::vector<std::string>& turning,
                  const std::vector<std::string>& fixed);

/// Gives followers their drivers' servos, and both joints the common limits and speeds. Throws
/// LoadError if no range remains.
void join_followers(const Facts& facts, Entity& entity);

/// Each leg joint needs its own motor; only the hip yaws may share one, if they turn the feet
/// opposite ways. Throws LoadError otherwise.
void check_coupled_legs(const Facts& facts, const Entity& entity);

/// Sets followers' standing and sitting angles from their drivers. Throws LoadError if a pose
/// contradicts them.
void pose_followers(const Facts& facts, Entity& entity);

/// One line per coupling, for people: "r_hip_yaw follows l_hip_yaw: -1 times its angle".
std::vector<std::string> describe_couplings(const Entity& entity);

}  // namespace verp::model
