#pragma once
#include <vector>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"
#include "host/study/report/run_data.hpp"
#include "host/twin/sim/metrics.hpp"

namespace verp::tool {

/// Lines between joints, by the core's forward kinematics.
class StickFigure {
 public:
  StickFigure(const model::Entity& entity, const Params& params);

  const std::vector<report::Limb>& limbs() const { return limbs_; }
  /// One per limb. A leg ends in ankle, heel, toe, ankle; a head in its centre.
  std::vector<std::vector<report::Point3>> lines(const sim::SeriesRow& row) const;

 private:
  struct Bone {
    int node;
    model::Vec3 point_m;  ///< in the node's frame
  };
  void add_limb(const model::Limb& limb);
  void add_trunk();

  const model::Entity& entity_;
  const Params& params_;
  std::vector<report::Limb> limbs_;
  std::vector<std::vector<Bone>> bones_;  ///< of each limb
};

}  // namespace verp::tool
