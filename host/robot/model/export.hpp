#pragma once
#include <string>
#include <vector>

#include "common/model/image.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Sealed Params image, with golden vectors and self-test digest of this core. Throws LoadError if
/// the bus is too slow (bus_time.hpp).
ParamsImage make_image(const Entity& entity);

/// Throws LoadError for a missing, truncated, damaged or foreign file.
ParamsImage read_image(const std::string& path);

/// C++ header with `verp_params_image`, for boards without a flash tool.
std::string image_header(const ParamsImage& image);

/// Writes DIR/params.bin and DIR/params.hpp; returns 0. Throws LoadError.
int export_command(const std::string& name_or_path, const std::string& bus,
                   const std::string& directory);

}  // namespace verp::model
