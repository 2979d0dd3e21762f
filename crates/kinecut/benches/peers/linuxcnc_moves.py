"""A program as moves of LinuxCNC's trajectory planner, read without kinecut.

Plain programs of three axes: G0 to G3 in three planes, G4, cycles G73, G81, G82, G83, G20 and G21, G90 and G91, G61, G61.1 and
G64 P Q. What else would move an axis is refused. The limits of each move and the lines that are merged are those of the
control's canonical interface; what was read for them: emccanon.cc, interp_convert.cc and interp_cycles.cc of LinuxCNC.
"""

import math
import re

# Words that leave the path as it is, or whose effect is a wait that is no move.
STILL_G = {40, 43, 43.1, 49, 54, 55, 56, 57, 58, 59, 80, 90.1, 91.1, 94, 97}
WAITING_M = {0, 1, 3, 4, 5, 6, 7, 8, 9}
ENDING_M = {2, 30}
PLANES = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}
LIFT = 0.254  # of G73 and G83


class Refused(Exception):
    """A word that this reader does not follow."""


class Canon:
    """The limits of moves, and merged lines."""

    def __init__(self, limits):
        self.velocity, self.acceleration = zip(*limits)
        self.out = [f"limits {i} {v} {a}" for i, (v, a) in enumerate(limits)]
        self.at, self.chain, self.feed = None, [], 0.0
        self.mode, self.tolerance, self.naive = 2, 0.0, 0.0
        self.count, self.path = 0, 0.0

    def stand(self, at):
        self.flush()
        self.at = tuple(at)
        self.out.append("at %.9f %.9f %.9f 0 0 0" % self.at)

    def set_mode(self, mode, tolerance, naive=None):
        self.flush()
        self.mode, self.tolerance = mode, tolerance
        if naive is not None:
            self.naive = naive
        self.out.append(f"mode {mode} {tolerance}")

    def wait(self):
        self.flush()
        self.out.append("wait")

    def _straight(self, to, limits):
        """Times at the limits of the axes, and the length, of a straight way; ways under 1e-6 mm count as none."""
        ways = [abs(b - a) for a, b in zip(self.at, to)]
        ways = [0.0 if w < 1e-6 else w for w in ways]
        return max(w / l for w, l in zip(ways, limits)), math.dist((0, 0, 0), ways)

    def _line(self, kind, to, wanted=None):
        time, length = self._straight(to, self.velocity)
        if time > 0:
            fastest = length / time
            acceleration = length / self._straight(to, self.acceleration)[0]
            feed = fastest if wanted is None else min(wanted, fastest)
            numbers = (kind, *to, feed, fastest, acceleration)
            self.out.append("line %d %.9f %.9f %.9f 0 0 0 %.9f %.9f %.9f" % numbers)
            self.count += 1
            self.path += length
        self.at = tuple(to)

    def flush(self):
        if self.chain:
            to, self.chain = self.chain[-1], []
            self._line(2, to, self.feed)

    def rapid(self, to):
        self.flush()
        self._line(1, to)

    def _linkable(self, to):
        if self.mode != 2 or self.naive == 0 or len(self.chain) > 100 or to == self.at:
            return False
        m = [b - a for a, b in zip(self.at, to)]
        square = sum(v * v for v in m)
        for p in self.chain:
            d = [b - a for a, b in zip(self.at, p)]
            t = min(1.0, max(0.0, sum(v * w for v, w in zip(m, d)) / square))
            if math.dist(d, [t * v for v in m]) > self.naive:
                return False
        return True

    def straight(self, to, feed):
        to = tuple(to)
        if feed != self.feed:
            self.flush()
            self.feed = feed
        if self.chain and not self._linkable(to):
            self.flush()
        self.chain.append(to)

    def last(self):
        return self.chain[-1] if self.chain else self.at

    def arc(self, to, centre, plane, turns, feed):
        """`turns`: 1 is less than a turn counter-clockwise, -1 clockwise, 2 one turn more."""
        i, j, k = PLANES[plane]
        if feed != self.feed:
            self.flush()
            self.feed = feed
        start = self.last()
        a0 = math.atan2(start[j] - centre[1], start[i] - centre[0])
        a1 = math.atan2(to[j] - centre[1], to[i] - centre[0])
        if turns < 0 and a1 + 1e-12 >= a0:
            a1 -= math.tau
        if turns > 0 and a1 - 1e-12 <= a0:
            a1 += math.tau
        sweep = a1 - a0 + math.tau * (turns - 1 if turns > 0 else turns + 1)
        r0 = math.hypot(start[i] - centre[0], start[j] - centre[1])
        r1 = math.hypot(to[i] - centre[0], to[j] - centre[1])
        if plane == 17 and self.mode == 2 and r0 * (1 - math.cos(abs(a1 - a0) / 2)) < self.naive:
            middle = (a0 + a1) / 2
            self.straight((centre[0] + r0 * math.cos(middle), centre[1] + r0 * math.sin(middle), (start[2] + to[2]) / 2), feed)
            self.straight(to, feed)
            return
        self.flush()
        v = min(self.velocity[i], self.velocity[j])
        a = min(self.acceleration[i], self.acceleration[j])
        spiral, least = r1 - r0, min(r0, r1)
        v = min(v, math.sqrt(a * math.sqrt(3) / 2 * math.hypot(spiral / abs(sweep), least)))
        planar = math.hypot(least * abs(sweep), spiral)
        length = math.hypot(planar, to[k] - start[k])
        fastest = length / max(self._straight(to, self.velocity)[0], planar / v)
        acceleration = length / max(self._straight(to, self.acceleration)[0], planar / a)
        c, normal = [0.0] * 3, [0.0] * 3
        c[i], c[j], c[k], normal[k] = centre[0], centre[1], to[k], 1.0
        numbers = (*to, *c, *normal, turns - 1 if turns > 0 else turns, min(feed, fastest), fastest, acceleration)
        self.out.append("arc %.9f %.9f %.9f 0 0 0 %.9f %.9f %.9f %g %g %g %d %.9f %.9f %.9f" % numbers)
        self.count += 1
        self.path += length
        self.at = tuple(to)


