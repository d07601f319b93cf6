#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/study/compare/motion.hpp"
#include "host/trace/record/trace.hpp"

/// A is the reference.
namespace verp::compare {

struct Options {
  double most_delay_s = 0.2;  ///< both ways; less than half a gait cycle
  /// B's clock minus A's at the start; nullopt: found from the traces.
  std::optional<double> shift_s;
};

struct JointResult {
  std::string name;
  double moved_rad = 0;  ///< A, rms about its mean
  /// B - A, from the start of each command.
  double error_rms_rad = 0, error_most_rad = 0, error_most_s = 0;
  double offset_rad = 0;           ///< mean of B - A, without delay
  std::optional<double> delay_s;   ///< of B against A
  std::optional<double> left_rad;  ///< rms of B - A without delay and offset
  std::string no_delay;            ///< why there is no delay
  /// Where both walk, at the gait frequency: B's amplitude over A's, and B's phase lag.
  std::optional<double> gain, phase_lag_rad;
};

enum class Alignment {
  kGiven,    ///< Options::shift_s
  kDecided,  ///< the controller began to act
  kOrdered,  ///< the operator's first order
  kClocks,   ///< first ticks, without an order
};
const char* name_of(Alignment alignment);

struct Comparison {
  Alignment alignment = Alignment::kClocks;
  double shift_s = 0;             ///< B's clock minus A's
  double from_s = 0, to_s = 0;    ///< compared, s from A's first tick
  std::optional<double> delay_s;  ///< common to the moving joints
  double error_rms_rad = 0;
  std::optional<double> gait_hz;  ///< nullopt: neither walks for two cycles
  std::vector<JointResult> joints;
  std::vector<std::string> notes;  ///< remarks, one line each

  const JointResult& worst() const;  ///< by error_rms_rad
};

/// Throws record::TraceError for traces without ticks, with different joints or without overlap.
Comparison compare(const record::Trace& a, const record::Trace& b, const Options& options = {});

/// Both motions at each compared tick of A.
struct Pair {
  std::vector<double> time_s;             ///< A's clock
  std::vector<std::vector<double>> a, b;  ///< rad, by joint
};
Pair pair_of(const Motion& a, const Motion& b, double shift_s, double from_s, double to_s);

}  // namespace verp::compare
