"""Programs that `run` measures, made anew and the same each time, and their moves as peers read them.

A case is a program, its control, a tool and a block of stock. Its moves are records of four f64: 1 for a rapid, else 0, then the tip
of the tool in x, y, z; the first record is where the tool starts. `sweep` is the same for a five-axis ball: the centre of the ball,
less its radius in z, which an upright ball at the same place has as its tip.
"""

import array
import math
import random
import re

BLOCK = (0, 0, -20, 100, 100, 0)


class Tool:
    """Tool: a flat end mill (corner 0), a ball (corner the radius), a bull-nose, or a drill with its point."""

    def __init__(self, kind, diameter, corner=0.0, length=60):
        self.kind, self.diameter, self.length = kind, diameter, length
        self.corner = {"end-mill": 0.0, "ball-nose": diameter / 2}.get(kind, corner)

    def toml(self):
        more = {"bull-nose": f"corner_radius = {self.corner}\n", "drill": "point_angle = 118\n"}.get(self.kind, "")
        return (f'[[tool]]\nnumber = 1\ntype = "{self.kind}"\ndiameter = {self.diameter}\n{more}'
                f"flute_length = {self.length}\nteeth = 2\nstickout = {self.length + 10}\n")


class Case:
    """Case: lines of a program, and what is known of it."""

    def __init__(self, name, tool, lines, moves, stock=BLOCK, control="linuxcnc", exact=None, sweep=None):
        self.name, self.tool, self.lines, self.moves, self.stock = name, tool, lines, moves, stock
        self.control, self.exact, self.sweep = control, exact, sweep

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "program.nc").write_text("\n".join(self.lines) + "\n")
        (folder / "tools.toml").write_text(self.tool.toml())
        for name, moves in (("moves", self.moves), ("sweep", self.sweep or self.moves)):
            with open(folder / f"{name}.f64", "wb") as file:
                array.array("d", (v for m in moves for v in m)).tofile(file)


def three_axes(name, tool, moves, **more):
    """Program of three axes from moves: places are rounded to 5 decimals first, so that all read the same numbers."""
    moves = [(r, round(x, 5), round(y, 5), round(z, 5)) for r, x, y, z in moves]
    lines, last = ["G21 G90 G17 G54", "T1 M6", "S10000 M3", "G43 H1"], None
    for n, (rapid, x, y, z) in enumerate(moves):
        code = f"G{0 if rapid else 1} " if rapid != last else ""
        feed = " F1200" if not rapid and code else ""
        if n == 0:  # up first, then across
            lines += [f"G0 Z{z:.5f}", f"X{x:.5f} Y{y:.5f}"]
        else:
            lines.append(f"{code}X{x:.5f} Y{y:.5f} Z{z:.5f}{feed}")
        last = rapid
    return Case(name, tool, lines + ["M5", "M30"], moves, **more)


def above(moves):
    """Moves with an approach and a retract: starts 5 mm above the block, plunges at feed."""
    (x, y, _), (u, v, _) = moves[0], moves[-1]
    return [(1, x, y, 5.0)] + [(0, *m) for m in moves] + [(1, u, v, 5.0)]


def pocket():
    """Case a: pocket 60 x 60 x 5 by rows 4 mm apart and one round; four corners of radius 5 stay."""
    moves, y, right = [(25, 25, -5)], 25, True
    while True:
        moves.append((75 if right else 25, y, -5))
        if y == 75:
            break
        y, right = min(75, y + 4), not right
        moves.append((moves[-1][0], y, -5))
    moves += [(25, 75, -5), (25, 25, -5), (75, 25, -5), (75, 75, -5), (25, 75, -5)]
    return three_axes("a", Tool("end-mill", 10), above(moves), exact=18000 - (4 - math.pi) * 125)


def wave(tool, name, share=1.0, first=None):
    """Case b: raster of S = 3 sin(x/10) cos(y/10) - 5, rows and points 0.3 mm apart; tool touches S at each point."""
    rows, moves = max(2, round(334 * share)), []
    flat = tool.diameter / 2 - tool.corner
    for j in range(rows):
        row = []
        for i in range(334):
            x, y = 0.3 * i, 0.3 * j
            gx, gy = 0.3 * math.cos(x / 10) * math.cos(y / 10), -0.3 * math.sin(x / 10) * math.sin(y / 10)
            slope, size = math.hypot(gx, gy), math.sqrt(1 + gx * gx + gy * gy)
            aside = tool.corner / size + (flat / slope if slope > 1e-9 else 0.0)
            z = 3 * math.sin(x / 10) * math.cos(y / 10) - 5 + tool.corner / size - tool.corner
            row.append((x - gx * aside, y - gy * aside, z))
        moves += row[::-1] if j % 2 else row
    return three_axes(name, tool, above(moves[:first]))


def holes():
    """Holes: 2,500 of diameter 1, the point of the drill 10 mm deep."""
    tool, moves = Tool("drill", 1, length=15), [(1, 2.0, 2.0, 5.0)]
    for j in range(50):
        for i in range(50):
            x, y = 2 + 1.96 * (i if j % 2 == 0 else 49 - i), 2 + 1.96 * j
            moves += [(1, x, y, 2.0), (0, x, y, -10.0), (1, x, y, 2.0)]
    point = 0.5 / math.tan(math.radians(59))
    return three_axes("holes", tool, moves, exact=2500 * math.pi / 4 * (10 - point * 2 / 3))


