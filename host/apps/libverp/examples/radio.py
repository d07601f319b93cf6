"""radio.py [TRACE.mcap]: two robots, one of which does what the other one tells it by radio. Both know nothing else of each
other."""

import sys

import verp

SPEED_M_S = 0.1
ORDERS = {b"stand": verp.STAND, b"walk": verp.WALK}


def obey(session: verp.Session, robot: int, order: bytes) -> None:
    session.command(ORDERS[order], SPEED_M_S if order == b"walk" else 0, robot=robot)


with verp.Session() as session:
    leader = session.add(walk_s=0, seed=1)
    follower = session.add(walk_s=0, seed=2, y_m=1.5, record=sys.argv[1] if len(sys.argv) > 1 else None)
    session.radio(loss=0.3, range_m=20)
    said = heard = 0
    next_s, doing = 0.0, b""
    while session.seen(leader)["time_s"] < 12:
        session.tick()
        now_s = session.seen(leader)["time_s"]
        wanted = b"walk" if 6 < now_s < 10 else b"stand"
        if wanted != doing:
            doing = wanted
            obey(session, leader, doing)
        if now_s >= next_s:  # repeated, because three in ten are lost
            next_s += 0.2
            said += session.send(doing, robot=leader)
        for sender, order in session.take(follower):
            heard += sender == leader
            obey(session, follower, order)
    ways_m = [session.seen(robot)["truth"]["body_m"][0] for robot in (leader, follower)]
    print(f"said {said}, heard {heard}; the leader walked {ways_m[0]:.2f} m, the other one {ways_m[1]:.2f} m")
sys.exit(not (0 < heard < said and ways_m[1] > 0.2))
