#include "host/study/compare/delay.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::compare {
namespace {

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

Shifts shifts_of(std::span<const double> a, std::span<const double> b, int most) {
  Shifts shifts{most, 0, {}, {}};
  const auto margin = static_cast<std::size_t>(most);
  const std::size_t length = std::min(a.size(), b.size());
  if (length <= 2 * margin + 1) return shifts;
  shifts.samples = length - 2 * margin;
  const std::span<const double> middle = b.subspan(margin, shifts.samples);
  const double mean_b = mean_of(middle);
  for (std::size_t from = 2 * margin + 1; from-- > 0;) {
    const std::span<const double> shifted = a.subspan(from, shifts.samples);
    const double offset = mean_b - mean_of(shifted);
    double left = 0;
    for (std::size_t i = 0; i < shifts.samples; ++i) {
      const double error = middle[i] - shifted[i] - offset;
      left += error * error;
    }
    shifts.left.push_back(left);
    shifts.offset.push_back(offset);
  }
  return shifts;
}

std::optional<Delay> delay_of(const Shifts& shifts) {
  const auto& left = shifts.left;
  if (left.size() < 3) return std::nullopt;
  const auto least =
      static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  if (least == 0 || least + 1 == left.size()) return std::nullopt;
  const double bend = left[least - 1] - 2 * left[least] + left[least + 1];
  if (bend <= 0) return std::nullopt;  // flat: no motion
  const double part = (left[least - 1] - left[least + 1]) / 2 / bend;
  const double at_least = left[least] - bend * part * part / 2;
  const auto& offset = shifts.offset;
  const std::size_t next = part < 0 ? least - 1 : least + 1;
  return Delay{
      static_cast<double>(least) + part - shifts.most,
      offset[least] + std::abs(part) * (offset[next] - offset[least]),
      std::sqrt(std::max(at_least, 0.0) / static_cast<double>(shifts.samples)),
  };
}

double Wave::amplitude() const {
  return std::hypot(cosine, sine);
}

Wave wave_of(std::span<const double> signal, double step_s, double frequency_hz) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double angle = 2 * std::numbers::pi * frequency_hz * step_s * static_cast<double>(i);
    const Eigen::Vector3d row(1, std::cos(angle), std::sin(angle));
    normal += row * row.transpose();
    right += row * signal[i];
  }
  const Eigen::Vector3d parts = normal.ldlt().solve(right);
  return {parts[1], parts[2]};
}

double phase_lag_rad(const Wave& a, const Wave& b) {
  const double lag = std::atan2(b.sine, b.cosine) - std::atan2(a.sine, a.cosine);
  return std::remainder(lag, 2 * std::numbers::pi);
}

}  // namespace verp::compare
