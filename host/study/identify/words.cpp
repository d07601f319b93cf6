#include "host/study/identify/words.hpp"

#include <fmt/format.h>

#include <numbers>

namespace verp::identify {

std::string text_of(const Result& result) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  std::string text =
      fmt::format("{}: {} joints, {:.1f} s, of which {:.1f} s were fitted\n", result.type,
                  result.joints.size(), result.length_s, result.fitted_until_s);
  text += fmt::format("  {:<18} {:>10} {:>10} {:>10} {:<8}\n", "", "was", "now", "+-", "");
  for (const Row& row : result.rows) {
    if (row.determined) {
      text += fmt::format("  {:<18} {:>10.4g} {:>10.4g} {:>10.2g} {:<8} {}\n", row.name, row.was,
                          row.now, row.error, row.unit, row.meaning);
    } else {
      text += fmt::format("  {:<18} {:>10.4g} {:>10} {:>10} {:<8} not determined by this motion\n",
                          row.name, row.was, "-", "-", row.unit);
    }
  }
  const auto line = [&](const char* name, const Errors& errors) {
    return fmt::format("  {:<18} {:>10.4f} {:>10.4f} {:>10} {:<8} rms between twin and robot\n",
                       name, kDegrees * errors.before_rad, kDegrees * errors.after_rad, "",
                       "degrees");
  };
  return text + line("fitted part", result.fitted) + line("held-out part", result.held_out);
}

}  // namespace verp::identify
