#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/study/compare/motion.hpp"
#include "host/trace/record/trace.hpp"

/// Compares two runs of one command, joint by joint: a robot and its twin, or two twins. B is
/// evaluated against the reference A.
namespace verp::compare {

struct Options {
  double most_delay_s = 0.2;  ///< search range, both ways; less than half a gait cycle
  /// B's clock minus A's at the start of the motion; nullopt: found from the traces.
  std::optional<double> shift_s;
};

struct JointResult {
  std::string name;
  double moved_rad = 0;  ///< of A, rms about its mean
  /// B - A, with the starts of the commands aligned.
  double error_rms_rad = 0, error_most_rad = 0, error_most_s = 0;
  double offset_rad = 0;           ///< mean of B - A, after removing the delay if there is one
  std::optional<double> delay_s;   ///< of B against A
  std::optional<double> left_rad;  ///< rms of B - A without delay and offset
  std::string no_delay;            ///< why there is no delay
  /// At the gait frequency, where both walk: amplitude of B over that of A, and B's phase lag.
  std::optional<double> gain, phase_lag_rad;
};

enum class Alignment {
  kGiven,    ///< Options::shift_s
  kDecided,  ///< the controller began to walk or to act
  kOrdered,  ///< the operator first ordered it
  kClocks,   ///< first ticks: there was no order
};
const char* name_of(Alignment alignment);

struct Comparison {
  Alignment alignment = Alignment::kClocks;
  double shift_s = 0;             ///< B's clock minus A's
  double from_s = 0, to_s = 0;    ///< compared interval, s from A's first tick
  std::optional<double> delay_s;  ///< common to all moving joints
  double error_rms_rad = 0;
  std::optional<double> gait_hz;  ///< nullopt: both never walk for two cycles
  std::vector<JointResult> joints;
  std::vector<std::string> notes;  ///< remarks for the reader, one line each

  const JointResult& worst() const;  ///< by error_rms_rad
};

/// Throws record::TraceError if a trace has no ticks, the joints differ, or the traces do not
/// overlap.
Comparison compare(const record::Trace& a, const record::Trace& b, const Options& options = {});

/// Both motions for pictures and tables, at each compared tick of A.
struct Pair {
  std::vector<double> time_s;             ///< A's clock
  std::vector<std::vector<double>> a, b;  ///< rad, by joint
};
Pair pair_of(const Motion& a, const Motion& b, double shift_s, double from_s, double to_s);

}  // namespace verp::compare
