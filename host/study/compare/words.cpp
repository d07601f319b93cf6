#include "host/study/compare/words.hpp"

#include <fmt/format.h>

#include "host/os/files/csv_field.hpp"
#include "host/study/report/maybe.hpp"

namespace verp::compare {
namespace {

std::optional<double> times(const std::optional<double>& value, double factor) {
  return value ? std::optional(factor * *value) : std::nullopt;
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format(",{:.6g}", *value) : ",";
}

}  // namespace

std::string text_of(const Comparison& c) {
  std::string text = fmt::format(
      "laid together {}: B's clock shows {:.3f} s more; {:.2f} s in common, from {:.2f} s of A on\n"
      "B comes {} after A; error {:.2f} degrees rms over all joints, most at {}\n",
      name_of(c.alignment), c.shift_s, c.to_s - c.from_s, c.from_s,
      report::or_dash(times(c.delay_s, 1e3), 1, " ms"), kDegrees * c.error_rms_rad, c.worst().name);
  text += fmt::format("  {:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>9}\n", "joint", "error rms",
                      "error max", "offset", "delay", "left rms", "gain", "phase lag");
  text += fmt::format("  {:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>9}\n", "", "deg", "deg",
                      "deg", "ms", "deg", "", "deg");
  for (const JointResult& each : c.joints) {
    text += fmt::format(
        "  {:<20} {:>9.2f} {:>9.2f} {:>9.2f} {:>9} {:>9} {:>6} {:>9}{}\n", each.name,
        kDegrees * each.error_rms_rad, kDegrees * each.error_most_rad, kDegrees * each.offset_rad,
        report::or_dash(times(each.delay_s, 1e3), 1, ""),
        report::or_dash(times(each.left_rad, kDegrees), 2, ""), report::or_dash(each.gain, 2, ""),
        report::or_dash(times(each.phase_lag_rad, kDegrees), 1, ""),
        each.no_delay.empty() ? "" : "  no delay: " + each.no_delay);
  }
  text += c.gait_hz ? fmt::format("  gain and phase lag of B against A at the gait's {:.2f} Hz\n",
                                  *c.gait_hz)
                    : "  no gain and phase: no two cycles in which both walk steadily\n";
  for (const std::string& note : c.notes) text += "  note: " + note + '\n';
  return text;
}

std::string joints_csv(const Comparison& c) {
  std::string text =
      "joint,moved_rms_rad,error_rms_rad,error_max_rad,error_max_at_s,offset_rad,delay_s,"
      "left_rms_rad,gain,phase_lag_rad\n";
  for (const JointResult& each : c.joints) {
    text += files::csv_field(each.name) +
            fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", each.moved_rad, each.error_rms_rad,
                        each.error_most_rad, each.error_most_s, each.offset_rad) +
            cell(each.delay_s) + cell(each.left_rad) + cell(each.gain) + cell(each.phase_lag_rad) +
            '\n';
  }
  return text;
}

std::string angles_csv(const Comparison& c, const Pair& pair) {
  std::string text = "time_s";
  for (const JointResult& each : c.joints) {
    text +=
        ',' + files::csv_field("a_rad." + each.name) + ',' + files::csv_field("b_rad." + each.name);
  }
  text += '\n';
  for (std::size_t i = 0; i < pair.time_s.size(); ++i) {
    text += fmt::format("{:.6f}", pair.time_s[i]);
    for (std::size_t j = 0; j < pair.a.size(); ++j) {
      text += fmt::format(",{:.6f},{:.6f}", pair.a[j][i], pair.b[j][i]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace verp::compare
