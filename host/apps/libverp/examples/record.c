/* record FILE [SECONDS]: records a walk, and replays it bit for bit. */
#include "host/apps/libverp/examples/check.h"

int main(int argc, char** argv) {
  verp_session session;
  verp_robot robot;
  uint64_t ticks, digest;
  if (argc < 2) return fprintf(stderr, "usage: record FILE [SECONDS]\n"), 2;
  check(verp_robot_defaults(&robot));
  robot.record = argv[1];
  if (argc > 2) robot.walk_s = atof(argv[2]);
  check(verp_session_open(NULL, &session));
  check(verp_session_add(session, &robot, NULL));
  while (check(verp_session_tick(session, 100, NULL, NULL)) == VERP_OK) {
  }
  check(verp_session_close(session)); /* the file becomes whole */
  if (check(verp_replay(argv[1], &ticks, &digest)) != VERP_OK) return 1;
  printf("%" PRIu64 " ticks 0x%016" PRIx64 "\n", ticks, digest);
  return 0;
}
