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
  int gait_cycles = 0;  ///< repeats of the gait's 16 states; 0: the joints as they moved
};

/// `verp action convert`: the file names decide the formats. Returns a one-line summary.
std::string convert_actions(const ActionWords& words, const ConvertWords& convert);

/// `verp action record`. Returns a one-line summary.
std::string record_action(const RecordWords& words);

/// `verp action export`: all of the robot's actions as the image for a board's flash. Returns a
/// one-line summary.
std::string export_actions(const ActionWords& words, const std::string& file);

}  // namespace verp::tool
