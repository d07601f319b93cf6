#!/usr/bin/env python3
"""outside.py SOCKET ROLE [SECONDS]: a robot of `verp walk` driven from outside, by the standard library alone. It holds its servos where
they are, turns its head, and talks by radio: the `leader` says where it looks, a `follower` looks there, too.

    ./verp walk --robot a=ext:unix-listen:a.sock --robot b=ext:unix-listen:b.sock --for 3 --radio 'loss=0.3'
    python3 host/twin/radio/examples/outside.py a.sock leader
    python3 host/twin/radio/examples/outside.py b.sock follower

All is Dynamixel Protocol 2.0: servos, the modem (device 202: host/twin/bus/modem_device.hpp has its registers), and the twin's clock
(device 201: firmware/app/lockstep_messages.hpp), which is asked for each piece of time."""

import socket
import struct
import sys
import time

READ, WRITE, SYNC_READ, SYNC_WRITE = 2, 3, 0x82, 0x83
CLOCK, MODEM, ALL, HEAD = 201, 202, 0xFE, 19
SERVOS = range(1, 22)
DELAY, TORQUE, GOAL, POSITION = 9, 64, 116, 132
TO, WAITING, TAKE, EVERYBODY = 272, 384, 488, 255
LOOKS = {b"left": 400, b"right": -400}  # counts of 4096


def crc16(data):
    crc = 0
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x8005 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def packet(device, instruction, parameters):
    body = (bytes([instruction]) + parameters).replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
    head = b"\xff\xff\xfd\x00" + struct.pack("<BH", device, len(body) + 2) + body
    return head + struct.pack("<H", crc16(head))


def write(device, address, data):
    return packet(device, WRITE, struct.pack("<H", address) + data)


def answers(raw):
    """(device, error, data) of each status packet."""
    found = []
    while len(raw) > 10:
        size = 7 + struct.unpack_from("<H", raw, 5)[0]
        body = raw[8:size - 2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
        found.append((raw[4], body[0], body[1:]))
        raw = raw[size:]
    return found


class Twin:
    def __init__(self, path):
        self.link = socket.socket(socket.AF_UNIX)
        while self.link.connect_ex(path):
            time.sleep(0.05)
        self.rest, self.sequence, self.now_s, self.over = b"", 0, 0.0, False
        # Hello: version 1 of the link; this controller has no VERP core.
        self.link.sendall(write(CLOCK, 64, struct.pack("<B23x", 1)))
        if self.clock()[1][1] != 0:
            sys.exit("the twin refuses this controller")

    def clock(self):
        """What the bus brought, and then what the clock says."""
        while True:
            at = self.rest.find(b"\xff\xff\xfd\x00" + bytes([CLOCK]))
            size = 7 + struct.unpack_from("<H", self.rest, at + 5)[0] if 0 <= at < len(self.rest) - 6 else 0
            if size and len(self.rest) >= at + size:
                brought, said, self.rest = self.rest[:at], self.rest[at:at + size], self.rest[at + size:]
                return brought, answers(said)[0][2]
            more = self.link.recv(4096)
            if not more:
                sys.exit("the twin hung up")
            self.rest += more

    def ask(self, frames, timeout_us=5000):
        """Puts frames on the bus; what it brings until the time is over."""
        self.sequence = (self.sequence + 1) % 256
        asks = struct.pack("<BBHIHH", self.sequence, 0, 512, timeout_us, len(frames), crc16(frames))
        self.link.sendall(frames + write(CLOCK, 96, asks))
        brought, said = self.clock()
        self.now_s = 1e-6 * struct.unpack_from("<Q", said)[0]
        self.over = said[9] & 1 != 0
        return answers(brought)

    def tick(self):
        """The next control period begins with this read. Positions, by servo."""
        wanted = struct.pack("<HH", POSITION, 4) + bytes(SERVOS)
        return {servo: struct.unpack("<i", data)[0] for servo, _, data in self.ask(packet(ALL, SYNC_READ, wanted))}

    def write_all(self, address, size, values):
        each = b"".join(bytes([servo]) + value.to_bytes(size, "little", signed=True) for servo, value in values.items())
        self.ask(packet(ALL, SYNC_WRITE, struct.pack("<HH", address, size) + each), 0)

    def say(self, message):
        return self.ask(write(MODEM, TO, bytes([EVERYBODY, len(message)]) + message))[0][1]

    def heard(self):
        """(from, message), or None."""
        (_, _, data), = self.ask(packet(MODEM, READ, struct.pack("<HH", WAITING, 100)))
        waiting, number, sender, size = data[:4]
        if waiting == 0:
            return None
        self.ask(write(MODEM, TAKE, bytes([number])))
        return sender, bytes(data[4:4 + size])


twin, leads = Twin(sys.argv[1]), sys.argv[2] == "leader"
twin.write_all(DELAY, 1, dict.fromkeys(SERVOS, 0))  # answer at once: a tick has 10 ms
goals = twin.tick()
middle, says, talks = goals[HEAD], b"left", 0
twin.write_all(GOAL, 4, goals)
twin.write_all(TORQUE, 1, dict.fromkeys(SERVOS, 1))
for tick in range(int(100 * float(sys.argv[3])) if len(sys.argv) > 3 else 10**6):
    twin.tick()
    if twin.over:
        break
    if leads and tick % 10 == 0:  # repeated: some are lost
        says = b"left" if tick // 50 % 2 == 0 else b"right"
        talks += twin.say(says) == 0
    elif not leads and (message := twin.heard()):
        says, talks = message[1], talks + 1
        print(f"{twin.now_s:.3f} s: {message[0]} says {says.decode()}")
    goals[HEAD] = middle + LOOKS[says]
    twin.write_all(GOAL, 4, goals)
twin.write_all(TORQUE, 1, dict.fromkeys(SERVOS, 0))  # torque off; disconnecting ends the run
print(f"{sys.argv[2]}: {talks} messages")
sys.exit(talks == 0)
