#pragma once
#include <string>

#include "host/apps/tool/robot/action_words.hpp"

namespace verp::tool {

struct SendWords {
  std::string link;
  int id = -1;  ///< default: the controller on that link
};

/// `verp action send`, to a running controller. Returns the exit status.
int send_actions(const ActionWords& words, const SendWords& send);

}  // namespace verp::tool
