"""camera.py FILE.ppm [SECONDS]: writes what the robot sees at the end of a walk through a room, and has a picture made of
it there."""

import sys
from pathlib import Path

import verp

with verp.Session("demo") as session:
    session.add(walk_s=float(sys.argv[2]) if len(sys.argv) > 2 else 20)
    while session.tick(100):
        pass
    camera = session.cameras()[0]
    seen = session.picture()
    outside = session.render("follow", width=320, height=240)
print(
    f"{camera.name}: {camera.width}x{camera.height} at {seen.time_s:.2f} s, "
    f"mean {seen.pixels.mean():.1f}; from outside {outside.mean():.1f}"
)
Path(sys.argv[1]).write_bytes(f"P6\n{camera.width} {camera.height}\n255\n".encode() + seen.pixels.tobytes())
