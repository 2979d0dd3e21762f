"""Volumes of sweeps against the Python package manifold3d, which knows nothing of grazing curves.

    cargo run --release -p kinecut --example sweep_volumes | python3 crates/kinecut/benches/peers/sweep_volume.py

A straight move without turning is the hull of the tool at both ends (convex tools). Any other move is the union of the hulls
of the tool at neighbouring poses: from outside, as a hull fills what lies between two poses, and falls towards the sweep as the
poses close up. Needs: pip install manifold3d numpy
"""

import json
import sys
import time

import numpy as np
from manifold3d import CrossSection, Manifold, OpType

SIDES = 256  # of a circle


def tool(section):
    """The tool as a body of revolution; its inscribed polygon is enlarged to the area of the circle."""
    body = CrossSection([np.array(section)]).revolve(SIDES)
    angle = 2 * np.pi / SIDES
    grow = np.sqrt(angle / np.sin(angle))
    return body.scale((grow, grow, 1.0))


def posed(body, pose):
    columns = np.array(pose).reshape(4, 3).T
    return body.transform(columns)


def swept(body, poses, straight):
    bodies = [posed(body, p) for p in poses]
    pairs = [Manifold.batch_hull([a, b]) for a, b in zip(bodies, bodies[1:])]
    if straight:
        return pairs[0]
    return Manifold.batch_boolean(pairs, OpType.Add)


def main():
    worst = 0.0
    print(f"{'tool':5} {'move':11} {'mesh':>14} {'closed form':>14} {'manifold':>14} {'mesh/closed':>12} {'mesh/manifold':>13} {'s':>6}")
    for text in sys.stdin:
        case = json.loads(text)
        start = time.time()
        other = swept(tool(case["section"]), case["poses"], case["straight"]).volume()
        seconds = time.time() - start
        exact = case["exact"]
        off = case["volume"] / exact - 1 if exact else float("nan")
        beside = case["volume"] / other - 1
        if case["curves_change"] == 0:
            worst = max(worst, abs(beside))
        shown = f"{exact:14.6f}" if exact else " " * 14
        print(f"{case['tool']:5} {case['move']:11} {case['volume']:14.6f} {shown} {other:14.6f} {off:12.1e} {beside:13.1e} {seconds:6.1f}")
    print(f"largest difference from manifold: {worst:.1e}")
    return 0 if worst < 1e-3 else 1


if __name__ == "__main__":
    sys.exit(main())
