#include "host/robot/model/fit_gains.hpp"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "common/model/params.hpp"
#include "host/robot/model/stance.hpp"

namespace verp::model {
namespace {

void put_gain(const OpenGain& open, std::uint16_t gain) {
  open.servo->p_gain = gain;
  if (open.takes_d_gain) open.servo->d_gain = static_cast<std::uint16_t>(gain / 8);
}

std::size_t kinds_of_settings(const Entity& entity) {
  std::set<std::tuple<int, int, int, int, int, bool>> kinds;
  for (const Joint& joint : entity.joints) {
    const Servo& s = joint.servo;
    if (joint.follows < 0)
      kinds.emplace(s.model_number, s.p_gain, s.i_gain, s.d_gain, s.profile_ms, s.fast_sync_read);
  }
  return kinds.size();
}

/// The two gains of one model whose ratio is least become their mean. False: there are no two.
bool merge_nearest(const std::vector<OpenGain>& open) {
  std::set<std::pair<int, std::uint16_t>> gains;
  for (const OpenGain& each : open) gains.emplace(each.servo->model_number, each.servo->p_gain);
  double least = INFINITY;
  std::pair<int, std::uint16_t> low, high;
  for (auto at = gains.begin(); at != gains.end(); ++at) {
    const auto next = std::next(at);
    if (next == gains.end() || next->first != at->first) continue;
    const double ratio = static_cast<double>(next->second) / at->second;
    if (ratio < least) least = ratio, low = *at, high = *next;
  }
  if (!std::isfinite(least)) return false;
  const auto mean =
      static_cast<std::uint16_t>(std::lround(std::sqrt(1.0 * low.second * high.second)));
  for (const OpenGain& each : open) {
    const std::pair<int, std::uint16_t> own{each.servo->model_number, each.servo->p_gain};
    if (own == low || own == high) put_gain(each, mean);
  }
  return true;
}

}  // namespace

void fit_gains(Entity& entity, const std::vector<OpenGain>& open) {
  for (const OpenGain& each : open) put_gain(each, fitting_p_gain(entity, *each.servo));
  bool merged = false;
  while (kinds_of_settings(entity) > kServoProfiles && merge_nearest(open)) merged = true;
  std::map<std::string, std::uint16_t> fitted;
  for (const OpenGain& each : open) fitted[each.servo->type] = each.servo->p_gain;
  for (const auto& [type, gain] : fitted) {
    entity.defaults.push_back("p_gain " + std::to_string(gain) + " of " + type +
                              ", from its mass and legs");
  }
  if (merged)
    entity.notes.push_back("the nearest P gains are one: the controller has room for 4 kinds");
}

}  // namespace verp::model
