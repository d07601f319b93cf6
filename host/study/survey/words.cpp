#include "host/study/survey/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::survey {
namespace {

using End = StabilityCell::End;

constexpr double kDegrees = 180 / std::numbers::pi;

std::string number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "";
}

char letter(End end) {
  constexpr char kLetters[] = {'-', '+', '~', 'x', '!'};
  return kLetters[static_cast<int>(end)];
}

/// A plane from above, as letters. Rows: vx, the fastest first. Columns: the other velocity, left
/// first.
std::string plane_text(const StabilityMap& map, const StabilityOptions& options, const char* title,
                       double Velocity::*across, double Velocity::*other) {
  std::string out = fmt::format("  {}\n", title);
  const int half = options.on_axis / 2;
  const auto letter_at = [&](double ahead_m_s, double aside) {
    for (const StabilityCell& cell : map.cells) {
      const bool here = std::abs(cell.asked.vx_m_s - ahead_m_s) < 1e-9 &&
                        std::abs(cell.asked.*across - aside) < 1e-9;
      if (here && cell.asked.*other == 0) return letter(cell.end);
    }
    return ' ';
  };
  for (int row = half; row >= -half; --row) {
    const double vx_m_s = options.most.vx_m_s * row / half;
    out += fmt::format("  {:>7.3f}  ", vx_m_s);
    for (int column = half; column >= -half; --column)
      out += fmt::format(" {}", letter_at(vx_m_s, options.most.*across * column / half));
    out += '\n';
  }
  return out;
}

const StabilityCell* fastest(const StabilityMap& map, double Velocity::*axis, double sign) {
  const StabilityCell* found = nullptr;
  for (const StabilityCell& cell : map.cells) {
    if (cell.end != End::kWalked || sign * cell.asked.*axis <= 0) continue;
    const Velocity& asked = cell.asked;
    const int moving = (asked.vx_m_s != 0) + (asked.vy_m_s != 0) + (asked.wz_rad_s != 0);
    if (moving != 1) continue;
    if (!found || sign * cell.walked.value().*axis > sign * found->walked.value().*axis)
      found = &cell;
  }
  return found;
}

}  // namespace

std::vector<Side> sides_of(const PushMap& map) {
  std::vector<Side> sides;
  for (const PushCell& first : map.cells) {
    if (first.phase != 0) break;
    std::vector<double> all;
    Side side{.direction_rad = first.direction_rad, .least_n_s = 1e9};
    for (const PushCell& cell : map.cells) {
      if (cell.direction_rad != first.direction_rad || !cell.survives_n_s) continue;
      all.push_back(*cell.survives_n_s);
      if (all.back() < side.least_n_s) side.least_n_s = all.back(), side.least_phase = cell.phase;
    }
    if (all.empty()) continue;
    std::sort(all.begin(), all.end());
    side.middle_n_s = all[all.size() / 2];
    side.most_n_s = all.back();
    sides.push_back(side);
  }
  return sides;
}

std::string direction_name(double direction_rad) {
  const double degrees = kDegrees * direction_rad;
  if (std::abs(degrees) < 0.05) return "ahead";
  if (std::abs(degrees) > 179.95) return "back";
  return fmt::format("{:.4g}° {}", std::abs(degrees), degrees > 0 ? "left" : "right");
}

