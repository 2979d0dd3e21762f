"""Heights that an upright flat, ball or bull-nose tool leaves, in f64, by brute force: what plain code of a good compiler gives,
and the reference of `run`. Needs: pip install numba numpy

    envelope.py zmap MOVES DIAMETER CORNER STOCK STEP     time of all columns, removed volume
    envelope.py reference MOVES DIAMETER CORNER STOCK STEP    volume on two grids that share no period with rows
    envelope.py mesh MOVES DIAMETER CORNER STOCK FILE.stl     volume of a mesh, its heights against the envelope
    envelope.py grid MOVES DIAMETER CORNER STOCK STEP FILE.f32    heights of a grid against the envelope

Height over a column while the tip goes from A to B: the least of slope * t + profile(distance), which is convex in t. A flat tool
has it at an end of what covers the column, a ball where a quadratic says; a bull-nose by Newton steps kept in a bracket.
"""

import json
import math
import sys
import time

import numpy as np
from numba import get_num_threads, njit, prange


@njit(cache=True)
def profile(flat, corner, r):
    """Height of the tool's underside above its tip at distance r from the axis."""
    if r <= flat:
        return 0.0
    return corner - math.sqrt(max(corner * corner - (r - flat) ** 2, 0.0))


@njit(cache=True)
def bull_at(flat, corner, slope, s, q, lo, hi):
    """Place t of the least height of a bull-nose: where slope + profile'(r) * (t - s) / r changes its sign."""
    t = min(max(s, lo), hi)
    if slope == 0.0:
        return t
    for _ in range(60):
        a = t - s
        r = math.hypot(a, q)
        g, curve = slope, 0.0
        if r > flat:
            root = math.sqrt(max(corner * corner - (r - flat) ** 2, 1e-24))
            d = (r - flat) / root
            g += d * a / r
            curve = corner * corner / root**3 * (a / r) ** 2 + d * q * q / r**3
        if g > 0.0:
            hi = t
        else:
            lo = t
        new = t - g / curve if curve > 0.0 else 0.5 * (lo + hi)
        if not lo < new < hi:
            new = 0.5 * (lo + hi)
        if abs(new - t) < 1e-12:
            return new
        t = new
    return t


@njit(cache=True)
def height(radius, corner, a, b, x, y):
    """Lowest point of the tool above (x, y) on the way from a to b; infinite where the tool does not come."""
    dx, dy, px, py = b[1] - a[1], b[2] - a[2], x - a[1], y - a[2]
    length, flat = math.hypot(dx, dy), radius - corner
    if length < 1e-12:
        r = math.hypot(px, py)
        return min(a[3], b[3]) + profile(flat, corner, r) if r <= radius else math.inf
    ux, uy = dx / length, dy / length
    s, q = px * ux + py * uy, px * uy - py * ux
    if abs(q) > radius:
        return math.inf
    w = math.sqrt(radius * radius - q * q)
    lo, hi = max(0.0, s - w), min(length, s + w)
    if lo > hi:
        return math.inf
    slope = (b[3] - a[3]) / length
    if corner == 0.0:
        t = lo if slope > 0.0 else hi
    elif flat == 0.0:
        t = min(max(s - w * slope / math.sqrt(1.0 + slope * slope), lo), hi)
    else:
        t = bull_at(flat, corner, slope, s, q, lo, hi)
    return a[3] + slope * t + profile(flat, corner, math.hypot(t - s, q))


@njit(parallel=True, cache=True)
def zmap(moves, radius, corner, stock, nx, ny, strips):
    """Heights at the middles of nx by ny cells; each strip of rows looks at all moves."""
    x0, y0, bottom, x1, y1, top = stock
    hx, hy = (x1 - x0) / nx, (y1 - y0) / ny
    out = np.full((ny, nx), top)
    for k in prange(strips):
        first, last = ny * k // strips, ny * (k + 1) // strips - 1
        for n in range(1, moves.shape[0]):
            a, b = moves[n - 1], moves[n]
            if min(a[3], b[3]) >= top:
                continue
            j0 = max(first, int(math.ceil((min(a[2], b[2]) - radius - y0) / hy - 0.5)))
            j1 = min(last, int(math.floor((max(a[2], b[2]) + radius - y0) / hy - 0.5)))
            i0 = max(0, int(math.ceil((min(a[1], b[1]) - radius - x0) / hx - 0.5)))
            i1 = min(nx - 1, int(math.floor((max(a[1], b[1]) + radius - x0) / hx - 0.5)))
            for j in range(j0, j1 + 1):
                for i in range(i0, i1 + 1):
                    z = height(radius, corner, a, b, x0 + (i + 0.5) * hx, y0 + (j + 0.5) * hy)
                    if z < out[j, i]:
                        out[j, i] = max(z, bottom)
    return out


@njit(parallel=True, cache=True)
def at_points(moves, radius, corner, stock, points, firsts, order):
    """Heights at points that are sorted into squares of 1 mm: each square's moves are told by `firsts` and `order`."""
    out = np.full(points.shape[0], stock[5])
    wide = int(math.ceil(stock[3] - stock[0]))
    for p in prange(points.shape[0]):
        x, y = points[p]
        square = int(y - stock[1]) * wide + int(x - stock[0])
        for k in range(firsts[square], firsts[square + 1]):
            n = order[k]
            out[p] = min(out[p], height(radius, corner, moves[n - 1], moves[n], x, y))
        out[p] = max(out[p], stock[2])
    return out


