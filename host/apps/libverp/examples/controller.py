"""controller.py [SECONDS]: a controller of one's own in place of the robot's. This one has the robot's own decide, and
adds a nod of the head to it."""

import math
import sys

import verp

core = verp.Core()
pitch = core.joint_names.index("head_pitch")


def nod(moment: verp.Moment) -> None:
    moment.decide()
    up_rad = 0.3 * math.sin(0.05 * moment.inputs["tick"][0])
    moment.outputs["goal_count"][0, pitch] += core.count(pitch, up_rad) - core.count(pitch, 0)


with verp.Session() as session:
    session.add(walk_s=float(sys.argv[1]) if len(sys.argv) > 1 else 20)
    session.control(nod)
    most_rad = max(float(seen["joint_rad"][pitch]) for seen in session)
    print(f"nodded by {most_rad:.2f} rad, body at {session.seen()['truth']['body_m'][0]:.2f} m")
sys.exit(most_rad < 0.2)