class Program:
    def __init__(self, text, limits):
        self.canon = Canon(limits)
        self.at = [None, None, None]
        self.unit, self.plane, self.absolute, self.centre_absolute = 1.0, 17, True, False
        self.feed, self.motion, self.inverse, self.to_start = None, None, False, True
        self.cycle = {}
        self.ended = False
        for number, line in enumerate(text.splitlines(), 1):
            line = re.sub(r"\([^)]*\)|;.*", "", line).strip().upper().replace(" ", "").replace("\t", "")
            if not line or line[0] in "%/" or re.fullmatch(r"[O:]\d+", line):
                continue
            if "#" in line or "[" in line or line[0] == "O":
                raise Refused(f"line {number}: {line}")
            words = re.findall(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))", line)
            if "".join(a + b for a, b in words) != line:
                raise Refused(f"line {number}: {line}")
            try:
                self.block([(a, float(b)) for a, b in words])
            except Refused as why:
                raise Refused(f"line {number}: {why}") from None
            if self.ended:
                break
        self.canon.wait()

    def block(self, words):
        g = [v for a, v in words if a == "G"]
        m = [v for a, v in words if a == "M"]
        n = {a: v for a, v in words if a not in "GMN"}
        if set(n) & set("ABCUVW"):
            raise Refused("an axis beyond three")
        if 20 in g or 21 in g:
            self.unit = 25.4 if 20 in g else 1.0
        if "F" in n:
            self.feed = n["F"] * self.unit / 60
        # The control switches spindle, coolant and coordinates at rest (emctaskmain.cc).
        if any(v in WAITING_M for v in m) or "S" in n or any(54 <= v <= 59.3 for v in g):
            self.canon.wait()
        dwell = 4 in g
        if dwell:
            self.canon.wait()
        motion = None
        for v in g:
            if v in (0, 1, 2, 3, 73, 81, 82, 83):
                motion = v
            elif v in PLANES:
                self.plane = int(v)
            elif v in (90, 91):
                self.absolute = v == 90
            elif v == 64:
                p, q = n.pop("P", None), n.pop("Q", None)
                tolerance = (p or 0.0) * self.unit
                self.canon.set_mode(2, tolerance, 0.0 if p is None else tolerance if q is None else q * self.unit)
            elif v in (61, 61.1):
                self.canon.set_mode(1 if v == 61 else 0, 0.0)
            elif v in (98, 99):
                self.to_start = v == 98
            elif v in (90.1, 91.1):
                self.centre_absolute = v == 90.1
            elif v not in STILL_G and v not in (4, 20, 21):
                raise Refused(f"G{v:g}")
        if 80 in g:
            self.motion = None
        if motion is not None:
            if motion != self.motion:
                self.cycle = {}
            self.motion = motion
        if set(n) & set("XYZ") and not dwell:
            self.move(n)
        elif self.motion in (2, 3) and set(n) & set("IJK"):
            self.move(n)
        for v in m:
            if v in ENDING_M:
                self.ended = True
            elif v not in WAITING_M and v not in (48, 49):
                raise Refused(f"M{v:g}")

    def target(self, n):
        to = list(self.at)
        for i, axis in enumerate("XYZ"):
            if axis in n:
                to[i] = n[axis] * self.unit + (0 if self.absolute else self.at[i])
        return to

    def move(self, n):
        if self.motion is None:
            raise Refused("axes without a motion")
        if self.motion > 3:
            self.drill(n)
            return
        to = self.target(n)
        if None in self.at or None in to:
            # Where the axes come from nobody knows: no move.
            self.at = to
            if None not in to:
                self.canon.stand(to)
            return
        if self.motion == 0:
            self.canon.rapid(to)
        elif not self.feed:
            raise Refused("no feed")
        elif self.motion == 1:
            self.canon.straight(to, self.feed)
        else:
            self.turn(n, to)
        self.at = to

    def turn(self, n, to):
        i, j, _ = PLANES[self.plane]
        ccw = self.motion == 3
        if "R" in n:
            r = n["R"] * self.unit
            dx, dy = to[i] - self.at[i], to[j] - self.at[j]
            d = math.hypot(dx, dy)
            h = math.sqrt(max(0.0, r * r - d * d / 4))
            side = 1 if ccw == (r > 0) else -1
            centre = ((self.at[i] + to[i]) / 2 - side * h * dy / d, (self.at[j] + to[j]) / 2 + side * h * dx / d)
        else:
            names = "IJK"[i], "IJK"[j]
            off = [n.get(name, 0.0) * self.unit for name in names]
            centre = off if self.centre_absolute else (self.at[i] + off[0], self.at[j] + off[1])
        turns = int(n.get("P", 1))
        self.canon.arc(tuple(to), centre, self.plane, turns if ccw else -turns, self.feed)

    def drill(self, n):
        if self.plane != 17 or not self.absolute or None in self.at or "L" in n:
            raise Refused("a cycle that is not plain")
        if not self.feed:
            raise Refused("no feed")
        held = {a: n[a] * self.unit for a in "ZRQ" if a in n}
        first = not self.cycle
        self.cycle.update(held)
        if first:
            self.cycle["old"] = self.at[2]
        r, bottom, q = self.cycle["R"], self.cycle["Z"], self.cycle.get("Q")
        to = [n[a] * self.unit if a in n else self.at[i] for i, a in enumerate("XY")]
        clear = max(self.cycle["old"], r) if self.to_start else r
        mode = self.canon.mode, self.canon.tolerance
        self.canon.set_mode(1, 0.0)
        x, y, z = self.at
        if z < r:
            z = r
            self.canon.rapid((x, y, z))
        self.canon.rapid((*to, z))
        self.canon.rapid((*to, r))
        if self.motion in (81, 82):
            self.canon.straight((*to, bottom), self.feed)
            if self.motion == 82:
                self.canon.wait()
        else:
            depth = r - q
            while depth > bottom:
                self.canon.straight((*to, depth), self.feed)
                if self.motion == 83:
                    self.canon.rapid((*to, r))
                    self.canon.rapid((*to, depth + LIFT))
                else:
                    self.canon.rapid((*to, depth + LIFT))
                depth -= q
            self.canon.straight((*to, bottom), self.feed)
        self.canon.rapid((*to, clear))
        self.canon.set_mode(*mode)
        self.at = [*to, clear]
