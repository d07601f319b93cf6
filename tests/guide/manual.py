#!/usr/bin/python3
"""manual.py words PROGRAM: every `./verp` line of the manual and of the top README has words that PROGRAM knows, and every
file that they name is there.
manual.py run PROGRAM PAGE FOLDER [--full]: runs the fenced blocks of a page that stand behind `<!-- run -->`, one after
the other in FOLDER, where `./verp` is PROGRAM. With --full also those behind `<!-- run full -->`.
"""

import functools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GUIDE = ROOT / "host/guide"
LAUNCHER = {"test", "manual", "python"}
OWN = {"--yes", "--help", "--version"}
# In the merge gate, walks at a physics step of 2 ms take half the time.
FASTER = """case "$* " in
  *" --physics-step "* | *" --scenario "*) ;;
  "walk "*) shift && set -- walk --physics-step 2 "$@" ;;
esac
"""


def blocks(text):
    """(mark, language, first line's number, lines) of each fenced block; the mark is '', 'run' or 'run full'."""
    mark, inside, language, start, body = "", False, "", 0, []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            if inside:
                yield mark, language, start, body
                mark, inside = "", False
            else:
                inside, language, start, body = True, line[3:].strip(), number + 1, []
        elif inside:
            body.append(line)
        elif found := re.fullmatch(r"<!-- (run(?: full)?) -->", line):
            mark = found[1]
        elif line.strip():
            mark = ""


@functools.cache
def help_of(program, *words):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def commands_in(text):
    """(line, words) of each ./verp command in fenced blocks and in code spans."""
    found = []
    for _, language, start, body in blocks(text):
        if language in ("", "sh", "bash"):
            found += [(start + at, line) for at, line in enumerate(body)]
    for at, line in enumerate(text.splitlines(), 1):
        found += [(at, code) for code in re.findall(r"`((?:\./)?verp [^`]+)`", line)]
    for at, line in found:
        lexer = shlex.shlex(line, posix=True, punctuation_chars="&|;<>")
        lexer.whitespace_split = True
        try:
            words = list(lexer)
        except ValueError:
            continue  # a quote goes on in the next line
        for first, word in enumerate(words):
            if word in ("./verp", "verp"):
                ends = [i for i in range(first, len(words)) if set(words[i]) <= set("&|;<>")]
                yield at, words[first + 1:ends[0] if ends else len(words)]


def unknown_word(program, words):
    """The first word that the program does not know, or None."""
    path = []
    if words and words[0] in LAUNCHER:
        return None
    for word in words:
        if word.startswith("-") or not re.fullmatch(r"[a-z][a-z-]*", word):
            break
        known = help_of(program, *path) or ""
        if f"\n  {word} " not in known.partition("\nSubcommands:")[2]:
            if not path:
                return word
            break
        path.append(word)
    if path and help_of(program, path[0]) is None:
        return None  # a program that is not built here
    known = "".join(help_of(program, *path[:length]) or "" for length in range(len(path) + 1))
    for word in words:
        option = word.partition("=")[0]
        if option.startswith("--") and option not in OWN and not re.search(rf"(?<![\w-]){option}(?![\w-])", known):
            return option
    return None


def missing_files(text):
    """(line, path) of each file or folder of the repository that a code span names and that is not there."""
    for at, line in enumerate(text.splitlines(), 1):
        for path in re.findall(r"`((?:common|hal|firmware|boards|host|tests|toolchains)/[a-z0-9_/.]+)`", line):
            if not list(ROOT.glob(path.rstrip("/") + "*")):
                yield at, path


def check_words(program):
    bad = 0
    for page in [ROOT / "README.md", *sorted(GUIDE.glob("*.md"))]:
        for line, path in missing_files(page.read_text()):
            print(f"{page.relative_to(ROOT)}:{line}: there is no {path}")
            bad = 1
        for line, words in commands_in(page.read_text()):
            word = unknown_word(program, words)
            if word:
                print(f"{page.relative_to(ROOT)}:{line}: verp does not know '{word}': verp {shlex.join(words)}")
                bad = 1
    return bad


def run_page(program, page, folder, full):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shim = pathlib.Path(folder) / "verp"
    shim.write_text(f"#!/bin/sh\n{'' if full else FASTER}exec '{program}' \"$@\"\n")
    shim.chmod(0o755)
    count = 0
    for mark, language, start, body in blocks((GUIDE / page).read_text()):
        if mark != "run" and not (full and mark == "run full"):
            continue
        text = "\n".join(body)
        command = ["/usr/bin/python3", "-c", text] if language == "python" else ["bash", "-euc", text]
        count += 1
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode != 0:
            print(f"host/guide/{page}:{start}: exit status {done.returncode}\n{text}\n{done.stdout[-3000:]}")
            return 1
    print(f"{page}: {count} blocks")
    return 0 if count else 1


def main():
    mode, program = sys.argv[1], os.path.abspath(sys.argv[2])
    if mode == "words":
        return check_words(program)
    return run_page(program, sys.argv[3], sys.argv[4], "--full" in sys.argv)


if __name__ == "__main__":
    sys.exit(main())
