#pragma once
#include "common/gait/gait.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// Adds goals, mode, phase, state, stance and faults.
void add_outputs(RobotView& view, const Outputs& outputs, const Params& params);

/// Adds gyro and accelerometer in body axes.
void add_imu(RobotView& view, const Inputs& inputs, const Params& params);

/// Footholds relative to the stance foot: the plan has its own frame.
std::vector<Footstep> footsteps(const gait::GaitState& gait, const Transform& left_sole_world,
                                const Transform& right_sole_world);

}  // namespace verp::scene
