#!/usr/bin/python3
"""cia402_start.py INTERFACE NODE: what a ready-made CiA 402 master does, and relies on, with the drive NODE.

It needs python3-can, CiA 301 and CiA 402. It never looks at a statusword but in TPDO 1, as the drive sends it by itself:
after a reset and a start, after each controlword in RPDO 1, and when it starts again from pre-operational. Then it falls
silent as a master, stops the drive, and stores and restores its settings. Before, it moves the joint in profile position
mode and makes that place home, as set-up tools do. One JSON object on stdout says what it saw.
"""
import json
import struct
import sys
import time

from foreign_master import PATIENCE_S, Master, Refused

OWN_NODE = 5
WATCH_MS = 200


def state(answer):
    """The statusword's state bits."""
    if answer is None:
        raise Refused("no TPDO 1 came")
    return struct.unpack("<H", answer[:2])[0] & 0x6F


def nmt(master, command, node):
    master.send(0x000, [command, node])


def reset(master, node):
    nmt(master, 0x81, node)
    while (told := master.hear(0x700 + node)) != b"\0":  # earlier heartbeats
        if told is None:
            raise Refused("no boot-up message")


def started(master, node):
    nmt(master, 0x01, node)
    return state(master.hear(0x180 + node))


def start_up(master, node):
    """The states that TPDO 1 tells, by default PDOs alone but for the mode."""
    reset(master, node)
    seen = [started(master, node)]
    master.write(node, 0x6060, 0, "b", 8)
    for word, wanted in ((0x06, 0x21), (0x07, 0x23), (0x0F, 0x27)):
        master.send(0x200 + node, struct.pack("<H", word))
        while state(answer := master.hear(0x180 + node)) != wanted:
            pass
        seen.append(state(answer))
    return seen


def start_again(master, node):
    nmt(master, 0x80, node)
    return started(master, node)


def await_bits(master, node, bits):
    """The statusword's mode bits 10, 12 and 13, once all of `bits` are set."""
    end = time.monotonic() + PATIENCE_S
    while (word := master.read(node, 0x6041, 0, "H")) & bits != bits:
        if time.monotonic() > end:
            raise Refused(f"statusword {word:04X}h, without {bits:04X}h")
    return word & 0x3400


def set_point(master, node, move):
    """Profile position mode: bit 4 until the drive acknowledges with bit 12, then until bit 10 says that it is there."""
    master.write(node, 0x6060, 0, "b", 1)
    start = master.read(node, 0x6064, 0, "i")
    for index, value in ((0x6081, 2000), (0x6083, 20000), (0x6084, 20000), (0x6067, 40)):
        master.write(node, index, 0, "I", value)
    master.write(node, 0x607A, 0, "i", start + move)
    master.write(node, 0x6040, 0, "H", 0x1F)
    taken = await_bits(master, node, 0x1000)
    master.write(node, 0x6040, 0, "H", 0x0F)
    await_bits(master, node, 0x0400)
    return {"taken": taken, "moved": master.read(node, 0x6064, 0, "i") - start}


def home(master, node):
    """Homing mode, method 37: here. Method 1 needs a switch."""
    master.write(node, 0x6060, 0, "b", 6)
    try:
        master.write(node, 0x6098, 0, "b", 1)
        refused = False
    except Refused:
        refused = True
    master.write(node, 0x6098, 0, "b", 37)
    before = await_bits(master, node, 0)
    master.write(node, 0x6040, 0, "H", 0x1F)
    after = await_bits(master, node, 0x1000)
    position = master.read(node, 0x6064, 0, "i")
    master.write(node, 0x6040, 0, "H", 0x0F)
    master.write(node, 0x6060, 0, "b", 8)
    return {"refused": refused, "before": before, "after": after, "position": position}


def beat(master, times):
    for _ in range(times):
        master.send(0x700 + OWN_NODE, [5])
        time.sleep(0.02)


def fall_silent(master, node):
    """The drive, with torque, watches its master; what it says when that is gone."""
    master.write(node, 0x1017, 0, "H", 20)
    master.write(node, 0x1016, 1, "I", OWN_NODE << 16 | WATCH_MS)
    beat(master, 3)
    emergency = master.hear(0x080 + node)
    while (told := master.hear(0x700 + node)) == b"\x05":
        pass
    return {
        "emergency": emergency.hex(),
        "state": told.hex(),
        "statusword": master.read(node, 0x6041, 0, "H") & 0x6F,
        "error_register": master.read(node, 0x1001, 0, "B"),
        "error_code": master.read(node, 0x603F, 0, "H"),
    }


def stop_idle(master, node):
    reset(master, node)
    nmt(master, 0x02, node)
    return started(master, node)


def store(master, node):
    """Max torque: as it was, as it was stored, and as it is when defaults are restored; each after a reset."""
    seen = [master.read(node, 0x6072, 0, "H")]
    master.write(node, 0x6072, 0, "H", 700)
    master.write(node, 0x1010, 1, "I", int.from_bytes(b"save", "little"))
    reset(master, node)
    seen.append(master.read(node, 0x6072, 0, "H"))
    master.write(node, 0x1011, 1, "I", int.from_bytes(b"load", "little"))
    reset(master, node)
    seen.append(master.read(node, 0x6072, 0, "H"))
    return seen


def main(interface, node):
    master = Master(interface)
    first = master.read(node, 0x1000, 0, "I")  # the twin's first frame
    print(json.dumps({
        "first": first,
        "start_up": start_up(master, node),
        "again": start_again(master, node),
        "modes": master.read(node, 0x6502, 0, "I"),
        "set_point": set_point(master, node, 400),
        "home": home(master, node),
        "silent": fall_silent(master, node),
        "stopped": stop_idle(master, node),
        "stored": store(master, node),
        "increments": master.read(node, 0x608F, 1, "I"),
        "rated_ma": master.read(node, 0x6075, 0, "I"),
        "rated_mn_m": master.read(node, 0x6076, 0, "I"),
    }))


if __name__ == "__main__":
    try:
        main(sys.argv[1], int(sys.argv[2]))
    except Refused as error:
        sys.exit(f"cia402_start.py: {error}")
