#!/usr/bin/env python3
"""Compares the times of straight moves from rest to rest with those of ruckig (PyPI), block by block.

    crates/kinecut/benches/peers/ruckig_moves.py [--install] [--kinecut BINARY] [--machines 20] [--moves 50] [--seed 1]

Machines and moves are random: limits over three decades, ways from 1 um to 1 m, along one axis or along three, at a feed
that is reached or not. ruckig is asked along the way: of several axes it leaves the straight line.
"""

import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[3]
LOST = 5e-4  # Blocks that lose less are not listed.


def theirs(way, feed, limits):
    """Time of a move [s]: way in mm by axis, feed in mm/s, limits by axis."""
    from ruckig import InputParameter, Result, Ruckig, Trajectory

    length = math.hypot(*way)
    along = lambda kind: min(limits[a][kind] * length / abs(way[a]) for a in range(3) if way[a] != 0.0)
    given = InputParameter(1)
    given.current_position = [0.0]
    given.target_position = [length]
    given.max_velocity = [min(feed, along(0))]
    given.max_acceleration = [along(1)]
    given.max_jerk = [along(2)]
    trajectory = Trajectory(1)
    result = Ruckig(1).calculate(given, trajectory)
    if result not in (Result.Working, Result.Finished):
        sys.exit(f"ruckig: {result} for {way}, {feed}, {limits}")
    return trajectory.duration


def case(rng, count):
    """A machine file, a program, and for each line of a move what ruckig is asked."""
    power = lambda low, high: 10 ** rng.uniform(low, high)
    # As the machine file writes them: mm/min, m/s2, m/s3.
    written = [[round(v, 6) for v in (power(3, 5), power(-1, 2), power(0, 3))] for _ in range(3)]
    limits = [(rapid / 60, a * 1e3, j * 1e3) for rapid, a, j in written]
    machine = 'name = "random"\ncode = "2103"\n'
    for axis, (rapid, a, j) in zip("XYZ", written):
        machine += f"[axis.{axis}]\nrapid = {rapid}\nacceleration = {a}\njerk = {j}\n"
    lines = ["G21 G90 G94 G61.1 G54", "T1 M6", "G0 X0 Y0 Z0"]
    at, asked, axis = [0.0] * 3, {}, 0
    for _ in range(count):
        one = rng.random() < 0.5
        # Never straight on: a path that goes on as it was is not stopped on everywhere.
        axis = (axis + rng.randrange(1, 3)) % 3
        way = [0.0] * 3
        for a in range(3):
            if not one or a == axis:
                way[a] = round(math.copysign(power(-3, 3), -at[a] or 1.0), 4)
        if math.hypot(*way) == 0.0:
            continue
        feed = round(power(1, 5), 3)
        to = [round(p + w, 4) for p, w in zip(at, way)]
        way = [t - p for t, p in zip(to, at)]
        words = " ".join(f"{n}{v:.4f}" for n, v, w in zip("XYZ", to, way) if w != 0.0)
        lines.append(f"G1 {words} F{feed}")
        asked[len(lines)] = (way, feed / 60, limits)
        at = to
    lines.append("M2")
    return machine, "\n".join(lines) + "\n", asked


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("--install", action="store_true", help="ruckig by pip")
    ask.add_argument("--kinecut", default=os.environ.get("KINECUT", str(ROOT / "target/release/kinecut")))
    ask.add_argument("--machines", type=int, default=20)
    ask.add_argument("--moves", type=int, default=50)
    ask.add_argument("--seed", type=int, default=1)
    ask.add_argument("--keep", type=pathlib.Path, help="folder for the last machine and program")
    ask = ask.parse_args()
    if ask.install:
        subprocess.run([sys.executable, "-m", "pip", "install", "--break-system-packages", "-q", "ruckig"], check=True)
    rng = random.Random(ask.seed)
    compared, unlisted, worst, where = 0, 0, 0.0, ""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(ask.keep or folder)
        for _ in range(ask.machines):
            machine, program, asked = case(rng, ask.moves)
            (folder / "machine.toml").write_text(machine)
            (folder / "moves.ngc").write_text(program)
            command = [ask.kinecut, "time", "moves.ngc", "--control", "linuxcnc", "--machine", "machine.toml", "--json"]
            command += ["--slowest", str(2 * ask.moves)]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            if not done.stdout:
                sys.exit(done.stderr)
            listed = {block["line"]: block["time"] for block in json.loads(done.stdout)["slowest"]}
            for line, (way, feed, limits) in asked.items():
                time = theirs(way, feed, limits)
                if line not in listed:
                    # Then it must lose as little by ruckig.
                    lost = time - math.hypot(*way) / feed
                    if lost > LOST * 1.01:
                        sys.exit(f"{program.splitlines()[line - 1]}: {lost} s are lost by ruckig, and none here")
                    unlisted += 1
                    continue
                compared += 1
                off = abs(listed[line] / time - 1)
                if off > worst:
                    worst, where = off, f"{program.splitlines()[line - 1]}: {listed[line]:.9f} s, ruckig {time:.9f} s, {limits}"
    print(f"{compared} moves compared, {unlisted} lose less than {LOST} s by both; largest difference {worst:.1e}")
    print(where)


if __name__ == "__main__":
    main()
