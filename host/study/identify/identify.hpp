#pragma once
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/study/survey/workers.hpp"
#include "host/trace/record/trace.hpp"

/// Finds the servo parameters with which the twin, given the same goals, moves as the recorded
/// robot did.
namespace verp::identify {

struct Options {
  std::string type;        ///< servo type; empty: the robot's only one
  double held_out = 0.25;  ///< last part of the recording, hidden from the fit
};

struct Row {
  std::string name, unit, meaning;
  double was = 0, now = 0, error = 0;  ///< error: one standard deviation, from chance alone
  bool determined = false;  ///< false: the motion does not determine it, and it kept its value
};

struct Errors {
  double before_rad = 0, after_rad = 0;  ///< rms
};

struct Result {
  std::string type;
  std::vector<std::string> joints;
  double length_s = 0, fitted_until_s = 0;
  std::vector<Row> rows;
  Errors fitted, held_out;
  bool interrupted = false;  ///< true: no other field is valid
  model::Servo servo;        ///< of that type, with the new numbers
};

/// Throws record::TraceError for a trace that is not suitable and model::LoadError for a type that
/// the robot does not have.
Result identify(const model::Entity& entity, const record::Trace& trace, const Options& options,
                const survey::Watch& watch);

}  // namespace verp::identify
