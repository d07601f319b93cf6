#!/usr/bin/python3
"""man_page.py FOLDER: manual pages of libverp into a folder: libverp.3, which has every function's words from abi.json and every
type from verp.h, and a page for each function that leads there."""

import json
import re
import sys
from pathlib import Path

_here = Path(__file__).resolve().parent


def _roff(text: str) -> str:
    """As it is: no character is roff's."""
    text = text.replace("\\", "\\(rs").replace("-", "\\-").replace("`", "\\(ga").replace("'", "\\(aq").replace("^", "\\(ha")
    return re.sub(r"^(?=[.'])", r"\\&", text, flags=re.M)


def _type(entry: dict) -> str:
    return ("const " if entry.get("const") else "") + entry["type"] + "*" * entry["pointer"]


def _declaration(function: dict, name: str) -> str:
    arguments = ", ".join(f"{_type(each)} {each['name']}" for each in function["arguments"])
    return f"{_type(function['returns'])} {name}({arguments or 'void'})"


def _entry(function: dict, name: str) -> list[str]:
    return [".TP", f".B {_roff(_declaration(function, name))}", _roff(function["words"])]


def _words(comment: str) -> list[str]:
    """A comment's paragraphs."""
    plain = re.sub(r"^ ?\*/?|^/\*|\*/$", "", comment, flags=re.M)
    return [" ".join(each.split()) for each in re.split(r"\n\s*\n", plain)]


def _types(part: str) -> list[str]:
    found = re.findall(r"(?:/\*(?:(?!\*/).)*\*/\n)?(?:typedef struct \w+\* \w+;|(?:typedef )?(?:enum|struct)\b[^;{]*\{.*?\}[^;]*;)", part, flags=re.S)
    return [".PP", ".nf", ".ft CW", _roff("\n\n".join(found)), ".ft", ".fi"] if found else []


def page(header: str, abi: dict) -> str:
    about = header[: header.index("#ifndef")]
    body = header[header.index("visibility push") :]
    sections = re.split(r"^/\* ---- (.*?) ---- \*/$", body, flags=re.M)
    out = [f'.TH LIBVERP 3 "" "libverp.so.{abi["abi"]}" "VERP"', ".SH NAME", "libverp \\- humanoid robots, their controller and its twin"]
    out += [".SH SYNOPSIS", ".nf", ".B #include <verp/verp.h>", "cc program.c $(pkg\\-config \\-\\-cflags \\-\\-libs verp)", ".fi"]
    out += [".SH DESCRIPTION"]
    for paragraph in _words(about):
        out += [".PP", _roff(paragraph)]
    out += _types(sections[0])
    left = abi["callbacks"] + abi["functions"]
    for title, part in zip(sections[1::2], sections[2::2], strict=True):
        out += [f".SH {_roff(title.upper())}"] + _types(part)
        there = {name: n for n, name in enumerate(re.findall(r"^\w[^(\n]*?(?:\(\*)?(verp_\w+)\)?\(", part, flags=re.M))}
        here = sorted((each for each in left if each["name"] in there), key=lambda each: there[each["name"]])
        for each in here:
            callback = each in abi["callbacks"]
            out += _entry(each, f"(*{each['name']})" if callback else each["name"])
        left = [each for each in left if each not in here]
    if left:
        raise SystemExit(f"man_page.py: verp.h does not declare {left[0]['name']}, which abi.json lists")
    out += [".SH SEE ALSO", ".BR verp (1),", "verp.hpp (C++), Python's help(verp), and verp/abi.json for other languages"]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    listed = json.loads((_here / "abi.json").read_text())
    (folder / "libverp.3").write_text(page((_here / "verp.h").read_text(), listed))
    for each in listed["functions"]:
        (folder / f"{each['name']}.3").write_text(".so man3/libverp.3\n")
