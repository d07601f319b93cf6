#!/usr/bin/python3
"""build_manual.py PROGRAM FOLDER: builds the manual as a site in FOLDER/site.

Copies this folder to FOLDER/docs, writes the reference pages there (commands and parameters as PROGRAM prints them,
registers from registers.md, functions from abi.json) and runs mkdocs, which fails at the first warning.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def output_of(program, *words):
    """What PROGRAM prints. `edit`, `view`, `shot` and `video` have programs that cannot be built everywhere."""
    done = subprocess.run([program, *words], env={**os.environ, "COLUMNS": "100"}, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else f"./verp {' '.join(words)} prints this page: a program of its own, which was not built here."


def subcommands(help_text):
    listed = help_text.partition("\nSubcommands:")[2].partition("\n\n")[0]
    return re.findall(r"^  ([a-z][a-z-]*) ", listed, re.M)


def fenced(text):
    return f"```text\n{text.rstrip()}\n```\n"


def commands_page(program):
    top = output_of(program, "--help")
    page = ["# Commands\n", "As `verp --help` and `verp COMMAND --help` print them.\n", fenced(top)]
    for command in subcommands(top):
        text = output_of(program, command, "--help")
        page += [f"## verp {command}\n", fenced(text)]
        for inner in subcommands(text):
            page += [f"### verp {command} {inner}\n", fenced(output_of(program, command, inner, "--help"))]
    return "\n".join(page)


def parameters_page(program):
    return "\n".join([
        "# Parameters\n",
        "As `verp parameters` prints them for generic21. `--set NAME=VALUE` changes one for a run, `verp:tuning` in the robot's file for good, and an operator by the registers"
        " `parameter_id` and `parameter_value` while the robot runs.\n",
        fenced(output_of(program, "parameters"))])


def registers_page():
    return (ROOT / "firmware/app/registers.md").read_text()


def declaration(function):
    def typed(item):
        name = item.get("name", "")
        return f"{'const ' if item.get('const') else ''}{item['type']}{'*' * item.get('pointer', 0)} {name}".strip()
    arguments = ", ".join(typed(each) for each in function["arguments"]) or "void"
    return f"{typed({**function['returns'], 'name': function['name']})}({arguments})"


def libverp_page():
    header, = ROOT.glob("host/**/libverp/abi.json")
    abi = json.loads(header.read_text())
    page = ["# libverp\n", f"Every function of `{abi['library']}`, ABI {abi['abi']}, in the words of `verp.h`. [Your own controller](../own-controller.md#libverp) says how to use it.\n"]
    for function in abi["functions"]:
        page += [f"## {function['name']}\n", fenced(declaration(function)), function["words"] + "\n"]
    return "\n".join(page)


def main():
    program, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    docs = folder / "docs"
    shutil.rmtree(docs, ignore_errors=True)
    shutil.copytree(HERE, docs, ignore=shutil.ignore_patterns("*.py", "*.yml", "*.txt", "__pycache__"))
    shutil.copy(HERE / "mkdocs.yml", folder)
    (docs / "reference").mkdir()
    pages = {"commands.md": commands_page(program), "parameters.md": parameters_page(program),
             "registers.md": registers_page(), "libverp.md": libverp_page()}
    for name, text in pages.items():
        (docs / "reference" / name).write_text(text)
    if not shutil.which("mkdocs"):
        print("the manual needs Debian's package mkdocs: ./verp manual installs it", file=sys.stderr)
        return 3
    return subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--clean", "-f", folder / "mkdocs.yml", "-d", folder / "site"], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
