#!/usr/bin/env python3
"""The cases of the interpreter's own test-suite: kinecut reads each program as the suite expects, or refuses it where it must.

    rs274_cases.py --cases FOLDER --kinecut target/release/kinecut --oracle ROOT

The folder holds manifest.json and one folder for each case. For the oracle see rs274_oracle.py. A program with expected moves is
read and written again by kinecut. The interpreter's moves of the original must be those that the suite expects, to the letter; its
moves of the new text are held against them in full precision, as in rs274_random.py. Of a program to be refused the line and the
reason are shown, kinecut's and then the interpreter's. Ends with 1 where a case is not as it should be.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import kinecut_reads  # noqa: E402
import rs274_oracle  # noqa: E402


# Machine of a program that turns an axis.
ROTARY = "mill4_xyza"


def motions(printed):
    """Moves of a canonical output as text, however zero is written."""
    zero = re.compile(r"-(0[.]0+)(?=[^0-9]|$)")
    return [(name, zero.sub(r"\1", words)) for name, words in rs274_oracle.calls_of(printed) if name in rs274_oracle.MOVES]


def tools_of(path):
    """A tool table in inches, as the suite's machine has it; in mm."""
    table = {}
    for line in path.read_text().splitlines():
        words = {k.upper(): float(v) for k, v in re.findall(r"([TPXYZD])\s*([-+]?\d*\.?\d+)", line.split(";")[0], re.I)}
        if "T" in words:
            table[int(words["T"])] = tuple(words.get(k, 0) * rs274_oracle.INCH for k in "XYZD")
    return table


def canonical(case, folder, oracle, kinecut):
    """(result, details) of a program that is to be read."""
    expected = (folder / case["expected"]).read_text(errors="replace")
    program = folder / case["program"]
    table = tools_of(folder / case["tool_table"]) if case.get("tool_table") else {}
    ini = (folder / case["ini"]).read_text() if case.get("ini") else None
    moves = len(motions(expected))
    error, _, right = oracle.run(program.read_text(errors="replace"), table=table, ini=ini, beside=folder)
    if error or moves and motions(oracle.printed) != motions(expected):
        return "no oracle", f"{error[0]} | {error[1]}" if error else "this interpreter moves otherwise than the suite expects", moves
    try:
        path = re.search(r"(?m)^\s*SUBROUTINE_PATH\s*=\s*(.+?)\s*$", ini or "")
        folders = path[1].split(":") if path else ()
        try:
            posted, found = kinecut.post(program, folders=folders)
        except kinecut_reads.Refused as why:
            if "no machine with rotary axes" not in str(why):
                raise
            posted, found = kinecut.post(program, folders=folders, machine=ROTARY)
    except kinecut_reads.Refused as why:
        return "refused", str(why), moves
    again = oracle.run(posted, table=table, ini=ini, beside=folder)
    if again[0]:
        return "post refused", f"{again[0][0]} | {again[0][1]}", moves
    split = next((e["text"] for e in [*right, *again[2]] if e["kind"] == "split"), None)
    if split:
        return "no oracle", split, moves
    off = [f for f in rs274_oracle.differences(again[2], right) if f[0] != "path mode"]
    if off:
        return "differs", f"{off[0][0]}: {off[0][2]}" + (f" and {len(off) - 1} more" if len(off) > 1 else ""), moves
    return "equal", "", moves


def reject(case, folder, oracle, kinecut):
    """(result, details) of a program that is to be refused."""
    reason, source = [*case["oracle_error"], ""][:2]
    program = folder / case["program"]
    try:
        if kinecut.binary in ("same", "altered"):
            error, lines, _ = oracle.run(program.read_text(errors="replace"), table={})
            if error:
                raise kinecut_reads.Refused(error[0], lines[0] if lines else None)
        else:
            kinecut.post(program)
    except kinecut_reads.Refused as why:
        line = case.get("candidate_lines") or []
        return "refused", f"{'its line' if why.line in line else f'line {line} wanted'}; {why} || {reason} | {source}", why.line in line
    return "ACCEPTED", f"{reason} | {source}", False


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("--cases", type=pathlib.Path, required=True)
    ask.add_argument("--kinecut", default=os.environ.get("KINECUT"), help="the binary; default: $KINECUT")
    ask.add_argument("--oracle", default=os.environ.get("RS274_ROOT"), help="folder with the unpacked packages; default: $RS274_ROOT")
    ask.add_argument("--only", default="", help="cases whose name has this in it")
    ask = ask.parse_args()
    if not ask.kinecut or not ask.oracle:
        sys.exit("give --kinecut and --oracle, or KINECUT and RS274_ROOT")
    binary = ask.kinecut if ask.kinecut in ("same", "altered") else str(pathlib.Path(ask.kinecut).resolve())
    oracle, kinecut = rs274_oracle.Oracle(ask.oracle), kinecut_reads.Kinecut(binary)
    cases = json.loads((ask.cases / "manifest.json").read_text())["cases"]
    counts, lines = collections.Counter(), 0
    print(f"{'case':42} {'moves':>6} {'result':12} details")
    for case in cases:
        if ask.only not in case["id"]:
            continue
        folder = ask.cases / case["dir"]
        if case["kind"] == "canonical":
            result, details, moves = canonical(case, folder, oracle, kinecut)
            counts[f"to be read: {result}"] += 1
        else:
            result, details, line = reject(case, folder, oracle, kinecut)
            moves, lines = "-", lines + line
            counts[f"to be refused: {result}"] += 1
        print(f"{case['id']:42} {moves:>6} {result:12} {details[:230]}".rstrip(), flush=True)
    print()
    for name, n in sorted(counts.items()):
        print(f"{name:32} {n:4}" + (f"   {lines} on the line of the interpreter" if name == "to be refused: refused" else ""))
    good = {"to be read: equal", "to be refused: refused"}
    sys.exit(0 if set(counts) <= good else 1)


if __name__ == "__main__":
    main()
