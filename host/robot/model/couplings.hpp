#pragma once
#include <string>
#include <vector>

#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

/// One motor for two joints: URDF's <mimic>, or <verp:mimic>. Each refusal stands where the file
/// couples them.
namespace verp::model {

/// The mimics of a URDF that its wrapper neither fixes nor drops. Throws LoadError for what is no
/// number.
std::vector<MimicFact> urdf_mimics(const XmlElement& robot, const Facts& facts);

/// Throws LoadError for a mimic that follows what doesn't turn, another mimic, itself or nobody, or
/// by a ratio or offset that no gears have.
/// `turning`: names of all joints that do; `fixed`: of those that don't.
void check_mimics(const Facts& facts, const std::vector<std::string>& turning,
                  const std::vector<std::string>& fixed);

/// Gives followers their drivers' servos, and both the limits and speeds that either admits. Throws
/// LoadError where none are left.
void join_followers(const Facts& facts, Entity& entity);

/// A leg's joints have motors of their own, but that hips' yaws, which turn the feet opposite ways,
/// may share one. Throws LoadError for others.
void check_coupled_legs(const Facts& facts, const Entity& entity);

/// Followers stand and sit where their drivers do. Throws LoadError where a pose says otherwise.
void pose_followers(const Facts& facts, Entity& entity);

/// One line each, for people: "r_hip_yaw follows l_hip_yaw: -1 times its angle".
std::vector<std::string> describe_couplings(const Entity& entity);

}  // namespace verp::model
