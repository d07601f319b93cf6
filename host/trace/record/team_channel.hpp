#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "host/trace/record/mcap_format.hpp"

namespace verp::record {

namespace ros {
class Definition;
}

/// One robot's channel where several robots' stand together: below /ROBOT, with its frames as
/// ROBOT/frame, and "world" left as it is.
class TeamChannel {
 public:
  TeamChannel(std::string_view robot, std::string_view topic, const mcap::Schema& schema);
  TeamChannel(TeamChannel&&) noexcept;
  ~TeamChannel();

  const std::string& topic() const { return topic_; }
  /// There is one channel of that topic, whose messages tell by their frames of whom they are.
  bool is_of_all() const { return is_of_all_; }
  /// A message of the robot's, as it stands there. Nothing: it is none of its type.
  std::optional<std::string> message(std::string_view data) const;

 private:
  std::string topic_, prefix_;
  bool is_of_all_, is_description_;
  std::unique_ptr<ros::Definition> definition_;  ///< null: there are no frames to rename
};

}  // namespace verp::record
