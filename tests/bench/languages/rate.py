"""rate.py TIMES [AT_LEAST]: control ticks a second of CPU time from Python, one call a tick, without physics, over what the
controller saw in a walk: a line each time. Status 1: it decided otherwise than in the walk, or their middle is below AT_LEAST."""

import statistics
import sys
import time

import verp

with verp.Session() as session:
    session.add(walk_s=3)
    saw = [seen["inputs"].copy() for seen in session]
    digest = session.digest()
core, rates = verp.Core(), []
for _ in range(int(sys.argv[1])):
    core.reset()
    start_s = time.process_time()
    for inputs in saw:
        core.inputs[0] = inputs
        core.step()
    rates.append(len(saw) / (time.process_time() - start_s))
    if core.digest != digest:
        sys.exit("the controller did not decide what it did in the walk")
    print(f"{rates[-1]:.0f}")
sys.exit(len(sys.argv) > 2 and statistics.median(rates) < float(sys.argv[2]))
