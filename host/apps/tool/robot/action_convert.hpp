#pragma once
#include <string>

#include "host/apps/tool/robot/action_words.hpp"
#include "host/author/action/record.hpp"

namespace verp::tool {

struct ConvertWords {
  std::string from, to;
};

struct RecordWords {
  std::string trace, file;
  action::RecordOptions options;
  int gait_cycles = 0;  ///< 0: the joints as they moved
};

/// `verp action convert`: file names decide the formats. These return a one-line summary.
std::string convert_actions(const ActionWords& words, const ConvertWords& convert);

std::string record_action(const RecordWords& words);

/// `verp action make lie_down`. `named`: the file; empty: among the robot's actions.
std::string make_lie_down(const ActionWords& words, const std::string& named);

/// `verp action export`: an image of all actions for a board's flash.
std::string export_actions(const ActionWords& words, const std::string& file);

}  // namespace verp::tool
