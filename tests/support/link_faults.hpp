#pragma once
#include <cstdint>
#include <random>
#include <span>

namespace verp::test {

/// One direction.
struct LinkFaults {
  double lost = 0, doubled = 0, flipped = 0;  ///< shares of bytes
};

class LinkSpoiler {
 public:
  explicit LinkSpoiler(std::uint32_t seed) : random_(seed) {}

  template <class To>
  void spoil(std::span<const std::uint8_t> from, To& to, const LinkFaults& odds) {
    std::uniform_real_distribution<double> chance(0, 1);
    for (std::uint8_t byte : from) {
      const double dice = odds.lost + odds.doubled + odds.flipped > 0 ? chance(random_) : 1;
      const bool lost = dice < odds.lost;
      const bool doubled = !lost && dice < odds.lost + odds.doubled;
      const bool flipped = !lost && !doubled && dice < odds.lost + odds.doubled + odds.flipped;
      faults_ += lost || doubled || flipped ? 1 : 0;
      if (flipped) byte = static_cast<std::uint8_t>(byte ^ (1u << (random_() % 8)));
      if (!lost) to.push_back(byte);
      if (doubled) to.push_back(byte);
    }
  }
  std::uint64_t faults() const { return faults_; }

 private:
  std::minstd_rand random_;
  std::uint64_t faults_ = 0;
};

}  // namespace verp::test
