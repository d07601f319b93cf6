"""record.py FILE [SECONDS]: records a walk, and replays it bit for bit."""

import sys

import verp

with verp.Session() as session:
    session.add(record=sys.argv[1], walk_s=float(sys.argv[2]) if len(sys.argv) > 2 else 20)
    while session.tick(100):
        pass
ticks, digest = verp.replay(sys.argv[1])
print(f"{ticks} ticks 0x{digest:016x}")
