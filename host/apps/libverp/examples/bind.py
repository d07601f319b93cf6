"""bind.py LIBRARY [SECONDS]: a binding made from abi.json alone, by Python's own ctypes: without the header, without the verp
package. It walks with a controller of its own that has the robot's decide, and prints what walk.py prints."""

import ctypes
import json
import sys
from pathlib import Path

abi = json.loads((Path(__file__).resolve().parents[1] / "abi.json").read_text())
library = ctypes.CDLL(sys.argv[1])
seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 20

types = {f"{sign}int{bits}_t": getattr(ctypes, f"c_{sign}int{bits}") for sign in ("", "u") for bits in (8, 16, 32, 64)}
types |= {"int": ctypes.c_int, "float": ctypes.c_float, "double": ctypes.c_double, "char": ctypes.c_char, "void": None}
types |= {handle: ctypes.c_void_p for handle in abi["handles"]}
value = {each["name"]: each["value"] for each in abi["constants"] + [v for enum in abi["enums"] for v in enum["values"]]}


def type_of(entry: dict) -> type:
    out, pointer = types[entry["type"]], entry["pointer"]
    if pointer and entry["type"] in ("char", "void"):
        out, pointer = {"char": ctypes.c_char_p, "void": ctypes.c_void_p}[entry["type"]], pointer - 1
    for _ in range(pointer):
        out = ctypes.POINTER(out)
    for length in reversed(entry.get("array", [])):
        out *= length
    return out


for struct in abi["structs"]:
    made = type(struct["name"], (ctypes.Structure,), {"_fields_": [(f["name"], type_of(f)) for f in struct["fields"]]})
    assert ctypes.sizeof(made) == struct["size"], struct["name"]
    assert all(getattr(made, f["name"]).offset == f["offset"] for f in struct["fields"]), struct["name"]
    types[struct["name"]] = made
for each in abi["callbacks"]:
    types[each["name"]] = ctypes.CFUNCTYPE(type_of(each["returns"]), *map(type_of, each["arguments"]))
for each in abi["functions"]:
    function = getattr(library, each["name"])
    function.restype, function.argtypes = type_of(each["returns"]), [type_of(a) for a in each["arguments"]]
assert library.verp_abi() == abi["abi"], "another ABI"


def must(status: int) -> int:
    if status < 0:
        raise RuntimeError(library.verp_last_error().decode())
    return status


def new(name: str) -> ctypes.Structure:
    return types[name](size=ctypes.sizeof(types[name]))


@types["verp_controller"]
def decide(moment: ctypes.POINTER(types["verp_moment"]), _user: int) -> int:
    return library.verp_decide(moment.contents.token)


session, robot, result = ctypes.c_void_p(), new("verp_robot"), new("verp_result")
must(library.verp_session_open(None, session))
must(library.verp_robot_defaults(robot))
robot.walk_s = seconds
must(library.verp_session_add(session, robot, None))
must(library.verp_session_control(session, 0, decide, None))
while must(library.verp_session_tick(session, 100, None, None)) != value["VERP_OVER"]:
    pass
must(library.verp_session_result(session, 0, result))
must(library.verp_session_close(session))
print(f"{result.distance_m:.2f} m 0x{result.digest:016x}")
sys.exit(result.failure != b"")
