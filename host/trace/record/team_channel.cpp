#include "host/trace/record/team_channel.hpp"

#include "host/trace/record/ros_frames.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {
namespace {

bool tells_whose_it_is(std::string_view topic) {
  return topic == "/tf" || topic == "/tf_static" || topic == kObjectsTopic;
}

}  // namespace

TeamChannel::TeamChannel(std::string_view robot, std::string_view topic, const mcap::Schema& schema)
    : topic_(topic),
      prefix_(std::string(robot) + "/"),
      is_of_all_(tells_whose_it_is(topic)),
      is_description_(topic == "/robot_description") {
  if (!is_of_all_) topic_ = "/" + std::string(robot) + topic_;
  if (schema.encoding == "ros2msg" && topic != kObjectsTopic)
    definition_ = std::make_unique<ros::Definition>(schema.data);
}

TeamChannel::TeamChannel(TeamChannel&&) noexcept = default;
TeamChannel::~TeamChannel() = default;

std::optional<std::string> TeamChannel::message(std::string_view data) const {
  if (definition_ == nullptr) return std::string(data);
  auto renamed = definition_->with_frames(data, prefix_);
  if (renamed && is_description_)
    renamed = ros::string(ros::urdf_with_links(ros::read_string(data).value_or(""), prefix_));
  return renamed;
}

}  // namespace verp::record
