#pragma once
#include <string>
#include <vector>

#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"

namespace verp::survey {

/// Survived impulses of one direction, over the phases that were tried.
struct Side {
  double direction_rad = 0;
  double least_n_s = 0, middle_n_s = 0, most_n_s = 0;
  int least_phase = 0;  ///< first of the weakest
};
/// Sides in the map's order, without untried directions.
std::vector<Side> sides_of(const PushMap& map);

/// "ahead", "90° left", "back".
std::string direction_name(double direction_rad);

std::string text_of(const PushMap& map, const PushOptions& options);
std::string csv_of(const PushMap& map);

std::string text_of(const StabilityMap& map, const StabilityOptions& options);
std::string csv_of(const StabilityMap& map);

int count_of(const StabilityMap& map, StabilityCell::End end);

}  // namespace verp::survey
