#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/study/compare/motion.hpp"
#include "host/trace/record/trace.hpp"

/// Two runs of one command held against each other, joint by joint: a robot and its twin, or two
/// twins. B is what is asked about, A what it is held against.
namespace verp::compare {

struct Options {
  double most_delay_s = 0.2;  ///< looked for either way; less than half a gait cycle
  /// B's clock shows this much more than A's when both begin. None: found from the traces.
  std::optional<double> shift_s;
};

struct JointResult {
  std::string name;
  double moved_rad = 0;  ///< A's, rms about its mean
  /// B - A, their commands begun together, nothing taken out.
  double error_rms_rad = 0, error_most_rad = 0, error_most_s = 0;
  double offset_rad = 0;           ///< of B - A: with the delay taken out, if there is one
  std::optional<double> delay_s;   ///< B comes that much later
  std::optional<double> left_rad;  ///< rms of B - A, delay and offset taken out
  std::string no_delay;            ///< why there is none, in words
  /// At the gait's frequency, where both walk: B's amplitude as a part of A's, and how far it stays
  /// behind.
  std::optional<double> gain, phase_lag_rad;
};

/// By what the two were laid together.
enum class Alignment {
  kGiven,    ///< Options::shift_s
  kDecided,  ///< when the controller began to walk or to act
  kOrdered,  ///< when the operator first asked for that
  kClocks,   ///< their first ticks: nobody asked for anything
};
const char* name_of(Alignment alignment);

struct Comparison {
  Alignment alignment = Alignment::kClocks;
  double shift_s = 0;             ///< B's clock less A's
  double from_s = 0, to_s = 0;    ///< what was compared, A's clock: seconds from its first tick on
  std::optional<double> delay_s;  ///< of all joints that move, together
  double error_rms_rad = 0;       ///< of all joints
  std::optional<double> gait_hz;  ///< none: no two cycles in which both walk
  std::vector<JointResult> joints;
  std::vector<std::string> notes;  ///< what the reader should know: a line each

  const JointResult& worst() const;  ///< by error_rms_rad
};

/// Throws record::TraceError: a trace without ticks, other joints, nothing in common.
Comparison compare(const record::Trace& a, const record::Trace& b, const Options& options = {});

/// The same two, tick by tick, for pictures and tables: angles at each of A's ticks that was
/// compared.
struct Pair {
  std::vector<double> time_s;             ///< A's clock
  std::vector<std::vector<double>> a, b;  ///< rad, of each joint
};
Pair pair_of(const Motion& a, const Motion& b, double shift_s, double from_s, double to_s);

}  // namespace verp::compare
