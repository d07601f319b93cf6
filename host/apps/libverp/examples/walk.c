/* walk [SECONDS]: the walk of `verp walk`, and its digest. */
#include "host/apps/libverp/examples/check.h"

int main(int argc, char** argv) {
  verp_session session;
  verp_robot robot;
  verp_result result = {.size = sizeof result};
  check(verp_robot_defaults(&robot));
  if (argc > 1) robot.walk_s = atof(argv[1]);
  check(verp_session_open(NULL, &session));
  check(verp_session_add(session, &robot, NULL));
  while (check(verp_session_tick(session, 100, NULL, NULL)) == VERP_OK) {
  }
  check(verp_session_result(session, 0, &result));
  printf("%.2f m 0x%016" PRIx64 "\n", result.distance_m, result.digest);
  check(verp_session_close(session));
  return result.failure[0] != '\0';
}
