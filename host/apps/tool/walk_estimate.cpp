#include "host/apps/tool/walk_estimate.hpp"

#include <fmt/format.h>

namespace verp::tool {
std::string estimate_text(const session::EstimateErrors& errors) {
  if (errors.ticks == 0) return {};
  return fmt::format(
      "attitude {:.2f} deg rms (roll {:.2f}, pitch {:.2f}), CoM velocity {:.3f} m/s rms, DCM "
      "{:.1f} mm rms; odometry {:.3f} m and {:+.1f} deg off after {:.2f} m",
      errors.attitude_rms_deg, errors.roll_rms_deg, errors.pitch_rms_deg,
      errors.com_velocity_rms_m_s, 1e3 * errors.dcm_rms_m, errors.odometry_off_m,
      errors.odometry_turned_off_deg, errors.way_m);
}

cli::Json estimate_json(const session::EstimateErrors& errors) {
  if (errors.ticks == 0) return {};
  return {{"ticks", errors.ticks},
          {"attitude_rms_deg", errors.attitude_rms_deg},
          {"roll_rms_deg", errors.roll_rms_deg},
          {"pitch_rms_deg", errors.pitch_rms_deg},
          {"attitude_worst_deg", errors.attitude_worst_deg},
          {"com_velocity_rms_m_s", errors.com_velocity_rms_m_s},
          {"com_velocity_worst_m_s", errors.com_velocity_worst_m_s},
          {"dcm_rms_m", errors.dcm_rms_m},
          {"odometry_off_m", errors.odometry_off_m},
          {"odometry_turned_off_deg", errors.odometry_turned_off_deg},
          {"odometry_way_m", errors.way_m}};
}

}  // namespace verp::tool
