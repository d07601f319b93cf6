#pragma once
#include <string>

#include "host/apps/tool/action_words.hpp"

namespace verp::tool {

struct SendWords {
  std::string link;
  int id = -1;  ///< unless it is given, the controller's on that link
};

/// `verp action send`: all of the robot's actions to a controller that runs. Exit status.
int send_actions(const ActionWords& words, const SendWords& send);

}  // namespace verp::tool
