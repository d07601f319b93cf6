#include "host/demos/ball_demo.hpp"
#include "host/demos/goal_demo.hpp"
#include "host/demos/run.hpp"
#include "host/demos/together.hpp"

namespace verp::demos {

const std::vector<Demo>& all_demos() {
  static const std::vector<Demo> demos = {column_demo(), follow_demo(), goal_demo(), ball_demo()};
  return demos;
}

}  // namespace verp::demos
