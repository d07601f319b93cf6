#pragma once
#include <Eigen/Core>
#include <optional>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// A pinhole with Brown and Conrady's distortion, as OpenCV's calib3d. Directions are (x, y) of (x,
/// y, 1), x right, y down. Pixels count from the centre of the upper left one.
Eigen::Vector2d pixel_of(const CameraSensor& camera, const Eigen::Vector2d& direction);
/// The inverse. Nothing: the distortion folds there.
std::optional<Eigen::Vector2d> direction_of(const CameraSensor& camera,
                                            const Eigen::Vector2d& pixel);

/// Square pixels, centred, no distortion.
bool is_plain(const CameraSensor& camera);

/// From the link frame to lens axes: x right, y down, z ahead.
Vec3 in_lens(const CameraSensor& camera, const Vec3& point_link_m);

}  // namespace verp::model
