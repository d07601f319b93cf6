#pragma once
#include <string>

#include "host/apps/tool/action_words.hpp"
#include "host/author/action/record.hpp"

namespace verp::tool {

struct ConvertWords {
  std::string from, to;
};

struct RecordWords {
  std::string trace, file;
  action::RecordOptions options;
  int gait_cycles = 0;  ///< 0: the joints, whatever they did
};

/// `verp action convert`: what is read and written follows from the names. Returns what was
/// written, in a line.
std::string convert_actions(const ActionWords& words, const ConvertWords& convert);

/// `verp action record`. Returns what was written, in a line.
std::string record_action(const RecordWords& words);

/// `verp action export`: all of the robot's actions as a board keeps them. Returns what was
/// written, in a line.
std::string export_actions(const ActionWords& words, const std::string& file);

}  // namespace verp::tool
