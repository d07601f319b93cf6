#pragma once
#include <Eigen/Core>
#include <optional>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Projects a direction to a pixel: a pinhole with Brown and Conrady's distortion, as in OpenCV's
/// calib3d. Directions are (x, y) of (x, y, 1), x right, y down. Pixels count from the centre of
/// the upper left one.
Eigen::Vector2d pixel_of(const CameraSensor& camera, const Eigen::Vector2d& direction);
/// The inverse. None: the distortion folds the picture there.
std::optional<Eigen::Vector2d> direction_of(const CameraSensor& camera,
                                            const Eigen::Vector2d& pixel);

/// True for a plain pinhole: square pixels, centred, no distortion.
bool is_plain(const CameraSensor& camera);

/// Converts a point from the camera's link frame to lens axes: x right, y down, z ahead.
Vec3 in_lens(const CameraSensor& camera, const Vec3& point_link_m);

}  // namespace verp::model
