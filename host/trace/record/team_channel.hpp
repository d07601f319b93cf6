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

/// One of several robots: topics /ROBOT/topic, frames ROBOT/frame, except "world".
class TeamChannel {
 public:
  TeamChannel(std::string_view robot, std::string_view topic, const mcap::Schema& schema);
  TeamChannel(TeamChannel&&) noexcept;
  ~TeamChannel();

  const std::string& topic() const { return topic_; }
  /// A shared topic; its frames tell robots apart.
  bool is_of_all() const { return is_of_all_; }
  /// Renames a message's frames. nullopt: it is not of the channel's type.
  std::optional<std::string> message(std::string_view data) const;

 private:
  std::string topic_, prefix_;
  bool is_of_all_, is_description_;
  std::unique_ptr<ros::Definition> definition_;  ///< null: no frames
};

}  // namespace verp::record
