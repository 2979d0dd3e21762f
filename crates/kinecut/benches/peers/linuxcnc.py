#!/usr/bin/env python3
"""Holds `interpolator = "linuxcnc"` against LinuxCNC's own trajectory planner, on programs of three axes.

    crates/kinecut/benches/peers/linuxcnc.py [--source FOLDER] [--kinecut BINARY] [--acceleration 500] PROGRAM...
    crates/kinecut/benches/peers/linuxcnc.py --random 300

The planner (src/emc/tp) is compiled from a clone of LinuxCNC, which is fetched into target/peers where no folder is given. It runs
with the settings that come with it, cycle by cycle, over moves that `linuxcnc_moves.py` reads: neither shares code with kinecut.
Counted are moves alone, without waits and spindles. Of each program a copy runs that stands at zero first and changes no tools:
kinecut does not follow a move whose start nobody knows. Ends with 1 where a difference is over the bound.
"""

import argparse
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import linuxcnc_moves  # noqa: E402

ROOT = HERE.parents[3]
CLONE = "https://github.com/LinuxCNC/linuxcnc"
FOLDERS = ["rtapi", "libposemath", "emc/nml_intf", "emc/motion", "emc/tp", "emc/kinematics", "hal", "emc"]
SOURCES = ["emc/tp/*.c", "emc/tp/cruckig/*.c", "libposemath/_posemath.c", "libposemath/emcpose.c"]
APART = {"tpmod.c", "scurve_analytic_test.c"}  # a module of the real-time system, and a test


def options():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("programs", nargs="*", type=pathlib.Path)
    ask.add_argument("--source", type=pathlib.Path, default=os.environ.get("LINUXCNC"), help="a clone of LinuxCNC; default: $LINUXCNC")
    ask.add_argument("--work", type=pathlib.Path, default=ROOT / "target/peers")
    ask.add_argument("--kinecut", default=os.environ.get("KINECUT"), help="the binary; default: $KINECUT, then a build by cargo")
    ask.add_argument("--rapid", type=float, default=10000, help="of X and Y, mm/min; Z has 0.6 of it")
    ask.add_argument("--acceleration", type=float, default=500, help="of Z, mm/s2; X and Y have 1.5 of it")
    ask.add_argument("--bound", type=float, default=3, help="largest difference, percent")
    ask.add_argument("--random", type=int, default=0, help="programs at random, with limits at random")
    ask = ask.parse_args()
    if not ask.programs and not ask.random:
        sys.exit("no programs: give some files, or --random 300")
    return ask


def compiled(ask):
    """The planner as a program; compiled again where its sources have changed."""
    source = ask.source
    if not source:
        source = ask.work / "linuxcnc"
        if not source.exists():
            subprocess.run(["git", "clone", "--quiet", "--depth", "1", CLONE, source], check=True)
    source = pathlib.Path(source) / "src"
    inputs = [f for pattern in SOURCES for f in sorted(source.glob(pattern)) if f.name not in APART]
    if not inputs:
        sys.exit(f"{source}: no sources of LinuxCNC 2.10")
    binary = ask.work / "linuxcnc_tp"
    driver = HERE / "linuxcnc_tp.c"
    if not binary.exists() or binary.stat().st_mtime < max(f.stat().st_mtime for f in [*inputs, driver]):
        ask.work.mkdir(parents=True, exist_ok=True)
        include = [f"-I{source / folder}" for folder in FOLDERS]
        subprocess.run(["cc", "-O2", "-w", "-DULAPI", "-D_GNU_SOURCE", *include, driver, *inputs, "-o", binary, "-lm"], check=True)
    return binary


def planner_time(binary, program):
    moves = "\n".join(program.canon.out) + "\n"
    done = subprocess.run([binary], input=moves, text=True, capture_output=True, check=True)
    return float(done.stdout.strip().split("\n")[-1].split()[1])


def kinecut_time(binary, path, limits):
    """Time of the moves, and how long their path is by their feeds."""
    axes = "\n".join(
        f"[axis.{letter}]\nrapid = {v * 60}\nacceleration = {a / 1000}\njerk = 1000" for letter, (v, a) in zip("XYZ", limits)
    )
    with tempfile.TemporaryDirectory() as folder:
        machine = pathlib.Path(folder) / "machine.toml"
        machine.write_text(f'code = "2103"\ndynamics = {{ interpolator = "linuxcnc" }}\n{axes}\n')
        command = [binary, "--json", "time", path, "--control", "linuxcnc", "--machine", machine]
        done = subprocess.run(command, text=True, capture_output=True)
    try:
        shares = json.loads(done.stdout)["shares"]
    except (ValueError, KeyError):
        said = re.search(r'"message": "([^"]*)"', done.stderr + done.stdout)
        raise linuxcnc_moves.Refused(f"kinecut: {said[1] if said else done.stderr.strip()}") from None
    return shares["feed"] + shares["rapid"]


