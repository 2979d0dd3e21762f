#!/usr/bin/env python3
"""Real programs of many controls: which kinecut reads, and whether the ISO ones are as long and as large as the interpreter says.

    nc_programs.py --programs FOLDER --kinecut target/release/kinecut [--oracle ROOT]

The folder holds the programs and manifest.json, with what LinuxCNC's interpreter says of each. A program is read for the control of
its dialect: one for GRBL that changes tools is read as a sender's, for LinuxCNC; --control haas=fanuc and the like name another one.
Of a program that is read the length at feed (0.1 %) and the box of feed moves (0.02 mm) are compared. With --oracle the program is
also written again for LinuxCNC, and the interpreter must take the text. Ends with 1 where a number is off or kinecut crashes.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import kinecut_reads  # noqa: E402
import rs274_oracle  # noqa: E402

CONTROLS = {"fanuc": "fanuc", "haas": "haas", "grbl": "grbl", "linuxcnc": "linuxcnc", "sinumerik": "sinumerik-840d", "heidenhain": "heidenhain"}


def control_of(program, text, named):
    """The control that a program is read for."""
    bare = re.sub(r"\([^)]*\)|;.*", "", text)
    if program["dialect"] == "grbl" and re.search(r"(?<![A-Z])M[ \t]*0?6(?!\d)", bare, re.I):
        return named.get("sender", "linuxcnc")
    return named.get(program["dialect"], CONTROLS[program["dialect"]])


def compared(sheet, oracle):
    """What is off, in words; None if there is nothing to compare."""
    box, length = oracle.get("feed_bbox_mm"), oracle.get("feed_length_mm")
    if not box or not length:
        return None
    off = []
    if abs(sheet["feed_length"] - length) > max(1e-3 * length, 0.01):
        off.append(f"{sheet['feed_length']:.2f} mm at feed in place of {length:.2f}")
    if sheet.get("range"):
        apart = max(abs(a - b) for p, q in zip(sheet["range"], box) for a, b in zip(p, q))
        if apart > 0.02:
            off.append(f"box {sheet['range']} in place of {box}")
    return off


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("--programs", type=pathlib.Path, required=True)
    ask.add_argument("--kinecut", default=os.environ.get("KINECUT"), help="the binary; default: $KINECUT")
    ask.add_argument("--oracle", default=os.environ.get("RS274_ROOT"), help="folder with the unpacked packages; default: $RS274_ROOT")
    ask.add_argument("--control", action="append", default=[], metavar="DIALECT=CONTROL", help="dialect of the manifest, or `sender`")
    ask.add_argument("--only", default="", help="files whose name has this in it")
    ask = ask.parse_args()
    if not ask.kinecut:
        sys.exit("give --kinecut, or KINECUT")
    named = dict(pair.split("=", 1) for pair in ask.control)
    kinecut = kinecut_reads.Kinecut(str(pathlib.Path(ask.kinecut).resolve()) if ask.kinecut != "same" else "same")
    oracle = rs274_oracle.Oracle(ask.oracle) if ask.oracle else None
    programs = json.loads((ask.programs / "manifest.json").read_text())["programs"]
    families, bad = collections.defaultdict(collections.Counter), 0
    print(f"{'program':28} {'control':15} {'interpreter':12} {'kinecut':9} details")
    for program in programs:
        if ask.only not in program["file"]:
            continue
        path, judge = ask.programs / program["file"], program.get("rs274_oracle") or {}
        text = path.read_bytes().decode(errors="replace")
        control, count = control_of(program, text, named), families[program["dialect"]]
        count["programs"] += 1
        theirs = {True: "takes it", False: "refuses", "after normalisation": "takes it *"}.get(judge.get("accepted"), "-")
        try:
            sheet = own(oracle, text) if kinecut.binary == "same" else read(kinecut, path, control)
            sheet = sheet[0] if isinstance(sheet, list) else sheet
            result, details = "reads", ""
            off = compared(sheet, judge)
            if off is None:
                count["nothing to compare"] += 1
                details = f"{sheet['feed_length']:.2f} mm at feed; nothing to compare"
            elif off and program["file"] == "lc_g6_gear.ngc" or off and "G5" in program["exercises"]:
                details = "splines have no length in the manifest: " + off[0]
                count["nothing to compare"] += 1
            elif off:
                details, bad = "; ".join(off + [f"kinecut: {v}" for v in sheet.get("remarks", [])[:1]]), bad + 1
                count["off"] += 1
            else:
                count["equal"] += 1
                details = f"{sheet['feed_length']:.2f} mm at feed"
            if oracle and kinecut.binary != "same":
                details += again(path, control, kinecut, oracle, judge)
        except kinecut_reads.Refused as why:
            result, details = ("CRASH", str(why)) if why.message.startswith("CRASH") else ("refuses", str(why))
            bad += result == "CRASH"
        count[result] += 1
        if result == "refuses" and judge.get("accepted"):
            details += "   <- the interpreter reads it"
        print(f"{program['file']:28} {control:15} {theirs:12} {result:9} {details[:220]}", flush=True)
    print("\n* after lines with only % were taken out and M2 was added\n")
    heads = ("programs", "reads", "refuses", "CRASH", "equal", "off", "nothing to compare")
    print(f"{'family':12} " + " ".join(f"{h:>18}" for h in heads))
    for family, count in [*families.items(), ("all", sum(families.values(), collections.Counter()))]:
        print(f"{family:12} " + " ".join(f"{count[h]:18}" for h in heads))
    sys.exit(1 if bad else 0)


def again(path, control, kinecut, oracle, judge):
    """Whether the interpreter takes what kinecut writes for LinuxCNC, and what it makes of it."""
    try:
        posted, _ = kinecut.post(path, control=control)
    except kinecut_reads.Refused as why:
        return f"; no post: {why}"
    table = {n: (0, 0, 0, 1) for n in {int(n) for n in re.findall(r"[TH](\d+)", posted)}}
    error, _, events = oracle.run(posted, table=table)
    if error:
        return f"; the interpreter refuses the post: {error[0]} | {error[1]}"
    length = sum(e["piece"].length for e in events if e["kind"] == "feed")
    want = judge.get("feed_length_mm") or length
    return "" if abs(length - want) < max(2e-3 * want, 0.02) else f"; the post is {length:.2f} mm long by the interpreter"


# Machines of programs that turn axes; the last has the codes of LinuxCNC's own five-axis configurations.
FIVE_AXES = 'preset = "trt_xyzac"\ncodes = { M428 = "tip-control", M429 = "no-tip-control" }\n'


def read(kinecut, path, control):
    """What kinecut says of a program; where it wants a machine, on the first that has its axes."""
    try:
        return kinecut.check(path, control)
    except kinecut_reads.Refused as why:
        if not any(words in str(why) for words in ("no machine with rotary axes", "M428")):
            raise
        first = why
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as machine:
        machine.write(FIVE_AXES)
        machine.flush()
        for on in ("mill4_xyza", "trt_xyzac", "trt_xyzbc", machine.name):
            try:
                return kinecut.check(path, control, machine=on)
            except kinecut_reads.Refused:
                continue
    raise first


def own(oracle, text):
    """The interpreter in place of kinecut, to try the comparison."""
    error, lines, events = oracle.run(text, table={n: (0, 0, 0, 1) for n in {int(n) for n in re.findall(r"[TH]\s*(\d+)", text)}})
    if error:
        raise kinecut_reads.Refused(f"{error[0]} | {error[1]}", *lines[:1])
    pieces = [e["piece"] for e in events if e["kind"] == "feed"]
    points = [p.at(p.length * n / 32) for p in pieces for n in range(33)]
    box = [[f(p[i] for p in points) for i in range(3)] for f in (min, max)] if points else None
    return {"feed_length": sum(p.length for p in pieces), "range": box}


if __name__ == "__main__":
    main()
