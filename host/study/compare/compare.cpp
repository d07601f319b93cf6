#include "host/study/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/study/compare/delay.hpp"

namespace verp::compare {
namespace {

constexpr double kStill_rad = 0.0035;  ///< 0.2 degrees rms, two counts of 4096: encoder noise
constexpr double kAlike = 0.5;         ///< largest residual, part of B's motion
constexpr double kLeastCommon_s = 0.5;
constexpr double kLeastRead = 0.5;
constexpr double kMainPart = 0.35;  ///< least share of the gait frequency
constexpr int kSettleCycles = 2, kLeastCycles = 2;

void refuse_what_has_no_ticks(const record::Trace& trace) {
  if (!trace.ticks.empty()) return;
  throw record::TraceError(trace.file, "holds no tick", "record a run that begins");
}

/// The trace begins in the middle of a motion: the time of the command is unknown.
void refuse_what_began_before(const record::Trace& trace) {
  if (!trace.before) return;
  if (trace.before->gait.queued == 0 && trace.before->action.number == 0) return;
  throw record::TraceError(trace.file, "begins in the midst of a walk or an action",
                           "give --shift, or the trace that it was cut from");
}

void refuse_other_joints(const record::Trace& trace_b, const Motion& a, const Motion& b) {
  if (a.joints() == b.joints()) return;
  std::size_t j = 0;
  while (j < a.joints().size() && j < b.joints().size() && a.joints()[j] == b.joints()[j]) ++j;
  const auto name = [&](const Motion& of) {
    return j < of.joints().size() ? "'" + of.joints()[j] + "'" : std::string("missing");
  };
  throw record::TraceError(
      trace_b.file,
      fmt::format("another robot: joint {} is {}, in the first trace {}", j, name(b), name(a)),
      "compare traces of one robot");
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double rms_about(const std::vector<double>& values, double mean) {
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

class Comparing {
 public:
  Comparing(const record::Trace& a, const record::Trace& b, const Options& options)
      : trace_a_(a), trace_b_(b), options_(options), a_(a), b_(b) {}

  Comparison run() {
    refuse_other_joints(trace_b_, a_, b_);
    align();
    find_common();
    pair_ = pair_of(a_, b_, out_.shift_s, out_.from_s, out_.to_s);
    note_what_differs();
    find_gait();
    for (std::size_t j = 0; j < a_.joints().size(); ++j) out_.joints.push_back(joint(j));
    sum_up();
    return std::move(out_);
  }

 private:
  void align() {
    const auto by = [&](Alignment alignment, double a_s, double b_s) {
      out_.alignment = alignment;
      out_.from_s = a_s;
      out_.shift_s = b_s - a_s;
    };
    if (options_.shift_s) return by(Alignment::kGiven, 0, *options_.shift_s);
    if (a_.begun_s() && b_.begun_s()) {
      return by(Alignment::kDecided, *a_.begun_s(), *b_.begun_s());
    }
    if (a_.ordered_s() && b_.ordered_s()) {
      return by(Alignment::kOrdered, *a_.ordered_s(), *b_.ordered_s());
    }
    by(Alignment::kClocks, 0, 0);
  }

  void find_common() {
    out_.from_s = std::max(out_.from_s, -out_.shift_s);
    out_.to_s = std::min(a_.length_s(), b_.length_s() - out_.shift_s);
    if (out_.to_s - out_.from_s >= 2 * options_.most_delay_s + kLeastCommon_s) return;
    throw record::TraceError(
        trace_b_.file,
        fmt::format("has {:.2f} s in common with the first trace, {:.2f} s later ({}); {:.2f} s "
                    "are needed",
                    std::max(out_.to_s - out_.from_s, 0.0), out_.shift_s, name_of(out_.alignment),
                    2 * options_.most_delay_s + kLeastCommon_s),
        "record both for longer, or say with --shift how much B's clock shows more than A's");
  }

  void note_what_differs() {
    if (std::string(trace_a_.params.name) != trace_b_.params.name) {
      out_.notes.push_back(
          fmt::format("A is of the robot {}, B of {}: their joints have the same names",
                      trace_a_.params.name, trace_b_.params.name));
    }
    for (const double time_s : pair_.time_s) {
      const Command& a = a_.order(time_s);
      const Command& b = b_.order(time_s + out_.shift_s);
      if (a.vx_tenth_mm_s == b.vx_tenth_mm_s && a.vy_tenth_mm_s == b.vy_tenth_mm_s &&
          a.wz_mrad_s == b.wz_mrad_s) {
        continue;
      }
      out_.notes.push_back(
          fmt::format("the two were ordered differently: at {:.2f} s A {:.3f} m/s ahead, B {:.3f}",
                      time_s, 1e-4 * a.vx_tenth_mm_s, 1e-4 * b.vx_tenth_mm_s));
      break;
    }
    if (std::abs(a_.cycle_s() - b_.cycle_s()) > 1e-6) {
      out_.notes.push_back(fmt::format("A's gait has cycles of {:.3f} s, B's of {:.3f} s",
                                       a_.cycle_s(), b_.cycle_s()));
    }
  }

  void find_gait() {
    if (!a_.ordered_s() || std::abs(a_.cycle_s() - b_.cycle_s()) > 1e-6) return;
    const double from_s = out_.from_s + kSettleCycles * a_.cycle_s();
    const double to_s =
        std::min({out_.to_s, a_.walked_until_s(), b_.walked_until_s() - out_.shift_s});
    const double cycles = std::floor((to_s - from_s) / a_.cycle_s());
    if (cycles < kLeastCycles) return;
    out_.gait_hz = 1 / a_.cycle_s();
    const double step_s = a_.period_s();
    gait_from_ = static_cast<std::size_t>((from_s - out_.from_s) / step_s);
    gait_samples_ = static_cast<std::size_t>(cycles * a_.cycle_s() / step_s);
  }

  JointResult joint(std::size_t j) {
    const std::vector<double>&a = pair_.a[j], &b = pair_.b[j];
    JointResult result;
    result.name = a_.joints()[j];
    result.moved_rad = rms_about(a, mean_of(a));
    see_error(a, b, result);
    see_delay(j, rms_about(b, mean_of(b)), result);
    see_gait(a, b, result);
    return result;
  }

  void see_error(const std::vector<double>& a, const std::vector<double>& b, JointResult& result) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double error = b[i] - a[i];
      squares += error * error;
      sum += error;
      if (std::abs(error) <= std::abs(result.error_most_rad)) continue;
      result.error_most_rad = error;
      result.error_most_s = pair_.time_s[i];
    }
    result.error_rms_rad = std::sqrt(squares / static_cast<double>(a.size()));
    result.offset_rad = sum / static_cast<double>(a.size());
  }

  void see_delay(std::size_t j, double b_moved_rad, JointResult& result) {
    const double read = std::min(a_.read_share(j), b_.read_share(j));
    if (read < kLeastRead) {
      result.no_delay = fmt::format("read in {:.0f} % of the ticks only", 100 * read);
      return;
    }
    if (std::min(result.moved_rad, b_moved_rad) < kStill_rad) {
      result.no_delay = "it hardly moves";
      return;
    }
    const int most = static_cast<int>(std::lround(options_.most_delay_s / a_.period_s()));
    const Shifts shifts = shifts_of(pair_.a[j], pair_.b[j], most);
    const std::optional<Delay> delay = delay_of(shifts);
    if (!delay) {
      result.no_delay = fmt::format("none within {:.0f} ms", 1e3 * options_.most_delay_s);
      return;
    }
    if (delay->left_rms > kAlike * b_moved_rad) {
      result.no_delay = "the two move differently";
      return;
    }
    result.delay_s = delay->steps * a_.period_s();
    result.offset_rad = delay->offset;
    result.left_rad = delay->left_rms;
    add(shifts);
  }

  void add(const Shifts& shifts) {
    if (all_.left.empty()) {
      all_ = shifts;
      return;
    }
    for (std::size_t k = 0; k < all_.left.size(); ++k) all_.left[k] += shifts.left[k];
  }

  void see_gait(std::span<const double> a, std::span<const double> b, JointResult& result) const {
    if (!out_.gait_hz) return;
    const auto wave = [&](std::span<const double> signal) {
      return wave_of(signal.subspan(gait_from_, gait_samples_), a_.period_s(), *out_.gait_hz);
    };
    const Wave of_a = wave(a), of_b = wave(b);
    if (std::min(of_a.amplitude(), of_b.amplitude()) < kStill_rad) return;
    // Harmonics leak into a component that is small beside them.
    const double whole_rad = result.moved_rad * std::numbers::sqrt2;
    if (of_a.amplitude() < kMainPart * whole_rad) return;
    result.gain = of_b.amplitude() / of_a.amplitude();
    result.phase_lag_rad = phase_lag_rad(of_a, of_b);
  }

  void sum_up() {
    double squares = 0;
    for (const JointResult& each : out_.joints) squares += each.error_rms_rad * each.error_rms_rad;
    out_.error_rms_rad = std::sqrt(squares / static_cast<double>(out_.joints.size()));
    const std::optional<Delay> delay = delay_of(all_);
    if (delay) out_.delay_s = delay->steps * a_.period_s();
  }

  const record::Trace &trace_a_, &trace_b_;
  const Options& options_;
  Motion a_, b_;
  Comparison out_;
  Pair pair_;
  Shifts all_;  ///< over all joints with a delay
  std::size_t gait_from_ = 0, gait_samples_ = 0;
};

}  // namespace

const char* name_of(Alignment alignment) {
  constexpr const char* kNames[] = {"as --shift says", "by where the controller begins to move it",
                                    "by the operator's order", "by their first ticks"};
  return kNames[static_cast<int>(alignment)];
}

const JointResult& Comparison::worst() const {
  return *std::max_element(joints.begin(), joints.end(), [](const auto& one, const auto& other) {
    return one.error_rms_rad < other.error_rms_rad;
  });
}

Comparison compare(const record::Trace& a, const record::Trace& b, const Options& options) {
  refuse_what_has_no_ticks(a);
  refuse_what_has_no_ticks(b);
  if (!options.shift_s) {
    for (const record::Trace* trace : {&a, &b}) refuse_what_began_before(*trace);
  }
  return Comparing(a, b, options).run();
}

Pair pair_of(const Motion& a, const Motion& b, double shift_s, double from_s, double to_s) {
  Pair pair;
  const auto samples = static_cast<std::size_t>((to_s - from_s) / a.period_s() + 1e-6) + 1;
  for (std::size_t i = 0; i < samples; ++i) {
    pair.time_s.push_back(from_s + static_cast<double>(i) * a.period_s());
  }
  for (std::size_t j = 0; j < a.joints().size(); ++j) {
    std::vector<double>& of_a = pair.a.emplace_back();
    std::vector<double>& of_b = pair.b.emplace_back();
    for (const double time_s : pair.time_s) {
      of_a.push_back(a.rad(j, time_s));
      of_b.push_back(b.rad(j, time_s + shift_s));
    }
  }
  return pair;
}

}  // namespace verp::compare
