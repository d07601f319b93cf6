#pragma once
#include <string>
#include <vector>

#include "common/model/image.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// The robot's sealed Params image, with golden vectors and self-test digest of this program's
/// core. Throws LoadError if its ticks do not fit the bus (bus_time.hpp).
ParamsImage make_image(const Entity& entity);

/// Reads an image. Throws LoadError for a missing, truncated, damaged or foreign file.
ParamsImage read_image(const std::string& path);

/// A C++ header with the image's bytes as `verp_params_image`, for boards without a flash tool.
std::string image_header(const ParamsImage& image);

/// `verp export MODEL -o DIR`: writes and reports DIR/params.bin and DIR/params.hpp; returns 0.
/// Throws LoadError.
int export_command(const std::string& name_or_path, const std::string& bus,
                   const std::string& directory);

}  // namespace verp::model
