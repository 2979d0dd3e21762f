#!/usr/bin/env python3
"""What LinuxCNC's own interpreter makes of a program, and where two programs differ by it.

    rs274_oracle.py --oracle ROOT ONE.ngc [OTHER.ngc]     the moves of one program, or the differences of two

The interpreter comes out of two packages of Debian 12, unpacked beside each other, not installed:

    apt-get download linuxcnc-uspace libboost-python1.74.0
    for p in *.deb; do dpkg -x $p ROOT; done

ROOT is then the argument --oracle or the variable RS274_ROOT. Two ways in are used together. `rs274 -g` prints every canonical
call, but with 4 decimals, without the points of splines, and its machine counts in inches (tool table and parameters 5161, 5221
and on). The Python module `gcode` of the same package hands out moves in full precision, splines as points, lines as numbers, and
its machine can count in millimetres; it is silent about spindle, coolant and stops. Calls and their order come from the first,
numbers from the second. `gcode` is built for Python 3.11.

Interpreters that run at the same time need a HOME each: the tool table is a shared file there (.tool.mmap).
"""

import argparse
import bisect
import copy
import ctypes
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
INCH = 25.4
TABLE = {1: (0, 0, 10, 5), 2: (1, 2, 20, 6), 3: (0, 0, -5, 8), 4: (0.5, -0.25, 33.125, 10)}  # number: X Y Z and diameter, mm
LINEAR = [n for first in (5161, 5181, 5211, *range(5221, 5400, 20)) for n in (*range(first, first + 3), *range(first + 6, first + 9))]
STATE = ("tool", "turn", "rpm", "surface", "flood", "mist")
PLANES = {"XY": (0, 1, 2), "YZ": (1, 2, 0), "XZ": (2, 0, 1)}


class Failed(Exception):
    """The oracle itself did not run."""


def environment(root, home):
    lib = pathlib.Path(root) / "usr/lib"
    return os.environ | {"HOME": str(home), "LD_LIBRARY_PATH": f"{lib}:{lib / 'x86_64-linux-gnu'}", "PYTHONDONTWRITEBYTECODE": "1",
                         "PYTHONPATH": str(lib / "python3/dist-packages")}


def tool_lines(table, unit):
    return "".join(f"T{n} P{n} X{x / unit:.9f} Y{y / unit:.9f} Z{z / unit:.9f} D{d / unit:.9f}\n" for n, (x, y, z, d) in table.items())


def var_lines(values, unit):
    """A parameter file; lengths in millimetres by number."""
    values = {5220: 1} | values
    return "".join(f"{n} {v / unit if n in LINEAR else v:.9f}\n" for n, v in sorted(values.items()))


