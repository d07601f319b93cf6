// radio [TRACE.mcap]: one robot sends orders by radio and the other obeys them; they share nothing
// else.
#include <cstdio>
#include <string>

#include "host/apps/libverp/verp.hpp"

namespace {

void obey(verp_lib::Session& session, std::uint32_t robot, const std::string& order) {
  const bool walks = order == "walk";
  session.command(walks ? VERP_WALK : VERP_STAND, walks ? 0.1 : 0, 0, 0, robot);
}

}  // namespace

int main(int argc, char** argv) {
  verp_lib::Session session;
  verp_robot robot = verp_lib::Session::defaults();
  robot.walk_s = 0;
  const std::uint32_t leader = session.add(robot);
  robot.seed = 2;
  robot.y_m = 1.5;
  if (argc > 1) robot.record = argv[1];
  const std::uint32_t follower = session.add(robot);
  verp_radio radio = verp_lib::Session::radio_defaults();
  radio.loss = 0.3;
  radio.range_m = 20;
  session.radio(radio);
  int said = 0, heard = 0;
  double next_s = 0;
  std::string doing;
  while (session.seen(leader).time_s < 12) {
    session.tick();
    const double now_s = session.seen(leader).time_s;
    const std::string wanted = now_s > 6 && now_s < 10 ? "walk" : "stand";
    if (wanted != doing) obey(session, leader, doing = wanted);
    if (now_s >= next_s) {  // repeated, because three in ten are lost
      next_s += 0.2;
      said += session.send(leader, doing);
    }
    while (const auto order = session.take(follower)) {
      heard += order->from == leader;
      obey(session, follower, order->data);
    }
  }
  const double far_m = session.seen(leader).truth.body_m[0];
  const double follows_m = session.seen(follower).truth.body_m[0];
  std::printf("said %d, heard %d; the leader walked %.2f m, the other one %.2f m\n", said, heard,
              far_m, follows_m);
  return !(0 < heard && heard < said && follows_m > 0.2);
}