std::string text_of(const PushMap& map, const PushOptions& options) {
  std::string out = fmt::format(
      "  the hardest push of {:g} ms at '{}' that it {} after, N s, told apart by {:g} up to "
      "{:g}:\n",
      1e3 * options.push_s, map.link, options.standing ? "stands" : "walks on", options.step_n_s,
      options.most_n_s());
  if (options.standing) {
    for (const PushCell& cell : map.cells) {
      out += fmt::format("  {:<20}{}\n", direction_name(cell.direction_rad),
                         cell.survives_n_s ? fmt::format("{:.1f}", *cell.survives_n_s) : "-");
    }
    return out;
  }
  out += fmt::format("  pushed to   weakest at phase   middle   strongest   phases 0 to {}\n",
                     options.phases - 1);
  for (const Side& side : sides_of(map)) {
    // The degree sign has two bytes, one column.
    const std::string name = direction_name(side.direction_rad);
    const std::size_t width = name.find("°") == name.npos ? 12 : 13;
    out += fmt::format("  {:<{}}{:>7.1f} {:>8}   {:>6.1f}   {:>9.1f}  ", name, width,
                       side.least_n_s, side.least_phase, side.middle_n_s, side.most_n_s);
    for (const PushCell& cell : map.cells) {
      if (cell.direction_rad != side.direction_rad) continue;
      out += cell.survives_n_s ? fmt::format(" {:.1f}", *cell.survives_n_s) : "   -";
    }
    out += '\n';
  }
  return out;
}

std::string csv_of(const PushMap& map) {
  std::string out = "phase,direction_deg,at_s,survives_n_s\n";
  for (const PushCell& cell : map.cells) {
    out += fmt::format("{},{:.3f},{:.4f},{}\n", cell.phase, kDegrees * cell.direction_rad,
                       cell.at_s, number(cell.survives_n_s, 3));
  }
  return out;
}

std::string text_of(const StabilityMap& map, const StabilityOptions& options) {
  std::string out =
      plane_text(map, options,
                 "vx, m/s, by turn wz, turns to the left first (+ walked, ~ short, x fell, ! "
                 "failed, - not walked):",
                 &Velocity::wz_rad_s, &Velocity::vy_m_s) +
      plane_text(map, options, "vx, m/s, by sideways vy, to the left first:", &Velocity::vy_m_s,
                 &Velocity::wz_rad_s);
  const struct {
    const char *name, *unit;
    double Velocity::*axis;
    double sign;
  } kRows[] = {{"ahead", "m/s", &Velocity::vx_m_s, 1},
               {"back", "m/s", &Velocity::vx_m_s, -1},
               {"to the left", "m/s", &Velocity::vy_m_s, 1},
               {"to the right", "m/s", &Velocity::vy_m_s, -1},
               {"turning left", "rad/s", &Velocity::wz_rad_s, 1},
               {"turning right", "rad/s", &Velocity::wz_rad_s, -1}};
  for (const auto& row : kRows) {
    const StabilityCell* cell = fastest(map, row.axis, row.sign);
    if (cell == nullptr) continue;
    out += fmt::format("  fastest {:<14} {:.3f} {}, asked {:.3f}\n", row.name,
                       std::abs(cell->walked.value().*row.axis), row.unit,
                       std::abs(cell->asked.*row.axis));
  }
  return out;
}

std::string csv_of(const StabilityMap& map) {
  std::string out =
      "asked_vx_m_s,asked_vy_m_s,asked_wz_rad_s,ordered_vx_m_s,ordered_vy_m_s,ordered_wz_rad_s,"
      "walked_vx_m_s,walked_vy_m_s,walked_wz_rad_s,end\n";
  for (const StabilityCell& cell : map.cells) {
    const auto part = [](const std::optional<Velocity>& v) {
      return v ? fmt::format("{:.4f},{:.4f},{:.4f}", v->vx_m_s, v->vy_m_s, v->wz_rad_s) : ",,";
    };
    const bool tried = cell.end != End::kNone;
    out += fmt::format("{},{},{},{}\n", part(cell.asked),
                       part(tried ? std::optional(cell.ordered) : std::nullopt), part(cell.walked),
                       name_of(cell.end));
  }
  return out;
}

int count_of(const StabilityMap& map, End end) {
  return static_cast<int>(
      std::count_if(map.cells.begin(), map.cells.end(),
                    [&](const StabilityCell& cell) { return cell.end == end; }));
}

}  // namespace verp::survey
