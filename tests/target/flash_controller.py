"""What QEMU's netduinoplus2 has not: a flash that can be written. gdb stops where the driver is asked to erase or to program
(hal/chip/stm32/flash_pages.hpp) and does it in its place; all above the driver is the firmware as it is.

gdb -x this, with in the environment: GDB_SOCKET; FLASH_ERASE, FLASH_PROGRAM, addresses of the two functions; FLASH_HOME, the
sector whose programming the power leaves, by a reset, at the word FLASH_CUT (0: never); FLASH_LOG, where it tells what it did."""

import os

import gdb

BEGIN = {5: 0x08020000, 6: 0x08040000, 7: 0x08060000}  # RM0090 3.3, table 5; 128 KB
BYTES = 128 * 1024
home, cut = int(os.environ["FLASH_HOME"]), int(os.environ["FLASH_CUT"])
erase, program = int(os.environ["FLASH_ERASE"], 16), int(os.environ["FLASH_PROGRAM"], 16)


def register(name):
    return int(gdb.parse_and_eval("(unsigned)$" + name))


def tell(text):
    with open(os.environ["FLASH_LOG"], "a") as log:
        log.write(text + "\n")


for command in ("pagination off", "confirm off", "architecture armv7e-m"):
    gdb.execute("set " + command)
gdb.execute("target remote " + os.environ["GDB_SOCKET"])
memory = gdb.selected_inferior()
for address in (erase, program):
    gdb.execute("hbreak *0x%x" % address)
words = 0
while True:
    gdb.execute("continue", to_string=True)
    at = register("pc") & ~1
    sectors = bytes(memory.read_memory(register("r0") + 1, 2))  # SectorPages: family_, sector_[2]
    sector = sectors[1 if register("r1") else 0]
    if at == erase & ~1:
        memory.write_memory(BEGIN[sector], b"\xff" * BYTES)
        tell("erased %d" % sector)
    elif at == program & ~1:
        words += sector == home
        if sector == home and words == cut:
            tell("the power goes")
            gdb.execute("monitor system_reset")
            continue
        place = BEGIN[sector] + register("r2")
        new, old = bytes(memory.read_memory(register("r3"), 4)), bytes(memory.read_memory(place, 4))
        memory.write_memory(place, bytes(a & b for a, b in zip(new, old)))
    else:
        raise SystemExit("stopped at 0x%x" % at)
    gdb.execute("set $r0 = 1")
    gdb.execute("set $pc = $lr & ~1")
