#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/model/params.hpp"

namespace verp::can {

/// Shares are thousandths of the control period, rounded up, of the fullest bus.
struct LoadRow {
  std::uint32_t rate_hz = 0;
  int buses = 1;
  bool fd = false;
  std::uint32_t bits_bare = 0;      ///< of a tick, without stuff bits
  std::uint32_t bits_expected = 0;  ///< with the stuff bits of random data
  std::uint32_t bits_worst = 0;     ///< with the most stuff bits possible
  std::uint32_t bare_permille = 0, expected_permille = 0, worst_permille = 0;  ///< shares of these
  std::uint32_t change_permille = 0;     ///< worst, if all drives change state
  std::uint32_t published_permille = 0;  ///< worst, if the controller publishes the tick
  std::optional<int> no_room;            ///< first joint whose drive does not fit
};

/// 100, 125, 200 and 250 Hz; one and two buses; classic and FD (`data_baud`). Two buses halve the
/// drives in joint order; the IMU is on the first, the feet on the second. Only one classic bus can
/// run today.
std::vector<LoadRow> load_table(const Params& params, std::uint32_t data_baud);

}  // namespace verp::can
