#include "host/apps/demos/ball_demo.hpp"
#include "host/apps/demos/goal_demo.hpp"
#include "host/apps/demos/run.hpp"
#include "host/apps/demos/together.hpp"

namespace verp::demos {

const std::vector<Demo>& all_demos() {
  static const std::vector<Demo> demos = {column_demo(), follow_demo(), goal_demo(), ball_demo()};
  return demos;
}

}  // namespace verp::demos
