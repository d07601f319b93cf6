#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/model/params.hpp"

namespace verp::can {

/// One way to run a robot's CAN bus, and what that takes. Shares are thousandths of the control
/// period, rounded up; of several buses that of the fullest.
struct LoadRow {
  std::uint32_t rate_hz = 0;
  int buses = 1;
  bool fd = false;
  std::uint32_t bits_bare = 0;      ///< of a tick, without stuff bits
  std::uint32_t bits_expected = 0;  ///< with as many as random bits take
  std::uint32_t bits_worst = 0;     ///< with as many as there can be
  std::uint32_t bare_permille = 0, expected_permille = 0, worst_permille = 0;  ///< the same
  std::uint32_t change_permille = 0;  ///< worst, in a tick in which all drives change their state
  std::uint32_t published_permille = 0;  ///< worst, and the controller tells of each tick
  std::optional<int> no_room;            ///< first joint whose drive does not fit; nothing: all do
};

/// 100, 125, 200 and 250 Hz, one and two buses, classic and FD; FD frames switch to `data_baud`.
/// Two buses share the drives by halves, in the order of joints; the IMU is on the first, the feet
/// are on the second. Only one classic bus can be run today: no controller here sends FD frames or
/// has two buses. Those rows are arithmetic, of the same frames.
std::vector<LoadRow> load_table(const Params& params, std::uint32_t data_baud);

}  // namespace verp::can
