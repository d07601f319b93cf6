/* controller [SECONDS]: a user's controller. It runs the robot's own controller and adds a nod of
 * the head. */
#include <math.h>

#include "host/apps/libverp/examples/check.h"

enum { kHeadPitch = 1 }; /* of generic21: verp_core_joint_name() */

static int nod(const verp_moment* moment, void* user) {
  const verp_core core = user;
  int32_t zero, up;
  check(verp_decide(moment->token));
  check(verp_core_count(core, kHeadPitch, 0.0F, &zero));
  check(verp_core_count(core, kHeadPitch, 0.3F * sinf(0.05F * (float)moment->inputs->tick), &up));
  moment->outputs->goal_count[kHeadPitch] += up - zero;
  return 0;
}

int main(int argc, char** argv) {
  verp_session session;
  verp_core core;
  verp_robot robot;
  verp_tick seen = {.size = sizeof seen};
  float most_rad = 0;
  check(verp_core_open("generic21", NULL, NULL, &core));
  check(verp_robot_defaults(&robot));
  if (argc > 1) robot.walk_s = atof(argv[1]);
  check(verp_session_open(NULL, &session));
  check(verp_session_add(session, &robot, NULL));
  check(verp_session_view(session, 0, &seen));
  check(verp_session_control(session, 0, nod, core));
  while (check(verp_session_tick(session, 1, NULL, NULL)) == VERP_OK) {
    most_rad = fmaxf(most_rad, seen.joint_rad[kHeadPitch]);
  }
  printf("nodded by %.2f rad, body at %.2f m\n", most_rad, seen.truth.body_m[0]);
  check(verp_session_close(session));
  check(verp_core_close(core));
  return most_rad < 0.2F;
}
