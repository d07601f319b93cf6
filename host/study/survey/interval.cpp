#include "host/study/survey/interval.hpp"

#include <cmath>

namespace verp::survey {

// E. B. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22
// (1927).
Interval interval_of(std::uint64_t good, std::uint64_t of) {
  constexpr double kSigmas = 1.959963984540054;  // 2.5 % in either tail
  if (of == 0) return {};
  const double n = static_cast<double>(of), share = static_cast<double>(good) / n;
  const double z2_n = kSigmas * kSigmas / n;
  const double middle = (share + z2_n / 2) / (1 + z2_n);
  const double half = kSigmas / (1 + z2_n) * std::sqrt(share * (1 - share) / n + z2_n / (4 * n));
  return {good == 0 ? 0 : middle - half, good == of ? 1 : middle + half};
}

}  // namespace verp::survey
