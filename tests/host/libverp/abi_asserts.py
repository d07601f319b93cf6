"""abi_asserts.py LIST: a C program that compiles if, and only if, what the list says of verp.h is so."""

import json
import sys
from pathlib import Path


def c_type(entry: dict, name: str = "") -> str:
    """Its declaration in C."""
    lengths = "".join(f"[{length}]" for length in entry.get("array", []))
    const = "const " if entry.get("const") else ""
    return f"{const}{entry['type']}{'*' * entry['pointer']} {name}{lengths}".strip()


listed = json.loads(Path(sys.argv[1]).read_text())
print('#include <stddef.h>\n#include "verp.h"')


def is_so(condition: str) -> None:
    print(f'_Static_assert({condition}, "{condition}");')


for value in listed["constants"] + [value for enum in listed["enums"] for value in enum["values"]]:
    is_so(f"{value['name']} == {value['value']}")
for struct in listed["structs"]:
    name, end = struct["name"], 0
    is_so(f"sizeof({name}) == {struct['size']}")
    is_so(f"_Alignof({name}) == {struct['align']}")
    for field in struct["fields"]:
        is_so(f"offsetof({name}, {field['name']}) == {field['offset']}")
        is_so(f"sizeof((({name}*)0)->{field['name']}) == {field['size']}")
        lengths = "".join(f"[{length}]" for length in field.get("array", []))
        stars = "*" * field["pointer"]
        const = "const " if field.get("const") else ""
        print(f"extern {const}{field['type']}{stars} (*{name}_{field['name']}){lengths};")
        print(f"extern __typeof__((({name}*)0)->{field['name']})* {name}_{field['name']};")
        # Only alignment leaves gaps.
        assert 0 <= field["offset"] - end < 8, f"{name}.{field['name']}"
        end = field["offset"] + field["size"]
for function in listed["functions"] + listed["callbacks"]:
    arguments = ", ".join(c_type(each) for each in function["arguments"]) or "void"
    is_type = function in listed["callbacks"]
    mine = f"my_{function['name']}"
    print(f"typedef {c_type(function['returns'])} {mine}({arguments});")
    of = f"(*({function['name']})0)" if is_type else function["name"]
    is_so(f"__builtin_types_compatible_p(__typeof__({of}), {mine})")
for handle in listed["handles"]:
    is_so(f"sizeof({handle}) == sizeof(void*)")
