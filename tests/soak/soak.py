"""soak.py [--hours H] [--bus NAME] [--model ROBOT] [--seed S]: `./verp python tests/soak/soak.py`.

Orders one robot about at random for ten simulated hours: counters of 32 bits run over (microseconds after 71.6 minutes), and a
leak shows. Servos get hot, so after four minutes it lies down for as long, lets go, and gets up. Each tenth gives a row. Beside it the process walks a new robot for a few seconds, which must have the digest that the
first one had. Exit status 1 if a tick is missing, a fault or a fall came, memory grew by 2 %, or a digest changed. The time of a
tick is shown and not judged.
"""

import argparse
import random
import sys
import time

import verp

REFERENCE_S = 6
ROWS = 10
MOVES_S, RESTS_S = 240, 240
GETS_UP_S = 20
MEMORY_GROWTH = 1.02  # after the first row, in which memory fills that is kept
FAULTS = 0xFFFF  # the upper half only reports
FALLEN = 6  # a mode of common/safety/machine.hpp


def memory_mb():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) / 1024


def reference(options):
    """The digest of a short walk in a new world."""
    with verp.Session(physics_step_us=2000) as session:
        session.add(options.model, bus=options.bus, walk_s=REFERENCE_S)
        while session.tick(100):
            pass
        return session.result().digest


def give_order(session, draw, time_s):
    """Rest, get up, stand, step on the spot, or walk at what every robot of ours walks at on a level floor. Returns how long, s."""
    if time_s % (MOVES_S + RESTS_S) > MOVES_S:
        session.command(verp.RELAX)
        return RESTS_S
    if session.seen()["outputs"]["torque_enable"] == 0 and time_s > 0:
        session.command(verp.GET_UP)
        return GETS_UP_S
    kind = draw.random()
    if kind < 0.2:
        session.command(verp.STAND)
    elif kind < 0.3:
        session.command(verp.WALK)
    else:
        session.command(verp.WALK, draw.uniform(-0.08, 0.16), draw.uniform(-0.03, 0.03), draw.uniform(-0.3, 0.3))
    return draw.uniform(2, 15)


class Soak:
    def __init__(self, options):
        self.draw = random.Random(options.seed)
        self.session = verp.Session(physics_step_us=2000)
        self.session.add(options.model, bus=options.bus, walk_s=0, open_end=True, seed=options.seed)
        self.ticks, self.order_until_s, self.faults, self.falls = 0, 0.0, 0, 0

    def run(self, until_s):
        """Until this simulated time. Returns the CPU time of a tick, µs."""
        start_s, before = time.process_time(), self.ticks
        seen = self.session.seen()
        while seen["time_s"] < until_s:
            if seen["time_s"] >= self.order_until_s:
                self.order_until_s = float(seen["time_s"]) + give_order(self.session, self.draw, float(seen["time_s"]))
            if not self.session.tick():
                raise SystemExit(f"soak: the run ended by itself after {seen['time_s']:.1f} s")
            self.ticks += 1
            self.faults |= int(seen["outputs"]["faults"]) & FAULTS
            self.falls += int(seen["outputs"]["mode"] == FALLEN)
        return 1e6 * (time.process_time() - start_s) / (self.ticks - before)

    def missing(self):
        """Control periods without a tick: the controller numbers them from 0."""
        return int(self.session.seen()["inputs"]["tick"]) + 1 - self.ticks


def soak(options):
    first, run = reference(options), Soak(options)
    wrong, memory = [], []
    print(f"{'hours':>6} {'ticks':>9} {'missing':>8} {'faults':>7} {'falls':>7} {'MB':>7} {'us a tick':>10}  reference")
    for row in range(1, ROWS + 1):
        us = run.run(3600 * options.hours * row / ROWS)
        digest = reference(options)
        memory.append(memory_mb())
        print(f"{options.hours * row / ROWS:6.2f} {run.ticks:9} {run.missing():8} {run.faults:#7x} {run.falls:7}"
              f" {memory[-1]:7.1f} {us:10.0f}  0x{digest:016x}", flush=True)
        wrong += ["a walk's digest changed"] * (digest != first)
    wrong += ["ticks are missing"] * (run.missing() != 0) + ["the robot fell"] * (run.falls != 0)
    wrong += [f"faults {run.faults:#x}"] * (run.faults != 0)
    wrong += ["memory grew"] * (memory[-1] > MEMORY_GROWTH * memory[0])
    print("soak: " + (", ".join(dict.fromkeys(wrong)) or "flat") + f"; digest of the run 0x{run.session.digest():016x}")
    return 1 if wrong else 0


def main():
    words = argparse.ArgumentParser(prog="soak.py", description="one robot, ordered about for hours")
    words.add_argument("--hours", type=float, default=10, help="simulated")
    words.add_argument("--bus", help="one of the robot's buses; default: its first")
    words.add_argument("--model", default="generic21")
    words.add_argument("--seed", type=int, default=1, help="of the orders and of all chance in the twin")
    options = words.parse_args()
    if not 0.01 <= options.hours <= 1000:
        words.error("--hours is 0.01 to 1000")
    try:
        return soak(options)
    except verp.VerpError as error:
        print(f"soak: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
