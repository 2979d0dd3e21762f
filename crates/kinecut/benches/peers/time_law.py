#!/usr/bin/env python3
"""Times toppra (PyPI) on the path of `cargo bench --bench motion`, without jerk limits, on the same number of cells.

    crates/kinecut/benches/peers/time_law.py [--install] [--cells 100000]

Prints both times and the times along the path that both find: only then were both asked the same.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
CELL, WAVE, SWAY, FEED = 0.2, 160.0, 2.0, 300.0


def derivatives(s):
    import numpy as np

    w = 2 * np.pi / WAVE
    swell = 1 + 0.3 * np.sin(0.1 * w * s)
    angle = SWAY * swell * np.sin(w * s)
    bend = SWAY * swell * w * np.cos(w * s)
    return np.cos(angle), np.sin(angle), -bend * np.sin(angle), bend * np.cos(angle)


def toppra_time(cells):
    """Seconds that toppra takes, and the time along the path."""
    import numpy as np
    import toppra
    from toppra import algorithm, constraint
    from toppra.interpolator import AbstractGeometricPath

    toppra.setup_logging("ERROR")

    class Wave(AbstractGeometricPath):
        """Two axes, and the way itself, whose speed is the feed."""

        def __call__(self, s, order=0):
            s = np.asarray(s, dtype=float)
            x, y, bx, by = derivatives(s)
            rows = {0: (s, s, s), 1: (x, y, np.ones_like(s)), 2: (bx, by, np.zeros_like(s))}[order]
            return np.stack(rows, axis=-1)

        dof = property(lambda self: 3)
        path_interval = property(lambda self: np.array([0.0, CELL * cells]))
        waypoints = property(lambda self: None)

    speed = np.array([[-500.0, 500.0], [-500.0, 500.0], [-FEED, FEED]])
    acceleration = np.array([[-5000.0, 5000.0], [-5000.0, 5000.0], [-1e9, 1e9]])
    grid = np.linspace(0, CELL * cells, cells + 1)
    start = time.time()
    limits = [constraint.JointVelocityConstraint(speed), constraint.JointAccelerationConstraint(acceleration)]
    found = algorithm.TOPPRA(limits, Wave(), gridpoints=grid, solver_wrapper="seidel").compute_parameterization(0, 0)
    rate = found[1]
    used = time.time() - start
    return used, float(np.sum(2 * np.diff(grid) / (rate[1:] + rate[:-1])))


def kinecut_time(cells):
    """Seconds that kinecut takes: the fastest of the samples of its bench."""
    command = ["cargo", "bench", "--bench", "motion", "--", "without_jerk_limits"]
    shown = subprocess.run(command, cwd=HERE.parents[2], check=True, capture_output=True, text=True).stdout
    row = re.search(rf"─ {cells}\s+([\d.]+) (ns|µs|ms|s)", shown)
    if not row:
        sys.exit(f"the bench has no {cells} cells:\n{shown}")
    return float(row[1]) * {"ns": 1e-9, "µs": 1e-6, "ms": 1e-3, "s": 1.0}[row[2]]


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    ask.add_argument("--install", action="store_true", help="toppra by pip")
    ask.add_argument("--cells", type=int, default=100_000, choices=[10_000, 100_000, 1_000_000])
    ask = ask.parse_args()
    if ask.install:
        subprocess.run([sys.executable, "-m", "pip", "install", "--break-system-packages", "-q", "toppra"], check=True)
    ours = kinecut_time(ask.cells)
    theirs, length = toppra_time(ask.cells)
    print(f"{ask.cells} cells without jerk limits: kinecut {ours:.4f} s, toppra {theirs:.2f} s, {theirs / ours:.0f} times")
    print(f"time along the path by toppra {length:.6f} s")


if __name__ == "__main__":
    main()
