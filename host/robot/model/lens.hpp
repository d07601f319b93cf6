#pragma once
#include <Eigen/Core>
#include <optional>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Where a camera has in its picture what lies in which direction: a pinhole behind the distortion
/// of Brown and Conrady, as OpenCV's calib3d has it. Directions are (x, y) of (x, y, 1), x right, y
/// down; pixels are counted from the upper left one's centre.
Eigen::Vector2d pixel_of(const CameraSensor& camera, const Eigen::Vector2d& direction);
/// The other way round. None: the distortion folds the picture there.
std::optional<Eigen::Vector2d> direction_of(const CameraSensor& camera,
                                            const Eigen::Vector2d& pixel);

/// A plain pinhole makes its picture: square pixels, centred, no distortion.
bool is_plain(const CameraSensor& camera);

/// A point of the camera's link's frame as it sees it: x right, y down, z ahead.
Vec3 in_lens(const CameraSensor& camera, const Vec3& point_link_m);

}  // namespace verp::model