def million():
    """Million: a ball of 6 mm whose tip follows S, moves of 0.1 mm, rows 0.1 mm apart."""
    moves = []
    for j in range(1000):
        row = [(0.1 * i, 0.1 * j, 3 * math.sin(i / 100) * math.cos(j / 100) - 5) for i in range(1001)]
        moves += row[::-1] if j % 2 else row
    return three_axes("million", Tool("ball-nose", 6), above(moves))


def five_axes(tool, name, stock=BLOCK, blocks=100_000):
    """Five axes: tool touches z = -12 + 5 sin(2 pi x/50) sin(2 pi y/50), its axis 10 to 20 degrees off the normal there.

    The tool leans towards greater x and y, so a piece above the surface stays at the least x and y of the whole block, and heights of
    the ball alone do not tell its volume. They do in a block that the rows pass by 24 mm on those sides.
    """
    k, rows = 2 * math.pi / 50, round(math.sqrt(blocks))
    per, corner, flat = blocks // rows, tool.corner, tool.diameter / 2 - tool.corner
    lines = ["%", "O0001", "G90 G21 G17 G40 G49 G80 G94", "T1 M6", "S10000 M3", "G54"]
    sweep, moves, before = [], [], None
    for j in range(rows):
        for i in range(per + 1):
            x, y = -2 + 104 * (i if j % 2 == 0 else per - i) / per, -2 + 104 * j / (rows - 1)
            normal = unit((-5 * k * math.cos(k * x) * math.sin(k * y), -5 * k * math.sin(k * x) * math.cos(k * y), 1))
            lean = math.radians(15 + 5 * math.sin(0.11 * x + 0.07 * y))
            along = 0.8 * normal[0] + 0.6 * normal[1]
            side = unit((0.8 - along * normal[0], 0.6 - along * normal[1], -along * normal[2]))
            u = [round(n * math.cos(lean) + s * math.sin(lean), 7) for n, s in zip(normal, side)]
            nu = sum(a * b for a, b in zip(normal, u))
            out = unit([nu * b - a for a, b in zip(normal, u)])  # from the axis to the point of contact
            touch = (x, y, -12 + 5 * math.sin(k * x) * math.sin(k * y))
            tip = [round(p + corner * a - flat * o - corner * b, 5) for p, a, o, b in zip(touch, normal, out, u)]
            place, vector = "X%.5f Y%.5f Z%.5f" % tuple(tip), "I%.7f J%.7f K%.7f" % tuple(u)
            if before is None:
                lines += ["G0 G43.5 H1 X%.5f Y%.5f Z30. I0. J0. K1." % tuple(tip[:2]),
                          "X%.5f Y%.5f Z20. %s" % (*tip[:2], vector), f"G1 {place} {vector} F3000"]
                sweep.append((1, *tip[:2], 30.0))
                before = (tip, u)
            else:
                lines.append(f"{place} {vector}")
            for part in (0.25, 0.5, 0.75, 1.0) if corner * 2 == tool.diameter else ():
                p, v = ([a + part * (b - a) for a, b in zip(*pair)] for pair in zip(before, (tip, u)))
                v = unit(v)
                sweep.append((0, p[0] + corner * v[0], p[1] + corner * v[1], p[2] + corner * (v[2] - 1)))
            before = (tip, u)
    lines += ["G0 Z30. I0. J0. K1.", "G49", "M5", "M30", "%"]
    return Case(name, tool, lines, moves, stock, "fanuc", sweep=sweep if stock != BLOCK and len(sweep) > 1 else None)


def unit(v):
    size = math.sqrt(sum(a * a for a in v))
    return [a / size for a in v] if size > 1e-12 else [0.0, 0.0, 0.0]


def small(seed):
    """Small: 20 moves at random in a block of 20 x 20 x 10, tools in turn."""
    chance = random.Random(seed)
    tool = (Tool("end-mill", 4), Tool("ball-nose", 4), Tool("bull-nose", 4, 0.8))[seed % 3]
    moves = [(chance.uniform(-3, 23), chance.uniform(-3, 23), chance.uniform(-7, 1)) for _ in range(21)]
    return three_axes(f"random {seed}", tool, above(moves), stock=(0, 0, -10, 20, 20, 0))


def given(path, spec, stock, control):
    """Program of the user's own: straight moves of three axes are read for the peers; else they have none."""
    kind, *sizes = spec.split()
    text = path.read_text(errors="replace")
    return Case(path.stem, Tool(kind, *map(float, sizes)), text.splitlines(), straight_moves(text), stock=stock, control=control)


def straight_moves(text):
    """Moves of a program of G0 and G1 in absolute places; none where it holds anything else that moves the tool."""
    place, rapid, scale, moves = {}, 1, 1.0, []
    for line in text.upper().splitlines():
        words = re.findall(r"([A-Z])\s*([-+]?[\d.]+)", re.sub(r"\([^)]*\)|;.*", "", line))
        for letter, number in words:
            code = float(number) if letter == "G" else None
            if code in (0, 1):
                rapid = 1 - int(code)
            elif code in (20, 21):
                scale = 25.4 if code == 20 else 1.0
            elif letter in "ABCIJKRUVW" or code in (2, 3, 5, 10, 28, 30, 53, 91, 92) or code and 68 <= code < 90:
                return []
        new = {a: float(n) * scale for a, n in words if a in "XYZ"}
        place.update(new)
        if new and len(place) == 3:
            moves.append((rapid, place["X"], place["Y"], place["Z"]))
    return moves
