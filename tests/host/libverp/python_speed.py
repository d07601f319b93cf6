"""Control ticks a second of CPU time from Python, one call a tick, without physics, over what the controller saw in a walk:
5,000 are promised."""

import sys
import time

import verp

with verp.Session() as session:
    session.add(walk_s=3)
    saw = [seen["inputs"].copy() for seen in session]
    digest = session.digest()
core, rates = verp.Core(), []
for _ in range(5):
    core.reset()
    start_s = time.process_time()
    for inputs in saw:
        core.inputs[0] = inputs
        core.step()
    rates.append(len(saw) / (time.process_time() - start_s))
if core.digest != digest:
    sys.exit("the controller did not decide what it did in the walk")
rate = sorted(rates)[len(rates) // 2]
print(f"{rate:.0f} ticks/s")
sys.exit(rate < 5000)