class Oracle:
    """Runs texts. `table`: tools as in TABLE; `values`: parameters at the start, lengths in mm; `files`: others beside the program."""

    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        self.binary = self.root / "usr/bin/rs274"
        if not self.binary.exists():
            sys.exit(f"{root}: no usr/bin/rs274 there; see the head of rs274_oracle.py")
        self.folder, self.printed = tempfile.TemporaryDirectory(), ""
        self.begin()

    def begin(self):
        self.worker = subprocess.Popen([sys.executable, __file__, "--worker"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                       env=environment(self.root, self.folder.name), cwd=self.folder.name)

    def run(self, text, table=None, values=None, files=None, ini=None, beside=None):
        """(error, lines, events): error is None or (message, text of the line); lines: where that text stands, from 1."""
        table, values = TABLE if table is None else table, values or {}
        with tempfile.TemporaryDirectory(dir=self.folder.name) as folder:
            folder = pathlib.Path(folder)
            for name, content in ({"p.ngc": text} | (files or {})).items():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
            if beside:
                for file in pathlib.Path(beside).rglob("*.ngc"):
                    to = folder / file.relative_to(beside)
                    to.parent.mkdir(parents=True, exist_ok=True)
                    if not to.exists():
                        to.write_bytes(file.read_bytes())
            (folder / "inch.tbl").write_text(tool_lines(table, INCH))
            (folder / "inch.var").write_text(var_lines(values, INCH))
            (folder / "mm.tbl").write_text(tool_lines(table, 1))
            (folder / "mm.var").write_text(var_lines(values, 1))
            command = [self.binary, "-t", "inch.tbl", "-v", "inch.var"]
            if ini:
                (folder / "i.ini").write_text(ini)
                command += ["-i", "i.ini"]
            try:
                said = subprocess.run([*command, "-g", "p.ngc"], cwd=folder, env=environment(self.root, folder), text=True, errors="replace",
                                      capture_output=True, stdin=subprocess.DEVNULL, timeout=60)
            except subprocess.TimeoutExpired:
                return ("it does not end", ""), [], []
            error = None
            if said.returncode:
                rest = [line for line in said.stderr.splitlines() if line not in ("executing", "")]
                error = (rest[-2] if len(rest) > 1 else " ".join(rest) or f"ended with {said.returncode}", rest[-1] if len(rest) > 1 else "")
            exact = self.exact(folder, table, bool(ini))
        lines = []
        if error:
            lines = [n for n, line in enumerate(text.splitlines(), 1) if same_line(line, error[1])]
        self.printed = said.stdout
        return error, lines, merged(said.stdout, exact)

    def exact(self, folder, table, ini):
        job = {"folder": str(folder), "table": table, "ini": ini}
        for _ in range(4):  # the module crashes now and then, by what lay in memory before: a new process does not
            self.worker.stdin.write(json.dumps(job) + "\n")
            self.worker.stdin.flush()
            out = self.worker.stdout.readline()
            if not out:
                raise Failed("the module gcode does not run: it wants Python 3.11")
            found = json.loads(out)
            if found["error"] != "gcode: it crashed":
                break
            self.worker.stdin.close()
            self.worker.wait()
            self.begin()
        return found


def same_line(line, text):
    bare = lambda v: re.sub(r"\s+", "", v).lower()
    return bool(text) and bare(line) == bare(text)


# The part that runs with the module `gcode` in its path.


class Canon:
    """Notes what the interpreter calls; lengths as it gives them, in inches."""

    def __init__(self, table, var):
        self.out, self.rows, self.spindle, self.parameter_file = [], list(table.items()), 0, var

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *numbers: self.out.append([name, *numbers])

    def next_line(self, state):
        self.out.append(["line", state.sequence_number])

    def change_tool(self, number):
        self.spindle = number
        self.out.append(["change_tool", number])

    def get_tool(self, index):
        number, row = 0, (0, 0, 0, 0)
        if index == 0 and self.spindle:
            number, row = self.spindle, dict(self.rows).get(self.spindle, row)
        elif 1 <= index <= len(self.rows):
            number, row = self.rows[index - 1]
        elif index:
            number = -1
        x, y, z, d = map(float, row)
        return (number, x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, d, 0.0, 0.0, 0)

    get_external_length_units = get_external_angular_units = lambda self: 1.0
    get_axis_mask = lambda self: 0x3F
    get_block_delete = check_abort = lambda self: False


def one_exact(job):
    import gcode
    folder = pathlib.Path(job["folder"])
    os.chdir(folder)
    os.environ["HOME"] = str(folder)
    if job["ini"]:
        os.environ["INI_FILE_NAME"] = str(folder / "i.ini")
    tools = ctypes.CDLL("libtooldata.so.0", mode=ctypes.RTLD_GLOBAL)
    tools._Z17tool_mmap_creatorPK13EMC_TOOL_STATi(None, 0)
    tools._Z13tooldata_initb(False)
    tools._Z13tooldata_loadPKcPPc(b"mm.tbl", None)
    canon = Canon({int(n): row for n, row in job["table"].items()}, "mm.var")
    code, line = gcode.parse("p.ngc", canon, "G21", "")
    return {"error": gcode.strerror(code) if code > gcode.MIN_ERROR else None, "line": line, "calls": canon.out}


def work():
    """Each job in a process of its own: a crash of the module, or what it keeps, ends there."""
    import select
    import signal
    for job in sys.stdin:
        here, there = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(here)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # PRINT writes there
            try:
                found = one_exact(json.loads(job))
            except Exception as why:  # the parent wants an answer whatever happened
                found = {"error": f"gcode: {why}", "line": 0, "calls": []}
            with os.fdopen(there, "w") as pipe:
                json.dump(found, pipe)
            os._exit(0)
        os.close(there)
        got = b""
        while select.select([here], [], [], 60)[0]:
            part = os.read(here, 1 << 20)
            if not part:
                break
            got += part
        else:
            os.kill(child, signal.SIGKILL)
        os.close(here)
        os.waitpid(child, 0)
        try:
            json.loads(got)
        except ValueError:
            got = b'{"error": "gcode: it crashed", "line": 0, "calls": []}'
        print(got.decode(), flush=True)


# From calls to motion in machine coordinates, mm.

CALL = re.compile(r"([A-Z][A-Z0-9_.]*)\((.*)\)$")
MOVES = {"STRAIGHT_TRAVERSE": "straight_traverse", "STRAIGHT_FEED": "straight_feed", "ARC_FEED": "arc_feed", "RIGID_TAP": "rigid_tap",
         "STRAIGHT_PROBE": "straight_probe", "NURBS_FEED": "straight_feed"}


def calls_of(printed):
    for line in printed.splitlines():
        found = CALL.search(re.sub(r"^\s*\d+\s+N\S+\s+", "", line.strip()).removeprefix("N..... "))
        if found:
            yield found[1], found[2]


def numbers(text):
    return [float(v) for v in re.findall(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?", text)]


class Frame:
    """Offsets in force: from program coordinates to those of the machine."""

    def __init__(self):
        self.g5x, self.g92, self.tool, self.angle = [0.0] * 3, [0.0] * 3, [0.0] * 3, 0.0

    def machine(self, p):
        x, y, z = (a + b for a, b in zip(p, self.g92))
        c, s = math.cos(self.angle), math.sin(self.angle)
        return tuple(a + b + t for a, b, t in zip((c * x - s * y, s * x + c * y, z), self.g5x, self.tool))

    def program(self, q):
        x, y, z = (a - b - t for a, b, t in zip(q, self.g5x, self.tool))
        c, s = math.cos(self.angle), math.sin(self.angle)
        return tuple(a - b for a, b in zip((c * x + s * y, c * y - s * x, z), self.g92))


class Line:
    def __init__(self, a, b):
        self.a, self.b, self.length = a, b, math.dist(a, b)

    def at(self, s):
        t = s / self.length if self.length else 0
        return tuple(p + t * (q - p) for p, q in zip(self.a, self.b))


class Arc:
    """Arc or helix in a plane of program coordinates; a radius that changes does so evenly."""

    def __init__(self, start, end, centre, axes, turns, place):
        i, j, k = axes
        self.axes, self.centre, self.place = axes, centre, place
        a0 = math.atan2(start[j] - centre[1], start[i] - centre[0])
        a1 = math.atan2(end[j] - centre[1], end[i] - centre[0])
        if turns > 0:
            while a1 <= a0 + 1e-6:  # as the control's motion takes it: an end that is the start but for rounding is a whole turn
                a1 += math.tau
        else:
            while a1 >= a0 - 1e-6:
                a1 -= math.tau
        self.a0, self.sweep = a0, a1 - a0 + math.tau * (turns - 1 if turns > 0 else turns + 1)
        self.r0, self.r1 = (math.hypot(p[i] - centre[0], p[j] - centre[1]) for p in (start, end))
        self.z0, self.z1, self.rest = start[k], end[k], list(end)
        self.length = math.hypot((self.r0 + self.r1) / 2 * self.sweep, self.z1 - self.z0, self.r1 - self.r0)
        self.b = self.at(self.length)

    def at(self, s):
        t = s / self.length if self.length else 1
        r, a, p = self.r0 + t * (self.r1 - self.r0), self.a0 + t * self.sweep, self.rest[:]
        i, j, k = self.axes
        p[i], p[j], p[k] = self.centre[0] + r * math.cos(a), self.centre[1] + r * math.sin(a), self.z0 + t * (self.z1 - self.z0)
        return self.place(p)


def merged(printed, exact):
    """Events: dicts with `kind` and, for moves, the piece of path, its speed and the state of spindle and coolant."""
    calls = list(calls_of(printed))
    fine, line, at_line = [], 0, []
    for call in exact["calls"]:
        if call[0] == "line":
            line = call[1]
        else:
            fine.append(call)
            at_line.append(line)
    moves = [n for n, call in enumerate(fine) if call[0] in MOVES.values()]
    coarse = sum(name in MOVES and name != "NURBS_FEED" for name, _ in calls)
    if not any(name == "NURBS_FEED" for name, _ in calls) and len(moves) != coarse:
        return [{"kind": "split", "text": f"rs274 has {coarse} moves, gcode {len(moves)}"}]
    events, frame, point, next_fine, axes = [], Frame(), (0.0, 0.0, 0.0), 0, PLANES["XY"]
    before, there = point, point
    state = {"tool": 0, "turn": 0, "rpm": 0.0, "surface": 0.0, "flood": 0, "mist": 0, "per_turn": False, "rate": 0.0, "path": "", "line": 0}

    def event(kind, **more):
        events.append({"kind": kind, "line": state["line"], **more,
                       "state": tuple(state[k] if state["turn"] or k not in ("rpm", "surface") else 0 for k in STATE), "path": state["path"]})

    def settle(upto):
        """Offsets of the fine calls before a move; planes, feeds and the rest come with the printed ones."""
        nonlocal next_fine
        while next_fine < upto:
            name, *v = fine[next_fine]
            if name == "set_g5x_offset":
                frame.g5x = [n * INCH for n in v[1:4]]
            elif name == "set_g92_offset":
                frame.g92 = [n * INCH for n in v[:3]]
            elif name == "set_xy_rotation":
                frame.angle = math.radians(v[0])
            elif name == "tool_offset":
                frame.tool = [n * INCH for n in v[:3]]
            elif name == "set_feed_rate":
                state["rate"] = v[0] * INCH
            elif name == "dwell":
                state["dwell"] = v[0]
            next_fine += 1

    order, unit, geared = iter(moves), 1.0, None

    def take(name):
        nonlocal point
        index = next(order)
        settle(index)
        next_call = fine[index]
        if next_call[0] != MOVES[name]:
            raise Failed(f"rs274 says {name}, gcode {next_call[0]}")
        state["line"] = at_line[index]
        return index, next_call[1:]

    try:
        for name, text in calls:
            v = numbers(text) if name not in ("COMMENT", "MESSAGE") else []
            if name in MOVES:
                group = [take(name)]
                if name != "NURBS_FEED" and apart(v[:2], [n * INCH / unit for n in group[0][1][:2]]) > 3e-4:
                    raise Failed(f"line {state['line']}: rs274 goes to {v[:3]}, gcode to {[n * INCH / unit for n in group[0][1][:3]]}")
                while name == "NURBS_FEED":  # the points of one block
                    after = next((m for m in moves if m > group[-1][0]), None)
                    if after is None or after != group[-1][0] + 1 or at_line[after] != at_line[group[-1][0]]:
                        break
                    group.append(take(name))
                for index, w in group:
                    # A change of offsets moves no axis: the place in the program changes.
                    start, point = there, frame.program(there)
                    speed = state["rate"] * (state["rpm"] if state["per_turn"] else 1) if geared is None else geared * state["rpm"]
                    if name == "ARC_FEED":
                        i, j, k = axes
                        end = [0.0] * 3
                        end[i], end[j], end[k] = w[0] * INCH, w[1] * INCH, w[5] * INCH
                        piece = Arc(point, end, (w[2] * INCH, w[3] * INCH), axes, w[4], copy.copy(frame).machine)
                        point = tuple(end)
                    else:
                        # The module gives the points of a spline a height of its own.
                        point = (w[0] * INCH, w[1] * INCH, point[2] if name == "NURBS_FEED" else w[2] * INCH)
                        piece = Line(start, frame.machine(point))
                    kind = {"STRAIGHT_TRAVERSE": "rapid", "RIGID_TAP": "tap", "STRAIGHT_PROBE": "probe"}.get(name, "feed")
                    event(kind, piece=piece, speed=speed, spline=name == "NURBS_FEED", rotary=tuple(w[3:6]) if len(w) == 9 else ())
                    if name == "RIGID_TAP":
                        point = frame.program(start)
                    there = frame.machine(point)
                before = point
            elif name == "DWELL":
                event("dwell", seconds=v[0])
            elif name == "CHANGE_TOOL":
                state["tool"], state["turn"] = int(v[0]) if v else -1, 0
                event("change")
            elif name == "CHANGE_TOOL_NUMBER":
                state["tool"] = int(v[0])
            elif name == "SET_SPINDLE_SPEED":
                state["rpm"] = v[1]
            elif name == "SET_SPINDLE_MODE":
                state["surface"] = v[1] if v[1] < 1e20 else math.inf
            elif name in ("START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE", "STOP_SPINDLE_TURNING"):
                state["turn"] = {"START_SPINDLE_CLOCKWISE": 1, "START_SPINDLE_COUNTERCLOCKWISE": -1}.get(name, 0)
            elif name in ("FLOOD_ON", "FLOOD_OFF", "MIST_ON", "MIST_OFF"):
                state[name.split("_")[0].lower()] = int(name.endswith("ON"))
            elif name == "SET_FEED_MODE":
                state["per_turn"] = v[1] != 0
            elif name in ("START_SPEED_FEED_SYNC", "STOP_SPEED_FEED_SYNCH"):
                geared = v[0] * unit if v else None
            elif name == "USE_LENGTH_UNITS":
                unit = INCH if "INCH" in text else 1.0
            elif name == "SELECT_PLANE":
                axes = PLANES.get(text[-2:], axes)
            elif name in ("SET_MOTION_CONTROL_MODE", "SET_NAIVECAM_TOLERANCE"):
                state["path"] = text if name.startswith("SET_M") else f"{state['path']}, {v[0]:g}"
            elif name in ("PROGRAM_STOP", "OPTIONAL_PROGRAM_STOP", "PALLET_SHUTTLE", "ORIENT_SPINDLE"):
                event(name, text=text)
            elif name == "MESSAGE":
                event("message", text=text)
    except StopIteration:
        events.append({"kind": "split", "text": "gcode has fewer moves than rs274"})
    except Failed as why:
        events.append({"kind": "split", "text": str(why)})
    return events


# Comparing.


def trains(events):
    """Runs of moves of one kind, and what stands between them. Moves that go nowhere, and points on the way of a rapid, do not count."""
    out, seen = [], False
    for e in events:
        kind = e["kind"]
        if kind in ("message", "split"):
            continue
        if kind in ("rapid", "feed"):
            piece = e["piece"]
            rotary = e["rotary"] and seen and e["rotary"] != seen
            seen = e["rotary"] or seen
            if piece.length < 5e-5 and not rotary:
                continue
            if not out or out[-1]["kind"] != kind:
                out.append({"kind": kind, "state": e["state"], "pieces": [], "line": e["line"]})
            train = out[-1]
            if kind == "rapid" and train["pieces"] and straight_on(train["pieces"][-1]["piece"], piece):
                train["pieces"][-1] = e | {"piece": Line(train["pieces"][-1]["piece"].a, piece.b)}
            else:
                train["pieces"].append(e)
        elif kind != "dwell" or e["seconds"] > 0:
            out.append(e)
    while out and out[-1]["kind"] == "PALLET_SHUTTLE":  # of M30, which ends a program as M2 does
        out.pop()
    return out


def straight_on(a, b):
    if not (isinstance(a, Line) and isinstance(b, Line)) or min(a.length, b.length) == 0:
        return False
    u, w = ([(q - p) / l.length for p, q in zip(l.a, l.b)] for l in (a, b))
    return sum(x * y for x, y in zip(u, w)) > 0 and max(abs(x - y) for x, y in zip(u, w)) * b.length < 2e-5


class Way:
    """The path of a run by its length."""

    def __init__(self, train):
        self.pieces = [e["piece"] for e in train["pieces"]]
        self.ends, self.time, s = [], 0.0, 0.0
        for e in train["pieces"]:
            s += e["piece"].length
            self.ends.append(s)
            self.time += e["piece"].length / e["speed"] if e["speed"] else math.inf
        self.length, self.spline = s, any(e["spline"] for e in train["pieces"])

    def at(self, s):
        n = min(bisect.bisect_left(self.ends, s), len(self.ends) - 1)
        before = self.ends[n - 1] if n else 0.0
        return self.pieces[n].at(min(max(s - before, 0), self.pieces[n].length))


def apart(p, q):
    return max(abs(a - b) for a, b in zip(p, q))


def place(p):
    return "({:.4f}, {:.4f}, {:.4f})".format(*p)


def differences(ours, theirs, tolerance=1e-4):
    """What two lists of events differ in: (what, line in `theirs`, in words). Tolerance in mm. `theirs` is right."""
    found = []
    one, two = trains(ours), trains(theirs)
    for kind, name in (("feed", "feeds"), ("rapid", "rapids"), ("dwell", "dwells"), ("change", "tools"), ("tap", "taps"), ("probe", "probes")):
        a, b = ([t for t in each if t["kind"] == kind] for each in (one, two))
        if len(a) != len(b):
            found.append((name, None, f"{len(a)} in place of {len(b)}"))
    kinds = [[t["kind"] for t in each] for each in (one, two)]
    if kinds[0] != kinds[1]:
        n = next((n for n, (a, b) in enumerate(zip(*kinds)) if a != b), min(map(len, kinds)))
        here = two[n]["line"] if n < len(two) else None
        first = [k[n] if n < len(k) else "the end" for k in kinds]
        found.append(("order", here, f"{first[0]} in place of {first[1]}"))
        one, two = one[:n], two[:n]
    for a, b in zip(one, two):
        kind, line = b["kind"], b["line"]
        if a["state"] != b["state"] and kind in ("feed", "rapid", "tap", "dwell"):
            names = ("tool", "turning", "speed", "surface speed", "flood", "mist")
            off = [f"{n} {x:g} in place of {y:g}" for n, x, y in zip(names, a["state"], b["state"]) if abs(x - y) > 1e-3 * abs(y) + 1e-3]
            if off:
                found.append(("tools" if off[0].startswith("tool") else "spindle", line, ", ".join(off)))
        if kind == "rapid":
            ends = [[e["piece"].b for e in t["pieces"]] for t in (a, b)]
            if len(ends[0]) != len(ends[1]):
                found.append(("rapids", line, f"{len(ends[0])} ways in place of {len(ends[1])}: " + " ".join(map(place, ends[0][:4])) +
                              " | " + " ".join(map(place, ends[1][:4]))))
            else:
                off = next((n for n, (p, q) in enumerate(zip(*ends)) if apart(p, q) > tolerance), None)
                if off is not None:
                    found.append(("rapids", b["pieces"][off]["line"], f"to {place(ends[0][off])} in place of {place(ends[1][off])}"))
        elif kind == "feed":
            found += feed_differences(Way(a), Way(b), b, tolerance)
            if a["pieces"][0]["path"] != b["pieces"][0]["path"]:
                found.append(("path mode", line, f"{a['pieces'][0]['path']} in place of {b['pieces'][0]['path']}"))
        elif kind in ("tap", "probe"):
            if apart(a["piece"].b, b["piece"].b) > tolerance:
                found.append((kind + "s", line, f"to {place(a['piece'].b)} in place of {place(b['piece'].b)}"))
        elif kind == "dwell" and abs(a["seconds"] - b["seconds"]) > 1e-3:
            found.append(("dwells", line, f"{a['seconds']:g} s in place of {b['seconds']:g} s"))
    return list(dict.fromkeys(found))


def feed_differences(a, b, train, tolerance):
    # Radii at the two ends of an arc that differ by rounding leave its middle open.
    round_off = max((abs(p.r0 - p.r1) for p in b.pieces if isinstance(p, Arc)), default=0)
    loose = max(tolerance, 0.01 if a.spline or b.spline else 0, 1.5 * round_off if round_off < 5e-4 else 0)
    length = max(loose * (1 + len(b.ends) * 0.02), 2e-6 * b.length)
    if abs(a.length - b.length) > length:
        return [("feeds", train["line"], f"{a.length:.5f} mm at feed in place of {b.length:.5f}")]
    found = []
    places = sorted({s / b.length for s in b.ends} | {(s + t) / 2 / b.length for s, t in zip([0, *b.ends], b.ends)})
    for t in places:
        p, q = a.at(t * a.length), b.at(t * b.length)
        # A point of equal length moves along the way by what the lengths differ.
        if apart(p, q) > loose + abs(a.length - b.length):
            n = min(bisect.bisect_left(b.ends, t * b.length - 1e-9), len(b.ends) - 1)
            found.append(("feeds", train["pieces"][n]["line"], f"{place(p)} in place of {place(q)}"))
            break
    if math.isfinite(b.time) and abs(a.time - b.time) > (1e-2 if a.spline or b.spline else 2e-3) * b.time + 1e-6:
        found.append(("speed", train["line"], f"{a.time:.5f} min in place of {b.time:.5f}"))
    return found


def told(events):
    for e in events:
        if "piece" in e:
            print(f"line {e['line']}: {e['kind']} to {place(e['piece'].b)}" + (f", {e['piece'].length:.4f} mm, {e['speed']:g} mm/min"
                  if e["kind"] == "feed" else "") + f", {e['path']}")
        else:
            print(f"line {e.get('line')}: {e['kind']} {e.get('seconds', '')}{e.get('text', '')} {e.get('state', '')}")


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("programs", nargs="+", type=pathlib.Path)
    ask.add_argument("--oracle", default=os.environ.get("RS274_ROOT"), help="folder with the unpacked packages; default: $RS274_ROOT")
    ask = ask.parse_args()
    oracle = Oracle(ask.oracle or sys.exit("no oracle: give --oracle, or RS274_ROOT"))
    runs = [oracle.run(path.read_bytes().decode(errors="replace"), beside=path.parent) for path in ask.programs[:2]]
    for path, (error, lines, events) in zip(ask.programs, runs):
        if error or len(runs) == 1:
            print(f"{path}: {f'{error[0]} | {error[1]} | lines {lines}' if error else 'accepted'}")
    if len(runs) == 1:
        told(runs[0][2])
        return
    found = differences(runs[1][2], runs[0][2])
    for what, line, words in found:
        print(f"{what:10} line {line}: {words}")
    print(f"{len(found)} differences")
    sys.exit(1 if found or any(run[0] for run in runs) else 0)


if __name__ == "__main__":
    if sys.argv[1:] == ["--worker"]:
        work()
    else:
        main()
