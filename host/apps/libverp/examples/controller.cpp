// controller [SECONDS]: a user's controller. It runs the robot's own controller and adds a nod of
// the head.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "host/apps/libverp/verp.hpp"

int main(int argc, char** argv) {
  constexpr std::uint32_t kHeadPitch = 1;  // of generic21: Core::joint_name()
  const verp_lib::Core core;
  verp_robot robot = verp_lib::Session::defaults();
  if (argc > 1) robot.walk_s = std::atof(argv[1]);
  verp_lib::Session session;
  session.add(robot);
  session.control([&](const verp_lib::Moment& moment) {
    moment.decide();
    const float up_rad = 0.3F * std::sin(0.05F * static_cast<float>(moment.inputs().tick));
    moment.outputs().goal_count[kHeadPitch] +=
        core.count(kHeadPitch, up_rad) - core.count(kHeadPitch, 0);
  });
  float most_rad = 0;
  while (session.tick()) most_rad = std::max(most_rad, session.seen().joint_rad[kHeadPitch]);
  std::printf("nodded by %.2f rad, body at %.2f m\n", static_cast<double>(most_rad),
              session.seen().truth.body_m[0]);
  return most_rad < 0.2F;
}
