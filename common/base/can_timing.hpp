#pragma once
#include <cstdint>

/// Classic CAN: 1 + before + after time quanta, sampled before `after` (ISO 11898-1, 11.3). An
/// impossible rate fails the build.
namespace verp {

struct CanTiming {
  std::uint32_t prescaler = 0;  ///< of the controller's clock; 0: rate impossible
  std::uint32_t before = 0;     ///< quanta of propagation and phase segment 1
  std::uint32_t after = 0;      ///< quanta of phase segment 2
  std::uint32_t jump = 0;       ///< quanta that a resynchronisation may move

  constexpr bool possible() const { return prescaler != 0; }
  constexpr std::uint32_t quanta() const { return 1 + before + after; }
};

/// Sample point, per mille of a bit: range of CiA 102, best point of CiA 301.
struct CanSampling {
  std::uint32_t least = 750, most = 900, best = 875;
};

/// The exact rate, sampled as close to `sampling.best` as possible, then with the most quanta of 8
/// to 25. Limits of SJA1000, bxCAN and ZynqMP: at most 16 quanta before and 8 after; at least 2
/// after, which an SJA1000 needs to read a bit.
constexpr CanTiming can_timing(std::uint32_t clock_hz, std::uint32_t bit_rate_hz,
                               std::uint32_t most_prescaler, CanSampling sampling = {}) {
  CanTiming timing;
  if (bit_rate_hz == 0 || bit_rate_hz > 1'000'000 || clock_hz % bit_rate_hz != 0) return timing;
  const std::uint32_t cycles = clock_hz / bit_rate_hz;
  std::uint32_t nearest = ~0u;
  for (std::uint32_t quanta = 25; quanta >= 8; --quanta) {
    if (cycles % quanta != 0 || cycles / quanta > most_prescaler) continue;
    for (std::uint32_t after = 2; after <= 8 && after < quanta; ++after) {
      const std::uint32_t before = quanta - 1 - after;
      const std::uint32_t at = 1000 * (quanta - after) / quanta;
      const std::uint32_t off = at > sampling.best ? at - sampling.best : sampling.best - at;
      if (before > 16 || at < sampling.least || at > sampling.most || off >= nearest) continue;
      nearest = off;
      timing = {.prescaler = cycles / quanta,
                .before = before,
                .after = after,
                .jump = after < 4 ? after : 4};
    }
  }
  return timing;
}

}  // namespace verp
