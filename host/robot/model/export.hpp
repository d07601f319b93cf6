#pragma once
#include <string>
#include <vector>

#include "common/model/image.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// The robot's Params image, sealed, with golden vectors and self-test digest of this program's
/// core. Throws LoadError when its bus has no room for its ticks (bus_time.hpp).
ParamsImage make_image(const Entity& entity);

/// Reads an image back. Throws LoadError for a missing, truncated, damaged or foreign file.
ParamsImage read_image(const std::string& path);

/// A C++ header that holds the image's bytes as `verp_params_image`, for boards without a flash
/// tool of their own.
std::string image_header(const ParamsImage& image);

/// `verp export MODEL -o DIR`: writes DIR/params.bin and DIR/params.hpp and says so. Throws
/// LoadError; else returns 0.
int export_command(const std::string& name_or_path, const std::string& bus,
                   const std::string& directory);

}  // namespace verp::model
