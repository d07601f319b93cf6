#!/usr/bin/python3
"""poller.py: reads the mode of the controller's node, 127, by its default SDO on vcan0, until it is told to end.

One JSON object on stdout: how many reads there were, and how many brought another object's answer, or none in a second.
"""
import json
import signal
import struct
import time

import can

CONTROLLER, MODE = 127, 0x2090


def main():
    bus = can.Bus(interface="socketcan", channel="vcan0",
                  can_filters=[{"can_id": 0x580 + CONTROLLER, "can_mask": 0x7FF}])
    counts = {"good": 0, "wrong": 0, "silent": 0}
    going = [True]
    signal.signal(signal.SIGTERM, lambda *_: going.clear())
    while going:
        request = struct.pack("<BHBI", 0x40, MODE, 0, 0)
        bus.send(can.Message(arbitration_id=0x600 + CONTROLLER, data=request, is_extended_id=False))
        answer = bus.recv(1.0)
        if answer is None:
            counts["silent"] += 1
        else:
            counts["good" if answer.data[:4] == struct.pack("<BHB", 0x4F, MODE, 0) else "wrong"] += 1
        time.sleep(0.02)
    print(json.dumps(counts))


main()
