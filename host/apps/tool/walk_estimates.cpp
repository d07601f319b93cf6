#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/apps/tool/walk_estimate.hpp"
#include "host/study/survey/interval.hpp"

namespace verp::tool {
namespace {

constexpr double kPromisedAttitude_deg = 0.5;
constexpr double kPromisedVelocity_m_s = 0.03;

double number(const cli::Json& walk, const char* key) {
  return walk.at(key).get<double>();
}

template <class Kept>
std::string share_text(const std::vector<cli::Json>& walks, Kept&& kept) {
  const auto count =
      static_cast<std::size_t>(std::count_if(walks.begin(), walks.end(), std::forward<Kept>(kept)));
  const survey::Interval interval = survey::interval_of(count, walks.size());
  return fmt::format("in {} of {} ({:.1f} to {:.1f} %)", count, walks.size(), 100 * interval.low,
                     100 * interval.high);
}

}  // namespace

std::string estimates_text(const std::vector<cli::Json>& walks) {
  if (walks.empty()) return {};
  const auto all = [&](const char* key) {
    double sum = 0;
    for (const cli::Json& walk : walks) sum += number(walk, key) * number(walk, key);
    return std::sqrt(sum / static_cast<double>(walks.size()));
  };
  const std::string level = share_text(walks, [](const cli::Json& walk) {
    return std::max(number(walk, "roll_rms_deg"), number(walk, "pitch_rms_deg")) <
           kPromisedAttitude_deg;
  });
  const std::string fast = share_text(walks, [](const cli::Json& walk) {
    return number(walk, "com_velocity_rms_m_s") < kPromisedVelocity_m_s;
  });
  return fmt::format(
      "  {:<18}{:.2f} deg rms, roll {:.2f} and pitch {:.2f}; both below {:g} {}\n"
      "  {:<18}{:.4f} m/s rms off; below {:g} {}\n",
      "attitude error", all("attitude_rms_deg"), all("roll_rms_deg"), all("pitch_rms_deg"),
      kPromisedAttitude_deg, level, "CoM velocity", all("com_velocity_rms_m_s"),
      kPromisedVelocity_m_s, fast);
}

}  // namespace verp::tool
