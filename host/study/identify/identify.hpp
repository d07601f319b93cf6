#pragma once
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/study/survey/workers.hpp"
#include "host/trace/record/trace.hpp"

/// Finds the servo numbers with which the twin moves as the recorded robot, given the same goals.
namespace verp::identify {

struct Options {
  std::string type;        ///< empty: the robot's only one
  double held_out = 0.25;  ///< last part, hidden from the fit
};

struct Row {
  std::string name, unit, meaning;
  double was = 0, now = 0, error = 0;  ///< error: one sigma, from chance alone
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
  bool interrupted = false;  ///< then only this field is valid
  model::Servo servo;        ///< with the new numbers
};

/// Throws record::TraceError for an unsuitable trace, model::LoadError for a missing type.
Result identify(const model::Entity& entity, const record::Trace& trace, const Options& options,
                const survey::Watch& watch);

}  // namespace verp::identify
