"""tune.py [SECONDS]: a number of the gait is changed while the robot walks, and one of the physics."""

import sys

import verp

with verp.Session() as session:
    session.add(walk_s=float(sys.argv[1]) if len(sys.argv) > 1 else 20)
    session.tick(400)
    session.tune("gait.lift_m", 0.015)
    session.set("trunk.mass_kg", 1.02 * session.read("trunk.mass_kg"))
    while session.tick(100):
        pass
    print(f"lift {session.tuning('gait.lift_m'):.4f} m, trunk {session.read('trunk.mass_kg'):.3f} kg")
