/* radio [TRACE.mcap]: one robot sends orders by radio and the other obeys them; they share nothing
 * else. */
#include <string.h>

#include "host/apps/libverp/examples/check.h"

static void obey(verp_session session, uint32_t robot, const char* order) {
  const int walks = strcmp(order, "walk") == 0;
  const double speed_m_s = walks ? 0.1 : 0;
  check(
      verp_session_command(session, robot, walks ? VERP_WALK : VERP_STAND, speed_m_s, 0, 0, 0, 0));
}

static void give_radios(verp_session session) {
  verp_radio radio;
  check(verp_radio_defaults(&radio));
  radio.loss = 0.3;
  radio.range_m = 20;
  check(verp_session_radio(session, &radio));
}

int main(int argc, char** argv) {
  enum { kLeader, kFollower };
  verp_session session;
  verp_robot robot;
  verp_tick seen[2] = {{.size = sizeof(verp_tick)}, {.size = sizeof(verp_tick)}};
  const char* doing = "";
  double next_s = 0;
  int said = 0, heard = 0;
  check(verp_session_open(NULL, &session));
  check(verp_robot_defaults(&robot));
  robot.walk_s = 0;
  check(verp_session_add(session, &robot, NULL));
  robot.seed = 2;
  robot.y_m = 1.5;
  if (argc > 1) robot.record = argv[1];
  check(verp_session_add(session, &robot, NULL));
  give_radios(session);
  check(verp_session_view(session, kLeader, &seen[kLeader]));
  check(verp_session_view(session, kFollower, &seen[kFollower]));
  while (seen[kLeader].time_s < 12) {
    char order[97];
    uint64_t size;
    uint32_t sender;
    check(verp_session_tick(session, 1, NULL, NULL));
    const double now_s = seen[kLeader].time_s;
    const char* wanted = now_s > 6 && now_s < 10 ? "walk" : "stand";
    if (strcmp(wanted, doing) != 0) obey(session, kLeader, doing = wanted);
    if (now_s >= next_s) { /* again and again: three in ten are lost */
      next_s += 0.2;
      said += check(verp_session_send(session, kLeader, VERP_EVERYBODY, doing, strlen(doing))) ==
              VERP_OK;
    }
    while (check(verp_session_take(session, kFollower, order, sizeof order - 1, &size, &sender)) ==
           VERP_OK) {
      order[size] = '\0';
      heard += sender == kLeader;
      obey(session, kFollower, order);
    }
  }
  const double far_m = seen[kLeader].truth.body_m[0], follows_m = seen[kFollower].truth.body_m[0];
  printf("said %d, heard %d; the leader walked %.2f m, the other one %.2f m\n", said, heard, far_m,
         follows_m);
  check(verp_session_close(session));
  return !(0 < heard && heard < said && follows_m > 0.2);
}
