"""Swept volumes by facets: hull of the tool at both ends of each move, all taken from the block in one batch difference.
Needs: pip install manifold3d numpy

    hulls.py MOVES.f64 DIAMETER CORNER STOCK SIDES MOST

The tool stands once inside the true one (corners on its circles) and once about it (sides touch its circles), so the true removed
volume lies between the two that are told. The time is that of the inner one; MOST 0 takes all moves.
"""

import json
import sys
import time

import numpy as np
from manifold3d import CrossSection, Manifold, OpType


def tool(radius, corner, length, sides, about):
    """Body of revolution whose arc has a quarter of the sides."""
    count, flat = max(2, sides // 4), radius - corner
    steps = np.linspace(0, np.pi / 2, count + 1)
    size = corner
    if about and corner > 0:  # where the tangents at the corners meet
        steps = np.concatenate([[0.0], (steps[:-1] + steps[1:]) / 2, [np.pi / 2]])
        size = corner * np.concatenate([[1.0], np.full(count, 1 / np.cos(np.pi / 4 / count)), [1.0]])
    arc = np.stack([flat + size * np.sin(steps), corner - size * np.cos(steps)], axis=1) if corner > 0 else np.array([[radius, 0.0]])
    section = [[0.0, 0.0], *([[flat, 0.0]] if flat > 0 < corner else []), *arc.tolist()[0 if flat > 0 or about else 1:]]
    section += [[radius, length], [0.0, length]]
    seen = [p for n, p in enumerate(section) if n == 0 or np.hypot(p[0] - section[n - 1][0], p[1] - section[n - 1][1]) > 1e-9]
    wide = 1 / np.cos(np.pi / sides) if about else 1.0
    return CrossSection([np.array(seen)]).revolve(sides).scale((wide, wide, 1.0)).hull()


def cut(moves, body, block):
    parts = [block]
    for a, b in zip(moves, moves[1:]):
        if min(a[3], b[3]) < 0:
            ends = [body.translate(a[1:].tolist()), body.translate(b[1:].tolist())]
            parts.append(Manifold.batch_hull(ends) if np.abs(a - b)[1:].max() > 1e-9 else ends[0])
    return Manifold.batch_boolean(parts, OpType.Subtract)


def main():
    file, diameter, corner, block, sides, most = sys.argv[1:]
    moves, most = np.fromfile(file).reshape(-1, 4), int(most)
    moves = moves[: most + 1] if most else moves
    stock = np.array([float(v) for v in block.split(",")])
    moves[:, 3] -= stock[5]  # top of the block at zero
    size = stock[3:] - stock[:3]
    solid = Manifold.cube(size.tolist()).translate([stock[0], stock[1], -size[2]])
    volumes = []
    for about in (False, True):
        wall, cpu = time.time(), time.process_time()
        part = cut(moves, tool(float(diameter) / 2, float(corner), 60.0, int(sides), about), solid)
        volumes.append(solid.volume() - part.volume())
        if not about:
            answer = {"wall": time.time() - wall, "cpu": time.process_time() - cpu, "triangles": part.num_tri()}
    answer |= {"removed": sum(volumes) / 2, "inner": volumes[0], "outer": volumes[1], "sides": int(sides)}
    print("RESULT " + json.dumps(answer))


if __name__ == "__main__":
    main()
