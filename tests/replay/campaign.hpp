#pragma once
#include <cstdint>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "tests/support/random_inputs.hpp"

namespace verp::replay {

enum Event : std::uint32_t {
  kSilentServo = 1 << 0,
  kSilentImu = 1 << 1,
  kQuietOperator = 1 << 2,
  kPressStop = 1 << 3,
  kTip = 1 << 4,    ///< tilts onto its nose
  kRight = 1 << 5,  ///< tilts back
  kTremble = 1 << 6,
  kHot = 1 << 7,
  kLowVoltage = 1 << 8,
  kServoAlarm = 1 << 9,
  kLate = 1 << 10,       ///< the tick before overran
  kFeetInAir = 1 << 11,  ///< the foot sensors bear no weight
  kFeetGone = 1 << 12,   ///< the foot sensors do not answer
  kYawDrift = 1 << 13,   ///< the gyro shows an unrequested turn
  kWrite = 1 << 14,      ///< the first tick writes Episode::value
  kRestore = 1 << 15,    ///< restores one tuning value per tick
  kScan = 1 << 16,       ///< writes one value per tick: too high, too low, NaN
  kFrozenImu = 1 << 17,  ///< repeats its last reading
  kBent = 1 << 18,       ///< a joint is beyond its limits
};

struct Episode {
  static constexpr std::uint8_t kItsTime = 0xFF;
  std::uint32_t ms;               ///< at most,
  std::uint8_t until = kItsTime;  ///< or until this mode
  Request request = Request::kStand;
  std::int16_t vx_tenth_mm_s = 0;
  std::int16_t vy_tenth_mm_s = 0;
  std::int16_t wz_mrad_s = 0;
  std::uint32_t events = 0;
  int id = 0;  ///< of the written value
  float value = 0;
};

/// Starts over at its end, with other velocities.
class Campaign {
 public:
  Campaign(const Params& params, std::uint32_t seed);

  std::uint32_t advance(const Outputs& last, Inputs& in);

 private:
  bool over(const Outputs& last) const;
  void next();
  void send_order(const Episode& now, Inputs& in);
  void write_parameter(const Episode& now, Inputs& in) const;

  const Params& params_;
  test::SmallRandom random_;
  std::vector<Episode> episodes_;
  std::size_t at_ = 0;
  std::uint32_t ticks_ = 0;  ///< of the episode
  std::uint32_t round_ = 0;
  Command order_;
};

}  // namespace verp::replay
