#!/usr/bin/env python3
"""Somebody else's Dynamixel software, in the standard library alone: it shares nothing with this project.

    foreign_client.py VERP CASE

starts `VERP hil generic21 --link pty:...` in this folder and plays CASE over the pseudo-terminal. What is sent stands in
ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0" and "XM430-W210", or follows from it. Status 0: all was as it is there.
"""
import json
import os
import select
import subprocess
import sys
import termios
import time

PING, READ, WRITE, FACTORY_RESET, REBOOT, BACKUP = 1, 2, 3, 6, 8, 0x20
SYNC_READ, SYNC_WRITE, STATUS, BROADCAST = 0x82, 0x83, 0x55, 0xFE
RATES = {57600: termios.B57600, 1000000: termios.B1000000, 2000000: termios.B2000000}


def crc16(data):
    crc = 0
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x8005 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def packet(device, instruction, parameters=b""):
    body, run = bytearray(), b""
    for byte in bytes([instruction]) + bytes(parameters):
        body.append(byte)
        run = (run + bytes([byte]))[-3:]
        if run == b"\xff\xff\xfd":
            body.append(0xFD)
    head = b"\xff\xff\xfd\x00" + bytes([device]) + (len(body) + 2).to_bytes(2, "little")
    return head + body + crc16(head + body).to_bytes(2, "little")


def number(value, size):
    return (value & (1 << 8 * size) - 1).to_bytes(size, "little")


class Status:
    def __init__(self, device, error, data):
        self.device, self.error, self.data = device, error, data

    def value(self, signed=True):
        return int.from_bytes(self.data, "little", signed=signed)


