#pragma once
#include <optional>
#include <span>
#include <vector>

/// Delay and offset between two signals. Both are sampled every `step_s` at the same times, in any
/// unit.
namespace verp::compare {

/// Residual between `b` and shifted `a`, both without their means, for each shift of whole steps
/// from -most to most: sum of squares, and the difference of the means.
struct Shifts {
  int most = 0;
  std::size_t samples = 0;           ///< samples of `b` that each shift is compared to
  std::vector<double> left, offset;  ///< shift k is at [k + most]
};
/// Compares the middle of `b`, so that every shift uses the same samples. Empty `left`: the signals
/// are not longer than twice `most`.
Shifts shifts_of(std::span<const double> a, std::span<const double> b, int most);

/// The shift of least residual, interpolated by the parabola through it and its neighbours.
struct Delay {
  double steps = 0;     ///< delay of b after a
  double offset = 0;    ///< b minus a, without the delay
  double left_rms = 0;  ///< of b - a, without delay and offset
};
/// nullopt: the minimum is at an end of the range, or flat.
std::optional<Delay> delay_of(const Shifts& shifts);

/// A signal's component at one frequency, as coefficients of cos(w t) and sin(w t), without the
/// mean.
struct Wave {
  double cosine = 0, sine = 0;
  double amplitude() const;
};
/// A least-squares fit, so the samples need not fill whole periods.
Wave wave_of(std::span<const double> signal, double step_s, double frequency_hz);
/// Phase lag of `b` behind `a`, rad within +-pi.
double phase_lag_rad(const Wave& a, const Wave& b);

}  // namespace verp::compare
