#!/usr/bin/python3
"""foreign_master.py INTERFACE NODE: a CANopen master that knows nothing of this project.

It needs python3-can and what host/guide/canopen.md says of the bytes. It starts all drives that it finds, moves the joint
of drive NODE with PDOs, reads it back, provokes a following error and resets it, and lets go. One JSON object on stdout
says what it saw.
"""
import json
import struct
import sys
import time

import can

DRIVE = 0x192  # CiA 402, low half of 1000h
MOVE = 400  # increments
STEPS = 40
STEP_S = 0.01
PATIENCE_S = 20  # for a busy PC


class Refused(Exception):
    pass


class Master:
    def __init__(self, interface):
        self.bus = can.Bus(interface="socketcan", channel=interface)

    def send(self, cob_id, data):
        self.bus.send(can.Message(arbitration_id=cob_id, data=data, is_extended_id=False))

    def hear(self, cob_id):
        """The next message with this identifier, or None."""
        end = time.monotonic() + PATIENCE_S
        while (left := end - time.monotonic()) > 0:
            message = self.bus.recv(left)
            if message is not None and not message.is_extended_id and message.arbitration_id == cob_id:
                return bytes(message.data)
        return None

    def boot(self):
        """Nodes that say 700h + node, 00h: after 000h with 81h, reset, and 0, all. They say it within a second."""
        self.send(0x000, [0x81, 0])
        nodes = set()
        message = self.bus.recv(PATIENCE_S)
        while message is not None:
            if message.arbitration_id >> 7 == 0xE and bytes(message.data) == b"\0":
                nodes.add(message.arbitration_id & 0x7F)
            message = self.bus.recv(1.0)
        return sorted(nodes)

    def sdo(self, node, request):
        self.send(0x600 + node, request)
        answer = self.hear(0x580 + node)
        if answer is None:
            raise Refused(f"node {node} does not answer {request.hex()}")
        if answer[0] == 0x80:
            raise Refused(f"node {node} aborts {request.hex()}: {answer[4:].hex()}")
        return answer

    def write(self, node, index, sub, form, value):
        """Expedited download: 2Fh for 1 byte, 2Bh for 2, 23h for 4."""
        data = struct.pack("<" + form, value)
        command = {1: 0x2F, 2: 0x2B, 4: 0x23}[len(data)]
        self.sdo(node, struct.pack("<BHB", command, index, sub) + data.ljust(4, b"\0"))

    def read(self, node, index, sub, form):
        """Expedited upload: 40h; 4Fh, 4Bh or 43h bring 1, 2 or 4 bytes."""
        answer = self.sdo(node, struct.pack("<BHBI", 0x40, index, sub, 0))
        size = {0x4F: 1, 0x4B: 2, 0x43: 4}[answer[0]]
        return struct.unpack("<" + form, answer[4 : 4 + size])[0]

    def map_pdo(self, communication, node, cob_id, kind, objects):
        """Off, no entries, the entries, their number, the type, on."""
        entries = communication + 0x200
        self.write(node, communication, 1, "I", 0x80000000 | cob_id)
        self.write(node, entries, 0, "B", 0)
        for number, each in enumerate(objects, 1):
            self.write(node, entries, number, "I", each)
        self.write(node, entries, 0, "B", len(objects))
        self.write(node, communication, 2, "B", kind)
        self.write(node, communication, 1, "I", cob_id)


def power_up(master, drives):
    for node in drives:
        master.write(node, 0x6060, 0, "b", 8)
        for word in (0x06, 0x07):
            master.write(node, 0x6040, 0, "H", word)
    for node in drives:
        master.write(node, 0x6040, 0, "H", 0x0F)
    return [node for node in drives if master.read(node, 0x6041, 0, "H") & 0x6F != 0x27]


def move(master, node):
    """Targets by RPDO 1, positions by TPDO 1, which answers each SYNC."""
    start = master.read(node, 0x6064, 0, "i")
    master.map_pdo(0x1400, node, 0x200 + node, 255, [0x607A0020])
    master.map_pdo(0x1800, node, 0x180 + node, 1, [0x60410010, 0x60640020])
    master.send(0x000, [0x01, node])
    seen = []
    for step in range(1, STEPS + 1):
        master.send(0x200 + node, struct.pack("<i", start + MOVE * step // STEPS))
        time.sleep(STEP_S)
        master.send(0x080, [])
        answer = master.hear(0x180 + node)
        seen.append(struct.unpack("<Hi", answer)[1])
    end = time.monotonic() + PATIENCE_S
    while True:
        position = master.read(node, 0x6064, 0, "i")
        if abs(position - start - MOVE) <= MOVE // 10 or time.monotonic() > end:
            return start, seen, position


def fall_behind(master, node, position):
    """A target far away, and a following error window of 200 increments: an emergency."""
    master.write(node, 0x6066, 0, "H", 0)
    master.write(node, 0x6065, 0, "I", 200)
    master.send(0x200 + node, struct.pack("<i", position + 2000))
    emergency = master.hear(0x080 + node)
    faulty = master.read(node, 0x6041, 0, "H")
    code = master.read(node, 0x603F, 0, "H")
    master.write(node, 0x6040, 0, "H", 0x00)
    master.write(node, 0x6040, 0, "H", 0x80)
    return {
        "emergency": emergency.hex(),
        "statusword": faulty,
        "error_code": code,
        "after_reset": master.read(node, 0x6041, 0, "H"),
    }


def main(interface, node):
    master = Master(interface)
    nodes = master.boot()
    drives = [each for each in nodes if master.read(each, 0x1000, 0, "I") & 0xFFFF == DRIVE]
    idle = power_up(master, drives)
    master.write(node, 0x1017, 0, "H", 50)
    beat = master.hear(0x700 + node)
    start, seen, position = move(master, node)
    fault = fall_behind(master, node, position)
    for each in drives:
        master.write(each, 0x6040, 0, "H", 0x00)
    print(json.dumps({
        "nodes": nodes, "drives": drives, "without_torque": idle, "heartbeat": beat.hex(), "start": start,
        "target": start + MOVE, "seen": seen, "position": position, "fault": fault,
    }))


if __name__ == "__main__":
    try:
        main(sys.argv[1], int(sys.argv[2]))
    except Refused as error:
        sys.exit(f"foreign_master.py: {error}")
