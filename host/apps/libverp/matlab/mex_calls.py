#!/usr/bin/python3
"""mex_calls.py [ABI.JSON]: the calls of verp_mex that abi.json describes in full, in C on stdout: tables of the structs'
fields, a function for each call, and the table of all calls.

The build makes mex_calls.c of it. calls.h lists the calls that are written by hand, because they keep memory, run a
controller or give arrays. A function of verp.h that is in none of the lists and fits no rule below is an error.
"""

import json
import re
import sys
from pathlib import Path

_NUMBERS = {"uint8_t": "kU8", "uint16_t": "kU16", "uint32_t": "kU32", "uint64_t": "kU64", "int16_t": "kI16", "int32_t": "kI32",
            "float": "kFloat", "double": "kDouble"}
_TAKEN = {"uint32_t": "whole(a, {}, \"{}\")", "int32_t": "signed_whole(a, {}, \"{}\")", "double": "number(a, {}, \"{}\")",
          "float": "(float)number(a, {}, \"{}\")"}
_SAID = {"fx_n": "force x", "fy_n": "force y", "fz_n": "force z", "for_s": "time", "angle_rad": "angle"}  # in messages
_FLAGS = {"pressed"}  # any number but 0 sets them
_NO_CALL = {"verp_abi", "verp_last_error", "verp_layout", "verp_robot_defaults", "verp_radio_defaults", "verp_decide",
            "verp_session_view", "verp_session_state", "verp_core_state", "verp_core_params", "verp_core_joints",
            "verp_core_joint_name", "verp_core_leg_joints"}  # used by other calls, or not offered
_FLAT = {"verp_command"}  # inside another struct: command.request is command_request
_BY_SIDE = {"sole", "sole_m"}  # arrays of two rows: left_sole, right_sole
_UNSEEN = {"size", "reserved"}


def _plain(name: str) -> str:
    return name.removeprefix("verp_")


def _plural(name: str) -> str:
    return name.removesuffix("y") + ("ies" if name.endswith("y") else "s")


def _shape(name: str) -> str:
    return "k" + _plain(name).capitalize()


