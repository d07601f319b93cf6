#!/usr/bin/python3
"""abi_list.py [HEADER]: what verp.h declares, as JSON on stdout, for people who bind another language.

abi.json is what it prints: host/apps/libverp/abi_list.py > host/apps/libverp/abi.json. Sizes and offsets are those of 64-bit
Linux. Needs Debian's python3-cffi, which brings the C parser.
"""

import json
import re
import sys
from pathlib import Path

import cffi
from pycparser import c_ast, c_parser

_NUMBERS = ["int8_t", "uint8_t", "int16_t", "uint16_t", "int32_t", "uint32_t", "int64_t", "uint64_t"]


def _blank(comment: re.Match) -> str:
    """As many lines as there were, so that the parser counts as we do."""
    return re.sub(r"[^\n]", " ", comment.group(0))


def _plain(header: str) -> str:
    """The header without comments and without the words that are for C++ and the preprocessor."""
    header = re.sub(r"/\*.*?\*/", _blank, header, flags=re.S)
    header = re.sub(r"#ifdef __cplusplus.*?#endif", _blank, header, flags=re.S)
    return re.sub(r"^#.*$", "", header, flags=re.M)


def _words_above(lines: list[str], line: int) -> str:
    """The comment that ends right above that line, which counts from 1."""
    last = line - 2
    if last < 0 or not lines[last].rstrip().endswith("*/"):
        return ""
    first = last
    while "/*" not in lines[first]:
        first -= 1
    text = " ".join(part.strip() for part in lines[first : last + 1])
    return re.sub(r"\s+\*\s+|\s+", " ", text.removeprefix("/*").removesuffix("*/")).strip()


def _type(node: c_ast.Node) -> dict:
    """{"type": its name, "pointer": how often one points to it, "const": what is pointed to stays, "array": lengths}."""
    array, pointer, const = [], 0, False
    while not isinstance(node, c_ast.IdentifierType):
        if isinstance(node, c_ast.ArrayDecl):
            array.append(int(node.dim.value))
        elif isinstance(node, c_ast.PtrDecl):
            pointer += 1
        elif isinstance(node, c_ast.TypeDecl):
            const = const or "const" in node.quals
        node = node.type
    out = {"type": " ".join(node.names), "pointer": pointer}
    return out | ({"const": const} if pointer else {}) | ({"array": array} if array else {})


def _signature(function: c_ast.FuncDecl) -> dict:
    arguments = [{"name": each.name} | _type(each.type) for each in function.args.params if each.name]
    return {"returns": _type(function.type), "arguments": arguments}


def _struct(ffi: cffi.FFI, name: str, fields: list[c_ast.Decl]) -> dict:
    listed = []
    for field in fields:
        ctype = dict(ffi.typeof(name).fields)[field.name]
        place = {"offset": ctype.offset, "size": ffi.sizeof(ctype.type)}
        listed.append({"name": field.name} | _type(field.type) | place)
    return {"name": name, "size": ffi.sizeof(name), "align": ffi.alignof(name), "fields": listed}


def abi(header: str) -> dict:
    text, lines = _plain(header), header.splitlines()
    ffi = cffi.FFI()
    ffi.cdef(text)
    numbers = "".join(f"typedef int {name};" for name in _NUMBERS)  # one line, so that line numbers stay
    known = ffi.dlopen(None)  # values of enumerators
    out = {"abi": 0, "library": "libverp.so.0", "constants": [], "enums": [], "handles": [], "structs": [],
           "callbacks": [], "functions": []}
    for node in c_parser.CParser().parse(numbers + text).ext[len(_NUMBERS) :]:
        inner = node.type.type if hasattr(node.type, "type") else node.type
        values = []
        if isinstance(inner, c_ast.Enum) or isinstance(node.type, c_ast.Enum):
            enum = inner if isinstance(inner, c_ast.Enum) else node.type
            values = [{"name": each.name, "value": getattr(known, each.name)} for each in enum.values.enumerators]
        if isinstance(node, c_ast.Decl) and values:
            out["constants"] += values
        elif values:
            out["enums"].append({"name": node.name, "values": values})
        elif isinstance(inner, c_ast.Struct):
            out["structs"].append(_struct(ffi, node.name, inner.decls))
        elif isinstance(node.type, c_ast.FuncDecl):
            words = _words_above(lines, node.coord.line)
            out["functions"].append({"name": node.name} | _signature(node.type) | {"words": words})
        elif isinstance(inner, c_ast.FuncDecl):
            words = _words_above(lines, node.coord.line)
            out["callbacks"].append({"name": node.name} | _signature(inner) | {"words": words})
        else:
            out["handles"].append(node.name)
    out["abi"] = known.VERP_ABI
    out["library"] = f"libverp.so.{known.VERP_ABI}"
    return out


def as_text(value: dict) -> str:
    """A line for each field, argument list and value, so that a change of the ABI is a few lines of difference."""
    out = []
    for key, entries in value.items():
        if not isinstance(entries, list):
            out.append(f"  {json.dumps(key)}: {json.dumps(entries)}")
            continue
        rows = []
        for entry in entries:
            inner = next((k for k in ("fields", "values") if isinstance(entry, dict) and k in entry), None)
            if inner is None:
                rows.append(f"    {json.dumps(entry)}")
                continue
            head = json.dumps({k: v for k, v in entry.items() if k != inner})[:-1]
            body = ",\n".join(f"      {json.dumps(each)}" for each in entry[inner])
            rows.append(f'    {head}, "{inner}": [\n{body}\n    ]}}')
        out.append(f"  {json.dumps(key)}: [\n" + ",\n".join(rows) + "\n  ]")
    return "{\n" + ",\n".join(out) + "\n}\n"


if __name__ == "__main__":
    header = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent / "verp.h"
    sys.stdout.write(as_text(abi(header.read_text())))
