#pragma once
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/study/survey/workers.hpp"
#include "host/trace/record/trace.hpp"

/// What a recorded robot says of its servos: the numbers with which the twin, told the same, moves
/// as the robot did.
namespace verp::identify {

struct Options {
  std::string type;        ///< of the servos; empty: the only one that the robot has
  double held_out = 0.25;  ///< part of the recording, its last, that the fit never sees
};

struct Row {
  std::string name, unit, meaning;
  double was = 0, now = 0, error = 0;  ///< error: one standard deviation, of chance alone
  bool determined = false;             ///< the motion tells it; if not, it is as it was
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
  bool interrupted = false;  ///< then nothing else is known
  model::Servo servo;        ///< of that type, with the new numbers
};

/// Throws record::TraceError for a trace from which nothing can be told, model::LoadError for a
/// type that the robot has not.
Result identify(const model::Entity& entity, const record::Trace& trace, const Options& options,
                const survey::Watch& watch);

}  // namespace verp::identify
