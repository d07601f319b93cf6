#!/usr/bin/python3
"""native.py [ABI.JSON]: what the list of the ABI tells, in C# on stdout: structs by offset and size, values, callbacks, functions.

The build makes Native.cs of it. Arrays become structs with an indexer that minds their length, and texts have ToString(), so
that whoever uses a struct needs no unsafe code.
"""

import json
import sys
from pathlib import Path

_NUMBERS = {"int8_t": "sbyte", "uint8_t": "byte", "int16_t": "short", "uint16_t": "ushort", "int32_t": "int", "uint32_t": "uint",
            "int64_t": "long", "uint64_t": "ulong", "int": "int", "float": "float", "double": "double", "char": "byte",
            "void": "void"}
_WORDS = {"in", "out", "ref", "params", "object", "string", "base", "event", "lock", "fixed", "is", "as"}  # of C#, not of C


def _name(name: str) -> str:
    return "@" + name if name in _WORDS else name


class Writer:
    def __init__(self, abi: dict) -> None:
        self._abi = abi
        self._types = _NUMBERS | {handle: "IntPtr" for handle in abi["handles"]}
        self._types |= {each["name"]: each["name"] for each in abi["structs"] + abi["callbacks"]}
        self._arrays: dict[str, str] = {}

    def _type(self, entry: dict) -> str:
        base = self._types[entry["type"]] + "*" * entry["pointer"]
        if "array" not in entry:
            return base
        if entry["pointer"]:
            raise SystemExit(f"native.py: {entry['name']} is an array of pointers, which nobody has needed so far: add it")
        kind = "text" if entry["type"] == "char" else base
        name = f"{kind}_{'x'.join(map(str, entry['array']))}"
        self._arrays[name] = self._text(name, entry) if kind == "text" else self._array(name, base, entry["array"])
        return name

    def _array(self, name: str, item: str, lengths: list[int]) -> str:
        count, index = 1, ""
        for i, length in enumerate(lengths):
            count *= length
            within = f"Native.Within({'ijk'[i]}, {length})"
            index = f"({index}) * {length} + {within}" if i > 1 else f"{index} * {length} + {within}" if i else within
        arguments = ", ".join(f"int {'ijk'[i]}" for i in range(len(lengths)))
        return (f"  public unsafe struct {name} {{\n    fixed {item} item[{count}];\n"
                f"    public {item} this[{arguments}] {{\n      get {{ fixed ({item}* all = item) return all[{index}]; }}\n"
                f"      set {{ fixed ({item}* all = item) all[{index}] = value; }}\n    }}\n  }}\n")

    def _text(self, name: str, entry: dict) -> str:
        (length,) = entry["array"]
        return (f"  public unsafe struct {name} {{\n    fixed byte item[{length}];\n    public override string ToString() {{\n"
                f"      fixed (byte* first = item) return Texts.Of(first, {length});\n    }}\n  }}\n")

    def _signature(self, entry: dict) -> str:
        arguments = ", ".join(f"{self._type(each)} {_name(each['name'])}" for each in entry["arguments"])
        return f"{self._type(entry['returns'])} {entry['name']}({arguments})"

    def _words(self, entry: dict, indent: str) -> str:
        words = entry["words"].replace("&", "&amp;").replace("<", "&lt;")
        return f"{indent}/// <summary>{words}</summary>\n" if words else ""

    def _struct(self, struct: dict) -> str:
        fields = "".join(f"    [FieldOffset({each['offset']})] public {self._type(each)} {_name(each['name'])};\n"
                         for each in struct["fields"])
        return (f"  [StructLayout(LayoutKind.Explicit, Size = {struct['size']})]\n"
                f"  public unsafe struct {struct['name']} {{\n{fields}  }}\n")

    def text(self) -> str:
        abi = self._abi
        structs = "".join(self._struct(each) for each in abi["structs"])
        callbacks = "".join(f"{self._words(each, '  ')}  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]\n"
                            f"  public unsafe delegate {self._signature(each)};\n" for each in abi["callbacks"])
        values = "".join(f"    public const int {each['name']} = {each['value']};\n"
                         for each in abi["constants"])
        enums = "".join(f"  public enum {enum['name']} {{ " + ", ".join(f"{v['name']} = {v['value']}" for v in enum["values"]) +
                        " }\n" for enum in abi["enums"])
        functions = "".join(f"{self._words(each, '    ')}    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]\n"
                            f"    public static extern {self._signature(each)};\n" for each in abi["functions"])
        checks = " &&\n             ".join(f"sizeof({each['name']}) == {each['size']}" for each in abi["structs"])
        arrays = "".join(self._arrays[name] for name in sorted(self._arrays))
        return (f"// Made by native.py from abi.json.\nusing System;\nusing System.Runtime.InteropServices;\n\n"
                f"namespace Verp {{\n{enums}\n{arrays}\n{structs}\n{callbacks}\n  /// <summary>All that verp.h declares.</summary>\n"
                f"  public static unsafe class Native {{\n    public const string Library = \"{abi['library']}\";\n"
                f"    /// <summary>Of the list that this was made from.</summary>\n    public const uint Abi = {abi['abi']};\n"
                f"    /// <summary>Whether this language gives each struct the size that C gives it.</summary>\n"
                f"    public static bool SizesAreThose() {{\n      return {checks};\n    }}\n"
                f"    /// <summary>An index of an array in a struct.</summary>\n"
                f"    internal static int Within(int index, int length) {{\n      if (0 <= index && index < length) return index;\n"
                f"      throw new IndexOutOfRangeException(index + \" is no index of \" + length + \" items\");\n    }}\n\n{values}\n{functions}  }}\n}}\n")


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    sys.stdout.write(Writer(json.loads(Path(sys.argv[1] if len(sys.argv) > 1 else here.parent / "abi.json").read_text())).text())