@njit(cache=True)
def squares(moves, radius, stock):
    """Moves that can reach each square of 1 mm."""
    wide, deep = int(math.ceil(stock[3] - stock[0])), int(math.ceil(stock[4] - stock[1]))
    firsts, order = np.zeros(wide * deep + 1, np.int64), np.zeros(0, np.int64)
    for turn in range(2):
        if turn:
            firsts = np.cumsum(firsts)
            order, free = np.empty(firsts[-1], np.int64), firsts.copy()
        for n in range(1, moves.shape[0]):
            a, b = moves[n - 1], moves[n]
            i0, i1 = int(max(0, math.floor(min(a[1], b[1]) - radius - stock[0]))), int(min(wide - 1, math.floor(max(a[1], b[1]) + radius - stock[0])))
            j0, j1 = int(max(0, math.floor(min(a[2], b[2]) - radius - stock[1]))), int(min(deep - 1, math.floor(max(a[2], b[2]) + radius - stock[1])))
            for j in range(j0, j1 + 1):
                for i in range(i0, i1 + 1):
                    if turn:
                        order[free[j * wide + i]] = n
                        free[j * wide + i] += 1
                    else:
                        firsts[j * wide + i + 1] += 1
    return firsts, order


@njit(cache=True)
def tops(triangles, points):
    """Greatest height of a mesh above each point; points sorted by x."""
    out = np.full(points.shape[0], -np.inf)
    for n in range(triangles.shape[0]):
        a, b, c = triangles[n]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if area <= 1e-14:
            continue
        for p in range(np.searchsorted(points[:, 0], min(a[0], b[0], c[0])), np.searchsorted(points[:, 0], max(a[0], b[0], c[0]), side="right")):
            x, y = points[p]
            u = ((b[0] - x) * (c[1] - y) - (c[0] - x) * (b[1] - y)) / area
            v = ((c[0] - x) * (a[1] - y) - (a[0] - x) * (c[1] - y)) / area
            if u >= -1e-9 and v >= -1e-9 and u + v <= 1 + 1e-9:
                out[p] = max(out[p], u * a[2] + v * b[2] + (1 - u - v) * c[2])
    return out


def removed(heights, stock):
    return float((stock[5] - heights).mean() * (stock[3] - stock[0]) * (stock[4] - stock[1]))


def cells(stock, step):
    return round((stock[3] - stock[0]) / step), round((stock[4] - stock[1]) / step)


def prime(n):
    while any(n % d == 0 for d in range(2, math.isqrt(n) + 1)):
        n += 1
    return n


def errors(found, exact):
    known = np.isfinite(found)
    off = np.abs(found - exact)[known]
    return {"largest": float(off.max()), "rms": float(np.sqrt((off**2).mean())), "points": int(known.sum())}


def main():
    what, file, diameter, corner, block, *rest = sys.argv[1:]
    moves = np.fromfile(file).reshape(-1, 4)
    radius, corner, stock = float(diameter) / 2, float(corner), np.array([float(v) for v in block.split(",")])
    strips = 4 * get_num_threads()
    if what == "zmap":
        nx, ny = cells(stock, float(rest[0]))
        zmap(moves[:3], radius, corner, stock, 8, 8, strips)  # compiled before the clock starts
        wall, cpu = time.time(), time.process_time()
        heights = zmap(moves, radius, corner, stock, nx, ny, strips)
        answer = {"wall": time.time() - wall, "cpu": time.process_time() - cpu, "removed": removed(heights, stock)}
    elif what == "reference":
        nx, ny = cells(stock, float(rest[0]))
        volumes = [removed(zmap(moves, radius, corner, stock, prime(x), prime(y), strips), stock) for x, y in ((nx, ny + 20), (nx + 40, ny + 60))]
        answer = {"removed": sum(volumes) / 2, "doubt": abs(volumes[0] - volumes[1])}
    elif what == "grid":
        nx, ny = cells(stock, float(rest[0]))
        exact = zmap(moves, radius, corner, stock, nx, ny, strips)
        answer = errors(np.fromfile(rest[1], np.float32).reshape(ny, nx), exact)
    else:
        data = open(rest[0], "rb").read()
        kind = np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
        mesh = np.frombuffer(data, kind, int.from_bytes(data[80:84], "little"), 84)["v"].astype(float)
        a, b, c = np.moveaxis(mesh - stock[:3], 1, 0)
        solid = float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)
        points = np.random.default_rng(7).uniform(stock[:2] + 1e-3, stock[3:5] - 1e-3, (20000, 2))
        points = np.ascontiguousarray(points[np.argsort(points[:, 0])])
        bins = squares(moves, radius, stock)
        exact = at_points(moves, radius, corner, stock, points, *bins)
        level = np.ones(len(points), bool)  # no wall within 0.25 mm: beside one, a height says nothing
        for aside in ((0.25, 0), (-0.25, 0), (0, 0.25), (0, -0.25)):
            beside = np.clip(points + aside, stock[:2] + 1e-3, stock[3:5] - 1e-3)
            level &= np.abs(at_points(moves, radius, corner, stock, beside, *bins) - exact) < 1.0
        found = tops(mesh, points)
        known = np.isfinite(found)
        answer = errors(found[level], exact[level])
        answer |= {"triangles": len(mesh), "removed": float(np.prod(stock[3:] - stock[:3])) - solid}
        answer["by_heights"] = float((exact - found)[known].mean() * np.prod(stock[3:5] - stock[:2]))
    print("RESULT " + json.dumps(answer))


if __name__ == "__main__":
    main()
