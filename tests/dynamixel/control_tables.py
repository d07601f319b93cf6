#!/usr/bin/env python3
"""Reads servos register by register and compares them with ROBOTIS' e-Manual.

    control_tables.py PORT [PAGE...]

PORT has one servo of each page of control_tables.txt (or of the named ones), at 2 Mbaud, ids 1 to 20, factory-new, with
1 A and half of its full duty. Status 0: all are as the e-Manual has them.
"""
import os
import sys

from foreign_client import PING, READ, Port, number

TORQUE, OPERATING_MODE, VELOCITY_LIMIT, GOAL_VELOCITY, GOAL_POSITION, PRESENT = 64, 11, 44, 104, 116, 126
SILENCING = (7, 8)  # a new id or rate
GOALS = (100, 102, GOAL_VELOCITY, GOAL_POSITION)  # bounded by limits
RANGE_ERROR, LIMIT_ERROR, ACCESS_ERROR = 4, 6, 7


class Table:
    def __init__(self, like):
        self.registers = dict(like.registers) if like else {}
        self.indirect = list(like.indirect) if like else []
        self.modes = like.modes if like else []
        self.shows = like.shows if like else ""


def tables():
    """By page. A row replaces that of the page's model."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "control_tables.txt")
    all_pages = {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            words = line.split("#")[0].split()
            if not words:
                continue
            if words[0] == "all" or words[0].startswith(("x/", "mx/")):
                table = all_pages[words[0]] = Table(all_pages[words[2] if len(words) > 2 else "all"] if all_pages else None)
            elif words[0] == "lacks":
                del table.registers[int(words[1])]
            elif words[0] == "indirect":
                table.indirect = [] if words[1] == "none" else table.indirect + [tuple(map(int, words[1:]))]
            elif words[0] == "modes":
                table.modes = list(map(int, words[1:]))
            elif words[0] in ("load", "current"):
                table.shows = words
            else:
                size, access, initial, low = words[1:5]
                high = words[5] if len(words) > 5 else low[1:]
                low = low.replace("~", "-")
                given = [None if each == "-" else int(each) for each in (initial, low, high)]
                table.registers[int(words[0])] = (int(size), access, *given)
    del all_pages["all"]
    return all_pages


def expect(got, wanted, what):
    assert got == wanted, f"{what}: {got}, not {wanted}"


def try_bounds(port, device, address, register):
    size, _, initial, low, high = register
    outside = LIMIT_ERROR if address in GOALS else RANGE_ERROR
    if high is not None and high + 1 < 1 << 8 * size:
        expect(port.write(device, address, high + 1, size), outside, f"{address}: a write of {high + 1}")
    if low is not None and (low > 0 or address in GOALS):
        expect(port.write(device, address, low - 1, size), outside, f"{address}: a write of {low - 1}")
    if address in SILENCING or low is None or high is None:
        return
    for value in (high, low, 0 if initial is None else initial):
        expect(port.write(device, address, value, size), 0, f"{address}: a write of {value}")
        expect(port.read(device, address, size, low < 0), value, f"{address}: written with {value}")


def try_modes(port, device, modes):
    for mode in range(18):
        error = port.write(device, OPERATING_MODE, mode, 1)
        expect(error == 0, mode in modes, f"Operating Mode {mode} taken")
    expect(port.write(device, OPERATING_MODE, 3, 1), 0, "Operating Mode 3")


def try_indirect(port, device, blocks):
    last = blocks[-1][1] + blocks[-1][2] - 1
    for addresses, data, pairs in blocks:
        for n in (0, pairs - 1):
            pointer = addresses + 2 * n
            expect(port.read(device, pointer, 2), data + n, f"{pointer}")
            expect(port.write(device, pointer, 63, 2), RANGE_ERROR, f"{pointer}: a write of 63")
            expect(port.write(device, pointer, last + 1, 2), RANGE_ERROR, f"{pointer}: a write of {last + 1}")
            expect(port.write(device, pointer, 65, 2), 0, f"{pointer}: a write of 65")
            for lit in (1, 0):
                expect(port.write(device, data + n, lit, 1), 0, f"{data + n}: a write of {lit}")
                expect(port.read(device, 65, 1), lit, f"the LED, by {data + n}")
    expect(len(port.ask(device, READ, number(last, 2) + number(1, 2)).data), 1, f"bytes at {last}")
    expect(len(port.ask(device, READ, number(last + 1, 2) + number(1, 2)).data), 0, f"bytes at {last + 1}")


def compare(port, device, table):
    for address, (size, _, initial, low, _) in table.registers.items():
        got = port.read(device, address, size, bool(low and low < 0))
        if initial is not None:
            expect(got, initial, f"{address}: factory value")
    shown = 500 if table.shows[0] == "load" else round(1000 / float(table.shows[1]))
    expect(port.read(device, PRESENT, 2), shown, f"{PRESENT}")
    for address, register in table.registers.items():
        if register[1] == "RW":
            try_bounds(port, device, address, register)
        else:
            expect(port.write(device, address, 0, register[0]), ACCESS_ERROR, f"{address}: a write to what is read only")
    limit = table.registers[VELOCITY_LIMIT][2]
    for value, error in ((limit, 0), (-limit, 0), (limit + 1, LIMIT_ERROR), (-limit - 1, LIMIT_ERROR)):
        expect(port.write(device, GOAL_VELOCITY, value, 4), error, f"{GOAL_VELOCITY}: a write of {value}")
    for address in range(168):
        if address not in table.registers:
            expect(port.write(device, address, 0, 1), ACCESS_ERROR, f"{address}: a write to nothing")
    try_modes(port, device, table.modes)
    try_indirect(port, device, table.indirect)


def main():
    port, pages = Port(sys.argv[1]), sys.argv[2:]
    found = {port.ask(device, PING).value(False) & 0xFFFF: device for device in range(1, 1 + (len(pages) or 20))}
    wanted = {page: table for page, table in tables().items() if not pages or page in pages}
    expect(sorted(found), sorted(table.registers[0][2] for table in wanted.values()), "the models")
    for page, table in wanted.items():
        try:
            compare(port, found[table.registers[0][2]], table)
        except AssertionError as error:
            sys.exit(f"{page}, {error}")


if __name__ == "__main__":
    main()
