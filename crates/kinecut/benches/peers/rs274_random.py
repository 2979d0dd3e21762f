#!/usr/bin/env python3
"""Random programs for LinuxCNC: kinecut reads each and writes it again, the interpreter judges whether both texts move alike.

    rs274_random.py --kinecut target/release/kinecut --oracle ROOT --count 2000 --seed 1
    rs274_random.py --kinecut target/release/kinecut --oracle ROOT --features arcs,planes,units
    rs274_random.py --kinecut target/release/kinecut --oracle ROOT --features all,-splines,-m98 --shrink 5

For the oracle see rs274_oracle.py. Compared are feed runs at equal length of way, their time, ends of rapids, dwells, tool changes,
stops, spindle and coolant; a program that the interpreter refuses is to be refused. Its one known mistake is not drawn: a length
taken up before a change of unit is not converted in G53, G28, G30. Each program comes from the seed and its number
alone. Failing ones are kept in --keep, the first of each kind also without the lines that it fails without. Ends with 1 where one
fails. `--kinecut same` and `--kinecut altered` try the judge itself: it must find nothing, and something in nearly all.
"""

import argparse
import collections
import multiprocessing
import os
import pathlib
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import kinecut_reads  # noqa: E402
import rs274_oracle  # noqa: E402
import rs274_programs  # noqa: E402

HERE = {}


def options():
    groups = "; ".join(f"{name} ({what})" for name, what in rs274_programs.GROUPS.items())
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0], epilog=f"features: {groups}")
    ask.add_argument("--seed", type=int, default=1)
    ask.add_argument("--count", type=int, default=2000)
    ask.add_argument("--first", type=int, default=0, help="number of the first program")
    ask.add_argument("--kinecut", default=os.environ.get("KINECUT"), help="the binary; default: $KINECUT")
    ask.add_argument("--oracle", default=os.environ.get("RS274_ROOT"), help="folder with the unpacked packages; default: $RS274_ROOT")
    ask.add_argument("--features", default="all", help="groups with commas between them; `all` and then -group leaves groups out")
    ask.add_argument("--jobs", type=int, default=1, help="processes")
    ask.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("out/rs274_failing"), help="folder for failing programs")
    ask.add_argument("--shrink", type=int, default=0, help="how many failing programs, each of another kind, are made short")
    ask.add_argument("--tolerance", type=float, default=1e-4, help="of places, mm")
    ask.add_argument("--bare", action="store_true", help="kinecut gets the program alone, without tool table and parameters of the machine")
    ask.add_argument("--path-mode", action="store_true", help="count other G61 and G64 as a failure")
    ask.add_argument("--messages", action="store_true", help="count operator messages that are lost as a failure")
    ask = ask.parse_args()
    if not ask.kinecut or not ask.oracle:
        sys.exit("give --kinecut and --oracle, or KINECUT and RS274_ROOT")
    ask.kinecut = ask.kinecut if ask.kinecut in ("same", "altered") else str(pathlib.Path(ask.kinecut).resolve())
    groups = set()
    for name in ask.features.split(","):
        if name == "all":
            groups |= set(rs274_programs.GROUPS) - rs274_programs.OFF
        elif name.lstrip("-") not in rs274_programs.GROUPS:
            sys.exit(f"no group {name}: " + ", ".join(rs274_programs.GROUPS))
        elif name.startswith("-"):
            groups.discard(name[1:])
        else:
            groups.add(name)
    ask.groups = frozenset(groups)
    return ask


def start(ask):
    HERE.update(ask=ask, oracle=rs274_oracle.Oracle(ask.oracle), kinecut=kinecut_reads.Kinecut(ask.kinecut))


def judged(text):
    """(kind, details): kind is `equal`, `refused rightly`, or what is wrong; `none` where the oracle does not serve."""
    ask, oracle = HERE["ask"], HERE["oracle"]
    error, lines, events = oracle.run(text)
    if any(e["kind"] == "split" for e in events):
        return "none", [next(e["text"] for e in events if e["kind"] == "split")]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        path = folder / "p.ngc"
        path.write_text(text)
        (folder / "tool.tbl").write_text(rs274_oracle.tool_lines(rs274_oracle.TABLE, 1))
        (folder / "kept.var").write_text(rs274_oracle.var_lines({}, 1))
        try:
            posted, _ = HERE["kinecut"].post(path, kept=None if ask.bare else folder)
        except kinecut_reads.Refused as why:
            if error:
                rightly = not lines or why.line in lines
                return "refused rightly", [f"{why} | {error[0]} | {error[1]} | {'same' if rightly else 'another'} line"]
            # In a program of many lines the line that is refused says more than its number.
            source = text.splitlines()[why.line - 1] if why.line and why.line <= text.count("\n") else ""
            return ("crash" if why.message.startswith("CRASH") else "refused"), [f"{why} | {source}"]
    if error:
        if HERE["kinecut"].binary in ("same", "altered"):
            return "refused rightly", [f"{error[0]} | {error[1]} | same line"]
        return "accepted wrongly", [f"{error[0]} | {error[1]}"]
    again, _, theirs = oracle.run(posted)
    if again:
        return "post refused", [f"{again[0]} | {again[1]}"]
    split = next((e["text"] for e in theirs if e["kind"] == "split"), None)
    if split:
        return "none", [f"of the post: {split}"]
    found = rs274_oracle.differences(theirs, events, ask.tolerance)
    if ask.messages:
        texts = [[e["text"] for e in each if e["kind"] == "message"] for each in (theirs, events)]
        if texts[0] != texts[1]:
            found.append(("messages", None, f"{texts[0]} in place of {texts[1]}"))
    found = [f for f in found if f[0] != "path mode" or ask.path_mode]
    if not found:
        return "equal", []
    source = text.splitlines()
    there = lambda line: f" | {source[line - 1]}" if line and line <= len(source) else ""
    told = [f"{what} at line {line}: {words}{there(line)}" for what, line, words in found]
    return f"differs: {found[0][0]}", told


