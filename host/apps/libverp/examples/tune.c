/* tune [SECONDS]: changes a number of the gait and one of the physics during a walk. */
#include "host/apps/libverp/examples/check.h"

int main(int argc, char** argv) {
  verp_session session;
  verp_robot robot;
  double lift_m, mass_kg;
  check(verp_robot_defaults(&robot));
  if (argc > 1) robot.walk_s = atof(argv[1]);
  check(verp_session_open(NULL, &session));
  check(verp_session_add(session, &robot, NULL));
  check(verp_session_tick(session, 400, NULL, NULL));
  check(verp_session_tune(session, 0, "gait.lift_m", 0.015));
  check(verp_session_read(session, "trunk.mass_kg", &mass_kg));
  check(verp_session_set(session, "trunk.mass_kg", 1.02 * mass_kg));
  while (check(verp_session_tick(session, 100, NULL, NULL)) == VERP_OK) {
  }
  check(verp_session_tuning(session, 0, "gait.lift_m", &lift_m));
  check(verp_session_read(session, "trunk.mass_kg", &mass_kg));
  printf("lift %.4f m, trunk %.3f kg\n", lift_m, mass_kg);
  check(verp_session_close(session));
  return 0;
}