def statuses(raw):
    """The whole status packets in `raw`, and what is left of it; what is damaged is passed over."""
    found = []
    while True:
        at = raw.find(b"\xff\xff\xfd\x00")
        if at < 0:
            return found, raw[-3:]
        raw = raw[at:]
        size = 7 + int.from_bytes(raw[5:7], "little") if len(raw) >= 7 else 7
        if len(raw) < size and b"\xff\xff\xfd\x00" not in raw[1:]:
            return found, raw
        whole = raw[:size]
        if len(whole) < size or size < 11 or crc16(whole[:-2]) != int.from_bytes(whole[-2:], "little"):
            raw = raw[1:]
            continue
        raw = raw[size:]
        assert whole[7] == STATUS, whole.hex()
        body = whole[8:-2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
        found.append(Status(whole[4], body[0], body[1:]))


class Port:
    def __init__(self, path, baud=2000000):
        self.number = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.set_rate(baud)
        self.rest = b""

    def set_rate(self, baud):
        settings = termios.tcgetattr(self.number)
        settings[0] = settings[1] = settings[3] = 0
        settings[2] = termios.CS8 | termios.CREAD | termios.CLOCAL
        if baud:
            settings[4] = settings[5] = RATES[baud]
        termios.tcsetattr(self.number, termios.TCSANOW, settings)

    def close(self):
        os.close(self.number)

    def send(self, raw):
        assert os.write(self.number, raw) == len(raw)

    def hear(self, seconds, wanted=1):
        """What comes until `wanted` packets are there, or the time is over."""
        found, end = [], time.monotonic() + seconds
        while len(found) < wanted and time.monotonic() < end:
            if select.select([self.number], [], [], max(0.0, end - time.monotonic()))[0]:
                more, self.rest = statuses(self.rest + os.read(self.number, 4096))
                found += more
        return found

    def ask(self, device, instruction, parameters=b"", seconds=2.0):
        self.send(packet(device, instruction, parameters))
        answers = self.hear(seconds)
        assert answers, f"no answer of {device} to instruction {instruction:#x} {bytes(parameters).hex()}"
        assert answers[0].device == device, f"asked {device}, {answers[0].device} answered"
        return answers[0]

    def read(self, device, address, size, signed=True):
        answer = self.ask(device, READ, number(address, 2) + number(size, 2))
        assert answer.error == 0 and len(answer.data) == size, (answer.error, answer.data)
        return answer.value(signed)

    def write(self, device, address, value, size):
        answer = self.ask(device, WRITE, number(address, 2) + number(value, size))
        assert answer.data == b""
        return answer.error

    def silence(self, raw, seconds=0.3):
        self.send(raw)
        answers = self.hear(seconds)
        assert not answers, [(each.device, each.error) for each in answers]


class Twin:
    """`verp hil` as its user starts it; ends with the block."""

    def __init__(self, program):
        self.program = program
        self.path = os.path.abspath("bus")
        self.log = open("twin.err", "w+")
        self.process = subprocess.Popen([program, "hil", "generic21", "--link", "pty:" + self.path, "--for", "60", "--json"],
                                        stdin=subprocess.DEVNULL, stdout=open("twin.out", "w"), stderr=self.log)

    def __enter__(self):
        for _ in range(6000):  # a minute: other tests slow it
            if os.path.islink(self.path):
                return self
            assert self.process.poll() is None, self.said()
            time.sleep(0.01)
        raise AssertionError("the twin makes no port")

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def told(self):
        """Ends it; its JSON."""
        self.__exit__()
        with open("twin.out") as text:
            return json.load(text)

    def said(self):
        with open("twin.err") as text:
            return text.read()

    def says(self, words, seconds=60):
        """Sooner or later: while a master may yet ask for lockstep it says nothing of such things."""
        until = time.monotonic() + seconds
        while words not in self.said() and time.monotonic() < until:
            time.sleep(0.05)
        return words in self.said()


def first_ping_to_all(twin):
    """Point 15: the SDK waits 3 ms for each id and 16 ms, also of a twin that has just started."""
    port = Port(twin.path)
    port.send(packet(BROADCAST, PING))
    found = [each.device for each in port.hear(253 * 0.003 + 0.016 + 0.2, 24)]
    assert found[:21] == list(range(1, 22)), found
    assert len(found) == len(set(found)), found


def scan_at_once(twin):
    """Point 17: `verp bus scan` finds all of a twin that has just started, also when somebody scanned and left before."""
    port = Port(twin.path)
    port.send(packet(BROADCAST, PING))
    port.close()
    for _ in range(2):
        done = subprocess.run([twin.program, "bus", "scan", "--link", f"serial:{twin.path}@2000000", "--json"],
                              capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        found = [each["id"] for each in json.loads(done.stdout)["devices"]]
        assert found[:21] == list(range(1, 22)) and len(found) == len(set(found)), found


def last_byte_ff(twin):
    """Point 8: a request that ends in FFh is answered before another byte comes."""
    port = Port(twin.path)
    endings = 0
    for device in range(1, 22):
        for address in range(147):
            asked = number(address, 2) + number(1, 2)
            if packet(device, READ, asked)[-1] != 0xFF:
                continue
            endings += 1
            assert len(port.ask(device, READ, asked, 2.0).data) == 1
    assert endings > 3, endings


def half_a_packet(twin):
    """Point 10: half a packet, and a closed port or none, costs at most the next request."""
    whole = packet(1, WRITE, number(168, 2) + bytes(200))
    for close in (True, False):
        port = Port(twin.path)
        assert port.ask(1, PING).error == 0
        port.send(whole[:20])
        if close:
            port.close()
            port = Port(twin.path)
        assert port.ask(1, PING, b"", 0.5).value(False) & 0xFFFF == 1030
        port.close()


def unread_answers(twin):
    """Points 8 and 17: the answers that a program left unread are nobody's."""
    port = Port(twin.path)
    port.ask(1, PING)
    for _ in range(3):
        port.send(packet(1, PING))
        time.sleep(0.05)
    port.close()
    time.sleep(0.2)
    port = Port(twin.path)
    assert not port.hear(0.2), "an answer to somebody else's question"
    assert port.read(2, 7, 1) == 2


def too_many_writes(twin):
    """Point 9: faster than the wire, requests are lost; what is answered is answered in time."""
    port = Port(twin.path)
    port.ask(1, PING)
    for _ in range(2000):  # Return Delay Time: a Status Packet leaves 0.5 ms after its request
        port.send(packet(1, WRITE, number(65, 2) + b"\x01"))
        time.sleep(0.0001)
    time.sleep(0.05)
    answers = port.hear(0.5, 2000)
    assert 0 < len(answers) < 1990, len(answers)
    assert port.write(1, 65, 0, 1) == 0
    assert port.read(1, 65, 1) == 0
    assert twin.says("lost, as on a wire"), twin.said()
    link = twin.told()["link"]
    assert 0 < link["lost"] <= 2000 and link["skipped_us"] >= 0, link


def another_rate(twin):
    """Point 13: a port at another rate than the servos' hears nothing, and finds the one that was reset."""
    port = Port(twin.path, 57600)
    port.silence(packet(1, PING))
    port.set_rate(2000000)
    assert port.ask(3, FACTORY_RESET, b"\x01").error == 0  # all but the id
    port.silence(packet(3, PING))
    port.set_rate(57600)
    assert port.ask(3, PING).device == 3
    port.silence(packet(4, PING))
    assert port.write(3, 8, 4, 1) == 0  # 2 M; the answer has the old rate
    port.silence(packet(3, PING))
    port.set_rate(2000000)
    assert port.ask(3, PING).device == 3


def long_packets(twin):
    """Point 14: what is longer than a device's buffer is refused, or nobody's, and costs nothing else."""
    port = Port(twin.path)
    answer = port.ask(1, READ, number(0, 2) + number(600, 2))
    assert answer.error == 5 and answer.data == b"", answer.error  # Data Length Error
    many = b"".join(bytes([1 + i % 21]) + number(2048, 4) for i in range(150))
    port.silence(packet(BROADCAST, SYNC_WRITE, number(116, 2) + number(4, 2) + many))
    assert port.read(1, 64, 1) == 0
    assert port.ask(1, PING).error == 0


HEAD = 19  # carries only itself
DRIVE_MODE, MODE, STARTUP, TORQUE, VELOCITY_P, POSITION_P = 10, 11, 60, 64, 78, 84
GOAL_PWM, GOAL_CURRENT, GOAL_VELOCITY, ACCELERATION, VELOCITY, GOAL = 100, 102, 104, 108, 112, 116
TICK, MOVING, STATUS_123, PWM, CURRENT, SPEED, POSITION, SPEED_WANTED, POSITION_WANTED = 120, 122, 123, 124, 126, 128, 132, 136, 140
RANGE_ERROR, LIMIT_ERROR, RESULT_FAIL = 4, 6, 1


def set_up(port, mode, drive=0):
    """Torque off, and a mode; head in the middle of its turn."""
    assert port.write(HEAD, TORQUE, 0, 1) == 0
    assert port.write(HEAD, DRIVE_MODE, drive, 1) == 0
    assert port.write(HEAD, MODE, mode, 1) == 0


def rest(port, milliseconds):
    """By the servo's own clock."""
    begun = port.read(HEAD, TICK, 2, False)
    while (port.read(HEAD, TICK, 2, False) - begun) % 32768 < milliseconds:
        time.sleep(0.01)


def moment(port):
    """Of one moment: the servo's clock, Moving Status, Velocity Trajectory, Moving."""
    data = port.ask(HEAD, READ, number(TICK, 2) + number(SPEED_WANTED + 4 - TICK, 2)).data
    speed = int.from_bytes(data[SPEED_WANTED - TICK:], "little", signed=True)
    return int.from_bytes(data[:2], "little"), data[STATUS_123 - TICK], speed, data[MOVING - TICK]


def go(port, goal):
    """Goes there; ms by the servo's own clock, what its trajectory showed on the way, and for how long nobody looked."""
    begun = moment(port)[0]
    assert port.write(HEAD, GOAL, goal, 4) == 0
    rest(port, 5)
    took, longest, seen = 0, 0, []
    while True:
        tick, status, speed, moving = moment(port)
        longest = max(longest, (tick - begun) % 32768 - took)
        took = (tick - begun) % 32768
        if not status & 2:
            return took, seen, longest
        seen.append((status >> 4, speed, moving))
        assert took < 5000, seen[-1]


def travel(port, goal):
    """Goes there, once more if this PC was so slow that it can't tell what it was meant to see."""
    home = port.read(HEAD, GOAL, 4)
    while True:
        took, seen, longest = go(port, goal)
        if longest < 50:
            return took, seen
        go(port, home)


def profiles(twin):
    """Point 12: e-Manual, "What is the Profile": its kinds, how long each takes, and Moving Status."""
    port = Port(twin.path)
    set_up(port, 3)
    here = port.read(HEAD, POSITION, 4)
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    # 600 counts at 782 counts/s (50 * 0.229 rev/min); 4883 counts/s^2 (20 * 214.577 rev/min^2) take 0.16 s more.
    for acceleration, kind, least, most in ((0, 1, 700, 850), (20, 3, 860, 1010)):
        assert port.write(HEAD, ACCELERATION, acceleration, 4) == 0
        assert port.write(HEAD, VELOCITY, 50, 4) == 0
        goal = here + 600 if kind == 1 else here
        took, seen = travel(port, goal)
        assert least <= took <= most, took
        assert {each[0] for each in seen} == {kind} and all(each[2] == 1 for each in seen), seen
        assert max(abs(each[1]) for each in seen) == 50, seen
        rest(port, 500)
        status = port.read(HEAD, STATUS_123, 1)
        assert status & 2 == 0 and status & 8 == 0 and status & 1, status
        assert abs(port.read(HEAD, POSITION_WANTED, 4) - goal) <= 1
    set_up(port, 3, 4)  # one second, at most half of it acceleration
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    for acceleration, kind in ((0, 1), (250, 3), (800, 2)):
        assert port.write(HEAD, VELOCITY, 1000, 4) == 0
        assert port.write(HEAD, ACCELERATION, acceleration, 4) == 0
        took, seen = travel(port, here + 500 if kind != 3 else here)
        assert 940 <= took <= 1100, (kind, took)
        assert {each[0] for each in seen} == {kind}, seen


def modes(twin):
    """Point 12: velocity, PWM, current, extended and current-based position mode; reverse mode; limits."""
    port = Port(twin.path)
    set_up(port, 3)
    here = port.read(HEAD, POSITION, 4)
    assert port.write(HEAD, MODE, 2, 1) == RANGE_ERROR
    assert port.write(HEAD, GOAL, 5000, 4) == LIMIT_ERROR
    set_up(port, 4)
    assert port.write(HEAD, GOAL, -100000, 4) == 0
    assert port.write(HEAD, GOAL, 1048576, 4) == RANGE_ERROR

    set_up(port, 1)
    assert port.write(HEAD, GOAL_VELOCITY, 331, 4) == LIMIT_ERROR
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.write(HEAD, GOAL_VELOCITY, -20, 4) == 0
    rest(port, 600)
    assert port.read(HEAD, SPEED_WANTED, 4) == -20
    assert abs(port.read(HEAD, SPEED, 4) + 20) <= 2, port.read(HEAD, SPEED, 4)
    assert port.read(HEAD, POSITION, 4) < here - 100

    set_up(port, 16)
    assert port.read(HEAD, GOAL_PWM, 2) == 885  # the new mode's limit
    assert port.write(HEAD, GOAL_PWM, 0, 2) == 0
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.write(HEAD, GOAL_PWM, 150, 2) == 0
    rest(port, 300)
    assert port.read(HEAD, PWM, 2) == 150 and port.read(HEAD, SPEED, 4) > 10

    set_up(port, 0)
    assert port.write(HEAD, GOAL_CURRENT, 1194, 2) != 0
    assert port.write(HEAD, GOAL_CURRENT, 0, 2) == 0
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.write(HEAD, GOAL_CURRENT, 90, 2) == 0
    rest(port, 1500)  # as far as its stop
    assert abs(port.read(HEAD, CURRENT, 2) - 90) <= 4, port.read(HEAD, CURRENT, 2)

    set_up(port, 5)
    stop = port.read(HEAD, POSITION, 4)
    assert port.write(HEAD, GOAL_CURRENT, 60, 2) == 0
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.write(HEAD, GOAL, stop + 900, 4) == 0  # beyond its stop
    rest(port, 700)
    assert abs(port.read(HEAD, CURRENT, 2) - 60) <= 4, port.read(HEAD, CURRENT, 2)
    assert port.read(HEAD, STATUS_123, 1) & 9 == 8  # neither follows nor arrives
    assert port.write(HEAD, GOAL, here, 4) == 0
    rest(port, 1500)

    set_up(port, 3)
    forward = port.read(HEAD, POSITION, 4)
    set_up(port, 3, 1)  # reverse
    assert abs(port.read(HEAD, POSITION, 4) - (4096 - forward)) <= 2
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.write(HEAD, GOAL, 4096 - forward + 300, 4) == 0
    rest(port, 1000)
    assert abs(port.read(HEAD, POSITION, 4) - (4096 - forward + 300)) <= 25
    set_up(port, 3)
    assert abs(port.read(HEAD, POSITION, 4) - (forward - 300)) <= 25


def startup(twin):
    """Point 12: Startup Configuration (60) and Control Table Backup."""
    port = Port(twin.path)
    store, restore = b"\x01CTRL", b"\x02CTRL"
    assert port.ask(HEAD, BACKUP, restore).error == RESULT_FAIL  # no backup
    assert port.write(HEAD, POSITION_P, 900, 2) == 0
    assert port.write(HEAD, TORQUE, 1, 1) == 0
    assert port.ask(HEAD, BACKUP, store).error == RESULT_FAIL
    assert port.write(HEAD, TORQUE, 0, 1) == 0
    assert port.ask(HEAD, BACKUP, store).error == 0
    assert port.read(HEAD, 147, 1) == 1  # Backup Ready
    assert port.ask(HEAD, REBOOT).error == 0
    assert port.read(HEAD, POSITION_P, 2) == 800 and port.read(HEAD, TORQUE, 1) == 0
    assert port.write(HEAD, STARTUP, 3, 1) == 0
    assert port.ask(HEAD, REBOOT).error == 0
    assert port.read(HEAD, POSITION_P, 2) == 900 and port.read(HEAD, TORQUE, 1) == 1
    assert abs(port.read(HEAD, GOAL, 4) - port.read(HEAD, POSITION, 4)) <= 10
    assert port.write(HEAD, TORQUE, 0, 1) == 0
    assert port.ask(HEAD, BACKUP, restore).error == 0  # register 60 was 0 in the backup
    assert port.read(HEAD, STARTUP, 1) == 0
    set_up(port, 3, 8)  # Torque On by Goal Update
    assert port.write(HEAD, GOAL, port.read(HEAD, POSITION, 4), 4) == 0
    assert port.read(HEAD, TORQUE, 1) == 1


def main():
    program, case = sys.argv[1:]
    with Twin(program) as twin:
        globals()[case](twin)


if __name__ == "__main__":
    main()
