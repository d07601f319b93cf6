#!/usr/bin/env python3
"""Somebody else's Feetech software, in the standard library alone: it shares nothing with this project.

    foreign_client.py VERP CASE

starts `VERP hil generic21 --bus feetech --link pty:...` in this folder and plays CASE over the pseudo-terminal. What is
sent stands in Feetech's Communication Protocol User Manual and memory tables, or follows from them. Status 0: all was as
it is there.
"""
import os
import select
import subprocess
import sys
import termios
import time

PING, READ, WRITE, REG_WRITE, ACTION, SYNC_READ, SYNC_WRITE, ALL = 1, 2, 3, 4, 5, 0x82, 0x83, 0xFE
RATES = {115200: termios.B115200, 500000: termios.B500000, 1000000: termios.B1000000}
HEAD = 19  # carries only itself
ID, BAUD, LEVEL, OFFSET, TORQUE, GOAL, LIMIT, LOCK, POSITION, VOLTAGE = 5, 6, 8, 31, 40, 42, 48, 55, 56, 62


def packet(device, instruction, parameters=b""):
    body = bytes([device, len(parameters) + 2, instruction]) + bytes(parameters)
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


def word(value, sign=15):
    """Low byte first; a magnitude with its sign."""
    return (abs(value) | (1 << sign if value < 0 else 0)).to_bytes(2, "little")


def number(data, sign=15):
    raw = int.from_bytes(data, "little")
    return -(raw & (1 << sign) - 1) if raw >> sign & 1 else raw


class Status:
    def __init__(self, device, bits, data):
        self.device, self.bits, self.data = device, bits, data


def statuses(raw):
    """The whole packets in `raw`, and what is left of it; what is damaged is passed over."""
    found = []
    while True:
        at = raw.find(b"\xff\xff")
        if at < 0:
            return found, raw[-1:]
        raw = raw[at:]
        if len(raw) < 4 or len(raw) < 4 + raw[3]:
            return found, raw
        whole = raw[:4 + raw[3]]
        if raw[2] == 0xFF or raw[3] < 2 or ~sum(whole[2:-1]) & 0xFF != whole[-1]:
            raw = raw[1:]
            continue
        raw = raw[len(whole):]
        found.append(Status(whole[2], whole[4], whole[5:-1]))


class Port:
    def __init__(self, path, baud=1000000):
        self.number = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.rest = b""
        self.set_rate(baud)

    def set_rate(self, baud):
        settings = termios.tcgetattr(self.number)
        settings[0] = settings[1] = settings[3] = 0
        settings[2] = termios.CS8 | termios.CREAD | termios.CLOCAL
        settings[4] = settings[5] = RATES[baud]
        termios.tcsetattr(self.number, termios.TCSANOW, settings)

    def close(self):
        os.close(self.number)

    def send(self, raw):
        assert os.write(self.number, raw) == len(raw)

    def hear(self, seconds, wanted=1):
        found, end = [], time.monotonic() + seconds
        while len(found) < wanted and time.monotonic() < end:
            if select.select([self.number], [], [], max(0.0, end - time.monotonic()))[0]:
                more, self.rest = statuses(self.rest + os.read(self.number, 4096))
                found += more
        return found

    def ask(self, device, instruction, parameters=b"", seconds=2.0):
        self.send(packet(device, instruction, parameters))
        answers = self.hear(seconds)
        assert answers, f"no answer of {device} to {instruction:#x} {bytes(parameters).hex()}"
        assert answers[0].device == device, f"asked {device}, {answers[0].device} answered"
        return answers[0]

    def read(self, device, address, size):
        answer = self.ask(device, READ, bytes([address, size]))
        assert len(answer.data) == size, answer.data
        return answer.data

    def write(self, device, address, data):
        answer = self.ask(device, WRITE, bytes([address]) + bytes(data))
        assert answer.data == b"" and answer.bits == 0, (answer.bits, answer.data)

    def silence(self, raw, seconds=0.3):
        self.send(raw)
        answers = self.hear(seconds)
        assert not answers, [(each.device, each.bits, each.data) for each in answers]


class Twin:
    """`verp hil` as its user starts it; ends with the block."""

    def __init__(self, program):
        self.path = os.path.abspath("bus")
        self.log = open("twin.err", "w+")
        words = [program, "hil", "generic21", "--bus", "feetech", "--link", "pty:" + self.path, "--for", "60", "--json"]
        self.process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=open("twin.out", "w"), stderr=self.log)

    def __enter__(self):
        for _ in range(6000):  # a minute: other tests slow it
            if os.path.islink(self.path):
                return self
            assert self.process.poll() is None, open("twin.err").read()
            time.sleep(0.01)
        raise AssertionError("the twin makes no port")

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()


