#pragma once
#include <optional>
#include <span>
#include <vector>

/// Delay and offset between two signals, sampled every `step_s` at the same times.
namespace verp::compare {

/// Residual between `b` and shifted `a`, without their means, for whole-step shifts from -most to
/// most: sum of squares, and difference of the means.
struct Shifts {
  int most = 0;
  std::size_t samples = 0;           ///< samples of `b`
  std::vector<double> left, offset;  ///< shift k is at [k + most]
};
/// Compares the middle of `b`: every shift uses the same samples. Empty `left`: signals not longer
/// than twice `most`.
Shifts shifts_of(std::span<const double> a, std::span<const double> b, int most);

/// Least residual, interpolated by a parabola.
struct Delay {
  double steps = 0;     ///< delay of b after a
  double offset = 0;    ///< b minus a, without delay
  double left_rms = 0;  ///< b - a, without delay and offset
};
/// nullopt: the minimum is flat, or at an end.
std::optional<Delay> delay_of(const Shifts& shifts);

/// Component at one frequency: coefficients of cos(w t) and sin(w t).
struct Wave {
  double cosine = 0, sine = 0;
  double amplitude() const;
};
/// A least-squares fit: samples need not fill whole periods.
Wave wave_of(std::span<const double> signal, double step_s, double frequency_hz);
/// Phase lag of `b` behind `a`, rad within +-pi.
double phase_lag_rad(const Wave& a, const Wave& b);

}  // namespace verp::compare