class Writer:
    def __init__(self, abi: dict, by_hand: list[str], header: str) -> None:
        self._abi, self._by_hand, self._header = abi, by_hand, header
        self._structs = {each["name"]: each for each in abi["structs"]}
        self._functions = {each["name"]: each for each in abi["functions"]}

    def _rows(self, of: str, entry: dict, before: str = "") -> list[tuple[int, str]]:
        """(order, C) of a field; MATLAB shows numbers first, then texts, then structs."""
        path, kind, lengths = before + entry["name"], entry["type"], entry.get("array", [])
        flat, count = path.replace(".", "_"), 1
        for length in lengths:
            count *= length

        def row(order: int, flat: str, path: str, kind: str, count: int = 1, inner: str = "NULL") -> tuple[int, str]:
            return order, f'    {{"{flat}", {kind}, offsetof({of}, {path}), {count}, {inner}}},\n'

        if entry["name"] in _UNSEEN:
            return []
        if kind == "char":
            return [row(1, flat, path, "kText" if entry["pointer"] else "kChars")]
        if kind in _FLAT:
            return [each for inner in self._structs[kind]["fields"] for each in self._rows(of, inner, path + ".")]
        if kind in self._structs:
            return [row(2, flat, path, "kStruct", 1, "&" + _shape(kind))]
        if flat in _BY_SIDE:
            return [row(0, f"{side}_{flat}", f"{path}[{i}]", _NUMBERS[kind], lengths[1])
                    for i, side in enumerate(("left", "right"))]
        return [row(0, flat, path, _NUMBERS[kind], count)]

    def _table(self, struct: dict) -> str:
        name, shape = struct["name"], _shape(struct["name"])
        rows = sorted((row for entry in struct["fields"] for row in self._rows(name, entry)), key=lambda row: row[0])
        if len(rows) > 32:
            raise SystemExit(f"mex_calls.py: {name} has {len(rows)} fields: make the names in fields.c's to_matlab() longer")
        return (f"static const field {shape}Fields[] = {{\n{''.join(text for _, text in rows)}}};\n"
                f"const shape {shape} = {{\"{_plain(name)}\", {shape}Fields, {len(rows)}, sizeof({name})}};\n\n")

    def _taken(self, entry: dict, index: int) -> list[str] | None:
        """Statements that make a local variable of an argument; None: no rule for it."""
        name, kind, pointer = entry["name"], entry["type"], entry["pointer"]
        said = _SAID.get(name, name)
        if pointer and not entry["const"]:
            return None
        if pointer and kind in self._structs:
            has_defaults = f"{kind}_defaults" in self._functions
            start = f"checked({kind}_defaults(&{name}))" if has_defaults else f"memset(&{name}, 0, sizeof {name})"
            return [f"{kind} {name}", start, f"take_struct(a, {index}, &{_shape(kind)}, &{name})"]
        if pointer:
            return [f"const char* {name} = text(a, {index}, \"{said}\")"] if kind == "char" else None
        if kind in self._abi["handles"]:
            return [f"const {kind} {name} = handle(a)"]
        if name in _FLAGS:
            return [f"const {kind} {name} = number(a, {index}, \"{said}\") != 0"]
        return [f"const {kind} {name} = {_TAKEN[kind].format(index, said)}"] if kind in _TAKEN else None

    def _given(self, entry: dict) -> tuple[list[str], str] | None:
        """Statements before the call for what it gives, and the MATLAB value of it; None: no rule for it."""
        name, kind = entry["name"], entry["type"]
        if kind in self._structs:
            size = [f"{name}.size = sizeof {name}"] if self._structs[kind]["fields"][0]["name"] == "size" else []
            return [f"{kind} {name}", f"memset(&{name}, 0, sizeof {name})"] + size, f"to_matlab(&{_shape(kind)}, &{name}, 1)"
        if kind in self._abi["handles"]:
            return [f"{kind} {name} = NULL"], f"word((uint64_t)(uintptr_t){name})"
        if kind == "uint64_t":
            return [f"{kind} {name} = 0"], f"word({name})"
        return ([f"{kind} {name} = 0"], f"mxCreateDoubleScalar({name})") if kind in _TAKEN else None

    def _call(self, function: dict) -> list[str] | None:
        """The statements of a call that gives at most one value; None: that needs a hand."""
        if function["returns"]["pointer"]:
            return [f"a->out[0] = mxCreateString({function['name']}())"] if not function["arguments"] else None
        lines, passed, value = [], [], ""
        for index, entry in enumerate(function["arguments"]):
            taken = self._taken(entry, index)
            if taken is not None:
                lines += taken
            elif entry["pointer"] and not entry["const"] and not value and (given := self._given(entry)):
                lines, value = lines + given[0], given[1]
            else:
                return None
            passed.append(("&" if entry["pointer"] and entry["type"] != "char" else "") + entry["name"])
        return lines + [f"checked({function['name']}({', '.join(passed)}))"] + ([f"a->out[0] = {value}"] if value else [])

    def _all_of(self, one: dict) -> list[str] | None:
        """The statements of verp_xs(..., count) and, for each of them, verp_x(..., index, struct): a struct row."""
        *outer, index, last = one["arguments"]
        kind, passed = last["type"], "".join(f"{each['name']}, " for each in outer)
        lines = [line for i, each in enumerate(outer) for line in self._taken(each, i)]
        return lines + ["uint32_t count = 0", f"checked({_plural(one['name'])}({passed}&count))",
                        f"{kind}* all = mxCalloc((size_t)count + 1, sizeof *all)",
                        f"for (uint32_t i = 0; i < count; ++i) {{\n    all[i].size = sizeof *all;\n"
                        f"    checked({one['name']}({passed}i, &all[i]));\n  }}",
                        f"a->out[0] = to_matlab(&{_shape(kind)}, all, count)", "mxFree(all)"]

    def _calls(self) -> dict[str, list[str]]:
        made, ones = {}, {_plural(name): function for name, function in self._functions.items()}
        for name, function in self._functions.items():
            if name in _NO_CALL or _plain(name) in self._by_hand or _plural(name) in self._functions:
                continue
            lines = self._all_of(ones[name]) if name in ones else self._call(function)
            if lines is None:
                raise SystemExit(f"mex_calls.py: no rule fits {name}: write the call by hand, or list it in _NO_CALL")
            made[_plain(name)] = lines
        return made

    def text(self) -> str:
        calls = self._calls()
        functions, shapes = "", ""
        for name, lines in calls.items():
            body = "".join(f"  {line}{'' if line.endswith('}') else ';'}\n" for line in lines)
            functions += f"static void {name}(const arguments* a) {{\n{body}}}\n\n"
        for struct in reversed(self._abi["structs"]):  # those inside others come first
            if _shape(struct["name"]) in self._header + functions + shapes:
                shapes = self._table(struct) + shapes
        table = "".join(f'    {{"{name}", {name}}},\n' for name in [*self._by_hand, *calls])
        headers = "".join(f'#include "host/apps/libverp/{each}.h"\n' for each in ("matlab/calls", "matlab/fields", "verp"))
        return (f"/* Made by mex_calls.py from abi.json. */\n#include <string.h>\n\n{headers}\n"
                f"{shapes}{functions}const call kCalls[] = {{\n{table}    {{NULL, NULL}}}};\n")


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    by_hand = re.findall(r"^void (\w+)\(const arguments\* a\);", (here / "calls.h").read_text(), re.M)
    abi = Path(sys.argv[1]) if len(sys.argv) > 1 else here.parent / "abi.json"
    sys.stdout.write(Writer(json.loads(abi.read_text()), by_hand, (here / "fields.h").read_text()).text())
