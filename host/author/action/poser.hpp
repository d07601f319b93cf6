#pragma once
#include <array>
#include <optional>
#include <string>

#include "common/gait/whole_body.hpp"
#include "host/author/action/document.hpp"

namespace verp::action {

using Angles = std::array<float, kMaxJoints>;

class Poser {
 public:
  explicit Poser(const Params& params);

  /// Without sag and corrections.
  const Angles& stand_rad() const { return stand_rad_; }

  struct Legs {
    Offset body, foot[kFeet];
    std::optional<double> over_left;  ///< moves the body until the centre of mass is there
  };
  /// Sets only the legs' angles. Returns empty or the reason.
  std::string bend(const Legs& legs, Angles& angle_rad) const;

 private:
  std::string solve(const Pose& body, const Pose* sole, Angles& angle_rad) const;
  Vec3 middle_m(const Pose& sole, int side) const;

  const Params& params_;
  gait::Posture stand_;
  Angles stand_rad_{};
};

}  // namespace verp::action
