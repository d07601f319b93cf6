// tune [SECONDS]: changes a number of the gait and one of the physics during a walk.
#include <cstdio>
#include <cstdlib>

#include "host/apps/libverp/verp.hpp"

int main(int argc, char** argv) {
  verp_robot robot = verp_lib::Session::defaults();
  if (argc > 1) robot.walk_s = std::atof(argv[1]);
  verp_lib::Session session;
  session.add(robot);
  session.tick(400);
  session.tune("gait.lift_m", 0.015);
  session.set("trunk.mass_kg", 1.02 * session.read("trunk.mass_kg"));
  while (session.tick(100)) {
  }
  std::printf("lift %.4f m, trunk %.3f kg\n", session.tuning("gait.lift_m"),
              session.read("trunk.mass_kg"));
}
