#pragma once
#include <optional>
#include <span>
#include <vector>

/// How much later, and by how much more, one signal does what another does. Signals are sampled
/// every `step_s` at the same times; plain numbers, in any unit.
namespace verp::compare {

/// What is left between `b` and `a` shifted by whole steps, each without its mean: the sum of
/// squares for every shift from -most to most, and what is between the means.
struct Shifts {
  int most = 0;
  std::size_t samples = 0;           ///< of `b` that each shift is held against
  std::vector<double> left, offset;  ///< of shift k at [k + most]
};
/// Only the middle of `b` is used, so that every shift sees the same part of it. Empty `left`: the
/// signals are not longer than twice `most`.
Shifts shifts_of(std::span<const double> a, std::span<const double> b, int most);

/// The shift with the least left, between whole steps: the parabola through it and its neighbours.
struct Delay {
  double steps = 0;     ///< by which b comes after a
  double offset = 0;    ///< b is more than a, delay taken out
  double left_rms = 0;  ///< of b - a, both taken out
};
/// None: the least is at an end of the range, or there is nothing in it.
std::optional<Delay> delay_of(const Shifts& shifts);

/// A signal's part at one frequency: what cos(w t) and sin(w t) share of it, its mean aside.
struct Wave {
  double cosine = 0, sine = 0;
  double amplitude() const;
};
/// By least squares, so that the samples need not fill whole periods.
Wave wave_of(std::span<const double> signal, double step_s, double frequency_hz);
/// How far `b` stays behind `a`, rad within +-pi.
double phase_lag_rad(const Wave& a, const Wave& b);

}  // namespace verp::compare
