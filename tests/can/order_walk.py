#!/usr/bin/python3
"""order_walk.py INTERFACE VX WZ SECONDS: orders a walk of the controller's node, 127, by SDO.

It needs python3-can and host/guide/canopen.md. VX is in 0.1 mm/s, WZ in mrad/s. The controller is told to relax, which it
wants to hear first, to stand, and to walk; each order is repeated, as one that is older than half a second counts no more.
One JSON object on stdout says which modes it went through and how many steps' time it walked.
"""
import json
import sys
import time

from foreign_master import Master, Refused

CONTROLLER = 127
REQUEST, WALK_VX, WALK_WZ, MODE = 0x2050, 0x2052, 0x2056, 0x2090
RELAX, STAND, WALK = 0, 1, 2
STANDING, WALKING = 2, 3
REPEAT_S = 0.1
PATIENCE_S = 60


def order(master, request, modes, until):
    """Repeats the order until the mode is wanted, or for some seconds."""
    while not until(modes[-1]):
        master.write(CONTROLLER, REQUEST, 0, "B", request)
        mode = master.read(CONTROLLER, MODE, 0, "B")
        if mode != modes[-1]:
            modes.append(mode)
        time.sleep(REPEAT_S)


def main(interface, vx, wz, seconds):
    master = Master(interface)
    modes = [master.read(CONTROLLER, MODE, 0, "B")]
    late = time.monotonic() + PATIENCE_S

    def standing(mode):
        if time.monotonic() > late:
            raise Refused(f"it does not stand; its modes were {modes}")
        return mode == STANDING

    order(master, RELAX, modes, lambda mode: mode == 0)
    master.write(CONTROLLER, REQUEST, 0, "B", RELAX)
    order(master, STAND, modes, standing)
    master.write(CONTROLLER, WALK_VX, 0, "h", vx)
    master.write(CONTROLLER, WALK_WZ, 0, "h", wz)
    begin = time.monotonic()
    order(master, WALK, modes, lambda mode: time.monotonic() > begin + seconds)
    order(master, STAND, modes, standing)
    print(json.dumps({"modes": modes}))


if __name__ == "__main__":
    try:
        main(sys.argv[1], *map(int, sys.argv[2:5]))
    except Refused as error:
        sys.exit(f"order_walk.py: {error}")