def signature(kind, details):
    """Failing programs of one kind: numbers and names do not count."""
    if kind.startswith("differs"):
        source = details[0].rsplit(" | ", 1)
        codes = re.findall(r"[GM]\s*\d+(?:\.\d)?", re.sub(r"\[.*?\]|\(.*?\)", "", source[1].upper())) if len(source) > 1 else []
        return f"{kind}, {' '.join(sorted(c for c in codes if c not in ('G90', 'G91', 'G98', 'G99'))) or 'no code in the line'}"
    text = details[0].split(" | ")[0] if details else ""
    word = re.search(r"`\s*([GM]\d+(?:\.\d)?)|`(#|o)", text, re.I)
    bare = re.sub(r"^\S+:\S+ ", "", text)
    return f"{kind}: {(word[1] or word[2]).upper() if word else ''} " + re.sub(r"`[^`]*`|'[^']*'|#<[^>]*>|-?\d[\d.]*", "_", bare)[:90]


def one(number):
    ask = HERE["ask"]
    text = rs274_programs.Program(f"{ask.seed}/{number}", ask.groups).text
    try:
        kind, details = judged(text)
    except rs274_oracle.Failed as why:
        kind, details = "none", [str(why)]
    return number, text, kind, details


def shrunk(text, wanted, tries=400):
    """The text without the lines that it fails without; the interpreter must take what is left, if it took all."""
    lines = [line for line in text.splitlines() if line.strip()]
    place = re.compile(r"(?i)(?=.*G0?0(?!\d))(?=.*X)(?=.*Y).*Z")
    stays = next((line for line in lines if place.match(line)), None)  # the place of a feed move must be known
    part = max(len(lines) // 2, 1)
    while part and tries:
        n, smaller = 0, False
        while n < len(lines) and tries:
            rest = lines[:n] + lines[n + part:]
            tries -= 1
            if rest and (stays is None or stays in rest) and signature(*judged("\n".join(rest) + "\n")) == wanted:
                lines, smaller = rest, True
            else:
                n += part
        if not smaller or part > 1:
            part = part // 2 if part > 1 else 0
    return "\n".join(lines) + "\n"


def main():
    ask = options()
    counts, kinds, groups, right = collections.Counter(), collections.Counter(), {}, 0
    numbers = range(ask.first, ask.first + ask.count)
    with multiprocessing.Pool(ask.jobs, start, (ask,)) if ask.jobs > 1 else None or Alone(ask) as pool:
        for number, text, kind, details in pool.imap(one, numbers, 8):
            rs274_programs.count(text, counts)
            kinds[kind] += 1
            if kind == "refused rightly":
                right += details[0].endswith("same line")
            if kind in ("equal", "refused rightly"):
                continue
            ask.keep.mkdir(parents=True, exist_ok=True)
            note = "".join(f"; {line}\n" for line in [kind, *details])
            (ask.keep / f"{ask.seed}_{number}.ngc").write_text(text + note)
            groups.setdefault(signature(kind, details), []).append((number, text, details))
    if ask.jobs > 1:
        start(ask)
    words = sorted(counts.items())
    print("words in these programs, how often:")
    for n in range(0, len(words), 9):
        print("  " + "  ".join(f"{w:>12} {c:<6}" for w, c in words[n:n + 9]).rstrip())
    rare = [w for w, c in words if c < 20]
    print(f"fewer than 20 times: {', '.join(rare) or 'none'}\n")
    print(f"{'result':24} {'programs':>8}")
    for kind, n in kinds.most_common():
        print(f"{kind:24} {n:8}" + (f"   {right} on the line of the interpreter" if kind == "refused rightly" else ""))
    failing = sorted(groups.items(), key=lambda g: -len(g[1]))
    print(f"\n{'kinds of failure':100} {'programs':>8}")
    for name, those in failing[:60]:
        print(f"{name[:100]:100} {len(those):8}   first {those[0][0]}")
        print(f"      {those[0][2][0][:180] if those[0][2] else ''}")
    for name, those in failing[:ask.shrink]:
        number, text, _ = min(those, key=lambda t: len(t[1]))
        small = shrunk(text, name)
        kind, details = judged(small)
        note = "".join(f"; {line}\n" for line in [kind, *details])
        (ask.keep / f"{ask.seed}_{number}_short.ngc").write_text(small + note)
        print(f"\n{ask.seed}/{number}, made short:\n{small}{note}", end="", flush=True)
    sys.exit(1 if groups else 0)


class Alone:
    """A pool of this process alone."""

    def __init__(self, ask):
        start(ask)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def imap(self, work, numbers, _):
        return map(work, numbers)


if __name__ == "__main__":
    main()
