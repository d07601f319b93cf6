"""walk.py [SECONDS]: the walk of `verp walk`, and its digest."""

import sys

import verp

with verp.Session() as session:
    session.add(walk_s=float(sys.argv[1]) if len(sys.argv) > 1 else 20)
    while session.tick(100):
        pass
    result = session.result()
print(f"{result.distance_m:.2f} m 0x{result.digest:016x}")
sys.exit(result.failure != "")