def manual_examples(twin):
    """The manual's own bytes: Ping, Read of two bytes at 56, Sync Read of eight bytes of two servos."""
    port = Port(twin.path)
    port.send(bytes.fromhex("ff ff 01 02 01 fb"))
    answer = port.hear(2)[0]
    assert (answer.device, answer.bits, answer.data) == (1, 0, b"")
    port.send(bytes.fromhex("ff ff 01 04 02 38 02 be"))
    assert abs(number(port.hear(2)[0].data) - 2048) < 1200
    port.send(bytes.fromhex("ff ff fe 06 82 38 08 01 02 36"))
    both = port.hear(2, 2)
    assert [each.device for each in both] == [1, 2], both
    for each in both:
        assert len(each.data) == 8 and each.data[6] == 74, each.data  # 7.4 V


def memory_table(twin):
    """Each register's size, access, initial value and range."""
    port = Port(twin.path)
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "memory_table.txt")
    for line in open(path, encoding="utf-8"):
        words = line.split("#")[0].split()
        if not words:
            continue
        address, size, access = int(words[0]), int(words[1]), words[2]
        sign = int(words[6]) if len(words) > 6 else 16
        before = port.read(HEAD, address, size)
        if words[3] != "-":
            assert number(before, sign) == int(words[3]), f"{address}: {number(before, sign)}, not {words[3]}"
        if access == "R":
            port.write(HEAD, address, bytes([1] * size))
            if words[3] != "-":
                assert port.read(HEAD, address, size) == before, f"{address} is read only"
            continue
        if address in (ID, BAUD, LEVEL, TORQUE, LOCK):
            continue
        for value in map(int, words[4:6]):
            raw = word(value, sign)[:size] if size == 2 else bytes([value])
            port.ask(HEAD, WRITE, bytes([address]) + raw)  # a limit may raise an alarm
            assert port.read(HEAD, address, size) == raw, f"{address} does not keep {value}"
        port.ask(HEAD, WRITE, bytes([address]) + before)


def goal_and_back(twin):
    """A goal is reached; torque off lets go; a Torque Limit of 0 does not move."""
    port = Port(twin.path)
    here = number(port.read(HEAD, POSITION, 2))
    port.write(HEAD, TORQUE, b"\x01\x00" + word(here + 300))
    time.sleep(1.0)
    assert abs(number(port.read(HEAD, POSITION, 2)) - here - 300) < 25
    port.write(HEAD, LIMIT, word(0))
    port.write(HEAD, GOAL, word(here))
    time.sleep(0.5)
    assert abs(number(port.read(HEAD, POSITION, 2)) - here - 300) < 60
    port.write(HEAD, TORQUE, b"\x00")
    assert port.read(HEAD, TORQUE, 1) == b"\x00"


def kept_writes(twin):
    """Reg Write waits for Action; a broadcast is obeyed and not answered; level 0 answers reads only."""
    port = Port(twin.path)
    port.ask(HEAD, REG_WRITE, bytes([GOAL]) + word(2100))
    assert number(port.read(HEAD, GOAL, 2)) == 0 and port.read(HEAD, 64, 1) == b"\x01"
    port.silence(packet(ALL, ACTION))
    assert number(port.read(HEAD, GOAL, 2)) == 2100 and port.read(HEAD, 64, 1) == b"\x00"
    port.silence(packet(ALL, SYNC_WRITE, bytes([GOAL, 2, HEAD]) + word(2050) + bytes([20]) + word(-7)))
    assert number(port.read(HEAD, GOAL, 2)) == 2050 and number(port.read(20, GOAL, 2)) == -7
    port.silence(packet(HEAD, WRITE, bytes([LEVEL, 0])))
    port.silence(packet(HEAD, WRITE, bytes([GOAL]) + word(2060)))
    assert number(port.read(HEAD, GOAL, 2)) == 2060


def id_and_rate(twin):
    """A new id answers the request that set it by the old one; another rate is another line."""
    port = Port(twin.path)
    port.write(HEAD, LOCK, b"\x00")
    port.write(HEAD, ID, b"\x2a")
    port.silence(packet(HEAD, PING))
    assert port.ask(42, PING).data == b""
    port.write(42, OFFSET, word(-500, 11))
    assert number(port.read(42, OFFSET, 2), 11) == -500
    port.ask(42, WRITE, bytes([BAUD, 4]))
    port.silence(packet(42, PING))
    port.set_rate(115200)
    assert port.ask(42, PING).data == b""
    port.silence(packet(1, PING))


def garbage(twin):
    """Noise, a wrong checksum, half a packet and two servos at once cost no other request."""
    port = Port(twin.path)
    port.ask(1, PING)
    port.silence(bytes([0, 0xFF, 0x55, 0xFF]))
    port.silence(packet(1, PING)[:-1] + b"\x00")
    assert port.ask(1, PING).data == b""
    port.send(packet(1, WRITE, bytes(100))[:20])
    time.sleep(0.3)
    assert port.ask(1, PING).data == b""
    port.send(packet(ALL, PING))  # "not when several servos are connected": they collide
    assert len(port.hear(0.3, 24)) <= 1
    assert port.ask(2, PING).data == b""


def main():
    program, case = sys.argv[1:]
    with Twin(program) as twin:
        globals()[case](twin)


if __name__ == "__main__":
    main()
