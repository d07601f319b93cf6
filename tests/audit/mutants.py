"""Mutants: a source with one small mistake each, of the kinds that programmers make."""
import random
import re
from pathlib import Path

# Binary operators stand between spaces (clang-format), so the sign of a number is left alone.
SWAPS = {
    " < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
    " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " += ": " -= ", " -= ": " += ",
    " && ": " || ", " || ": " && ", " & ": " | ", " | ": " & ", " << ": " >> ", " >> ": " << ",
}
OPERATOR = re.compile("|".join(re.escape(each) for each in sorted(SWAPS, key=len, reverse=True)))
NUMBER = re.compile(r"(?<![\w.'])(\d+)(\.\d+)?(?=[FfUu]*(?![\w.']))")
CONDITION = re.compile(r"\bif \(([^;{]+)\)(?= [^&|]|$)")
# A statement that stands on one line: an assignment, a call, or a way out.
STATEMENT = re.compile(r"^\s+((?:[\w.:>\[\]()*-]+ [-+|&*]?= .+|[\w.:>-]+\(.*\)|continue|break|return);)$")
NO_CODE = ("//", "#", "static_assert", "using ", "template", "namespace", "extern")
# {from, all_of, none_of, to} of the safety table.
ROW = re.compile(r"    \{([^{};]+?), ([\w |]+),\s+([\w |\n]+),\s+Mode::(\w+)\},")


class Mutant:
    """`file` with the characters from `start` to `end` replaced by `new`."""

    def __init__(self, file, source, start, end, new):
        self.file, self.start, self.end, self.new = file, start, end, new
        self.line = source.count("\n", 0, start) + 1
        first, last = source.rfind("\n", 0, start) + 1, source.find("\n", end)
        self.before = " ".join(source[first:last].split())
        self.after = " ".join((source[first:start] + new + source[end:last]).split())

    def text(self, source):
        return source[:self.start] + self.new + source[self.end:]

    def __str__(self):
        return f"{self.file}:{self.line}: `{self.before}` -> `{self.after}`"


def changes_of(code):
    """(start, end, new) of each mistake in a line of code."""
    for at in OPERATOR.finditer(code):
        yield at.start(), at.end(), SWAPS[at.group()]
    for at in NUMBER.finditer(code):
        yield at.start(), at.end(), f"{int(at[1]) + 1}{at[2] or ''}"
    statement = STATEMENT.match(code)
    if statement:
        yield *statement.span(1), ";"
    condition = CONDITION.search(code)
    if condition and condition[1].count("(") == condition[1].count(")"):
        yield *condition.span(1), f"!({condition[1]})"


def of_file(root, file):
    source = (root / file).read_text()
    begin = 0
    for line in source.split("\n"):
        code = line.split("//")[0].rstrip()
        if code.strip() and '"' not in code and not code.strip().startswith(NO_CODE):
            for start, end, new in changes_of(code):
                yield Mutant(file, source, begin + start, begin + end, new)
        begin += len(line) + 1


def of_table(root, file):
    """Of each row: gone, led elsewhere, without what must hold, in spite of what must not."""
    source = (root / file).read_text()
    modes = sorted(set(re.findall(r"Mode::(k\w+)\}", source)))
    for row in ROW.finditer(source):
        yield Mutant(file, source, *row.span(), "")
        yield Mutant(file, source, *row.span(4), modes[(modes.index(row[4]) + 1) % len(modes)])
        for part in (2, 3):
            if row[part] != "0":
                yield Mutant(file, source, *row.span(part), "0")


def sample(root, folder, count, seed):
    """How many mutants the sources below `folder` have, and `count` of them, each equally likely."""
    every = []
    for source in sorted(Path(root, folder).rglob("*.cpp")):
        every += of_file(root, str(source.relative_to(root)))
    random.Random(seed).shuffle(every)
    return len(every), every[:count]
