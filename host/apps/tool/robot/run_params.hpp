#pragma once
#include <optional>
#include <string>

#include "common/model/params.hpp"
#include "host/os/imu/imu_place.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Changes to a model's Params, besides tuning, for `verp run` and `verp shadow`.
struct RunParams {
  std::string imu = "bus";
  double period_ms = 0;  ///< 0: the model's

  bool has_imu() const { return imu != "none"; }
  /// The IMU of this PC, if it is one. Throws link::EndpointError.
  std::optional<imu::ImuPlace> own_imu() const;
};

void declare_run_params(CLI::App& app, RunParams& words);
void apply_run_params(const RunParams& words, Params& params);

}  // namespace verp::tool
