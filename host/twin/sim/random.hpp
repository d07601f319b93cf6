#pragma once
#include <array>
#include <bit>
#include <cstdint>

namespace verp::sim {

/// Purpose of a random stream. An additional sample or joint changes no other stream. The values
/// define a seed's meaning: append only.
enum class Draw : std::uint64_t {
  kImuBias = 1,
  kZeroError = 2,
  kInitialPose = 3,
  kMass = 4,
  kImuNoise = 5,
  kFootNoise = 10,  ///< plus the foot's index
  kVaryMass = 20,   ///< from here on: vary.hpp
  kVaryFriction = 21,
  kVaryDelay = 22,
  kVaryBacklash = 23,
  kVaryStrength = 24,
  kVaryRotor = 25,
  kVaryGearFriction = 26,
  kVaryGyroBias = 27,
  kVaryTilt = 28,
  kVarySupply = 29,
  kLyingPose = 30,
  kLaser = 50,         ///< plus the laser's index
  kCamera = 80,        ///< plus the camera's index
  kEncoder = 100,      ///< plus the joint's index
  kForceTorque = 200,  ///< plus the sensor's index
  kTruth = 250,        ///< plus the sensor's index
  kRadio = 300,        ///< host/twin/radio
};

/// xoshiro256** (Blackman and Vigna, public domain), seeded by splitmix64 from (seed, purpose). Own
/// code, because the distributions of <random> differ between standard libraries.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t purpose) {
    std::uint64_t mix = seed ^ std::rotl(purpose * 0xD1342543DE82EF95ULL, 32);
    for (std::uint64_t& word : state_) {
      mix += 0x9E3779B97F4A7C15ULL;
      std::uint64_t z = mix;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
      word = z ^ (z >> 31);
    }
  }
  Random(std::uint64_t seed, Draw purpose, int index = 0)
      : Random(seed, static_cast<std::uint64_t>(purpose) + static_cast<std::uint64_t>(index)) {}

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }

  /// Mean 0, standard deviation 1, at most 6: twelve 16-bit uniforms, without libm. Beyond 3 its
  /// tails are thinner than a Gaussian's.
  double normal() {
    std::uint64_t sum = 0;
    for (int draw = 0; draw < 3; ++draw) {
      const std::uint64_t word = bits();
      sum += (word & 0xFFFF) + ((word >> 16) & 0xFFFF) + ((word >> 32) & 0xFFFF) + (word >> 48);
    }
    return (static_cast<double>(sum) - 6.0 * 65535.0) / 65536.0;
  }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace verp::sim