def bare(path, folder):
    """A copy that stands at zero first and changes no tools."""
    lines = [re.sub(r"\bT\s*\d+\s*M0?6\b|\bM0?6\s*T\s*\d+\b|\bM0?6\b", "", line) for line in path.read_text(errors="replace").splitlines()]
    lines.insert(1 if lines and lines[0].startswith("%") else 0, "G21 G90 G0 X0 Y0 Z0")
    copy = pathlib.Path(folder) / path.name
    copy.write_text("\n".join(lines) + "\n")
    return copy


def at_random(seed, folder):
    """A program of lines, arcs and helices, and limits for it."""
    r = random.Random(seed)
    scale = 10 ** r.uniform(1.7, 3.7)
    limits = [(r.uniform(50, 300), scale * r.uniform(0.5, 1.5)) for _ in range(3)]
    lines = ["G21 G90 G17 G94", f"G64 P{10 ** r.uniform(-3, 0):.4f} Q0" if r.random() < 0.7 else "G64", "G0 X0 Y0 Z0", "F2000"]
    x = y = z = 0.0
    size, heading = 10 ** r.uniform(-1, 1.5), r.uniform(0, math.tau)
    for _ in range(150):
        if r.random() < 0.1:
            lines.append(f"F{10 ** r.uniform(2.5, 4):.0f}")
        heading += r.gauss(0, 0.5) * 10 ** r.uniform(-2, 0.5)
        length = size * 10 ** r.uniform(-0.7, 0.7)
        x, y = round(x + length * math.cos(heading), 4), round(y + length * math.sin(heading), 4)
        if r.random() < 0.15:
            z = round(z + r.uniform(-length, length), 4)
        kind = r.random()
        if kind < 0.6 or kind > 0.92:
            lines.append(f"G{1 if kind < 0.6 else 0} X{x} Y{y} Z{z}")
        else:
            radius, ccw = length * r.uniform(0.6, 4), r.random() < 0.5
            lines.append(f"G{3 if ccw else 2} X{x} Y{y} Z{z} R{radius:.4f}")
            heading += math.asin(min(1, length / 2 / radius)) * (1 if ccw else -1)
    path = pathlib.Path(folder) / f"random_{seed}.ngc"
    path.write_text("\n".join([*lines, "M2"]) + "\n")
    return path, limits


def main():
    ask = options()
    planner = compiled(ask)
    binary = ask.kinecut
    if not binary:
        subprocess.run(["cargo", "build", "--release", "--quiet", "-p", "kinecut-cli"], cwd=ROOT, check=True)
        binary = ROOT / "target/release/kinecut"
    rapid, acceleration = ask.rapid / 60, ask.acceleration
    usual = [(rapid, 1.5 * acceleration)] * 2 + [(0.6 * rapid, acceleration)]
    worst, compared = 0.0, 0
    print(f"{'program':32} {'moves':>7} {'way, mm':>10} {'LinuxCNC, s':>12} {'kinecut, s':>12} {'':>8}")
    with tempfile.TemporaryDirectory() as folder:
        some = [(bare(path, folder), usual) for path in ask.programs] + [at_random(seed, folder) for seed in range(ask.random)]
        for path, limits in some:
            try:
                program = linuxcnc_moves.Program(path.read_text(errors="replace"), limits)
                theirs, ours = planner_time(planner, program), kinecut_time(binary, path, limits)
            except linuxcnc_moves.Refused as why:
                print(f"{path.name:32} not compared: {why}")
                continue
            off = 100 * (ours / theirs - 1)
            worst, compared = max(worst, abs(off)), compared + 1
            print(f"{path.name:32} {program.canon.count:7} {program.canon.path:10.1f} {theirs:12.3f} {ours:12.3f} {off:+7.3f}%", flush=True)
    print(f"{compared} compared, the worst {worst:.3f}% off")
    sys.exit(0 if compared and worst <= ask.bound else 1)


if __name__ == "__main__":
    main()
