"""Random programs for LinuxCNC: every construct of its language that kinecut reads, or only some groups of them.

A program is drawn so that the interpreter takes it: arcs start where the generator knows the position, feeds are set for their
mode, cycles have what they need. A number can stand as an expression of the same value. Some programs are wrong on purpose.
"""

import collections
import math
import random
import re

GROUPS = {
    "arcs": "G2, G3 with centres and helices", "radius": "R in arcs", "turns": "P in arcs", "planes": "G18, G19", "distance": "G91",
    "centres": "G90.1", "units": "G20", "feeds": "G93, G95", "systems": "G54 to G59.3", "g10": "G10 L2, L20", "rotation": "R in G10 L2",
    "g52": "G52", "g92": "G92 to G92.3", "machine": "G53", "home": "G28", "stored": "G28.1, G30, G30.1", "lengths": "G43, G43.1, G43.2, G49",
    "tools": "T, M6", "table": "G10 L1, L10, L11", "cycles": "G73, G81, G82, G83", "boring": "G85, G86, G89", "tapping": "G84", "repeats": "L in cycles",
    "planecycles": "cycles in G18, G19", "dwell": "G4", "splines": "G5, G5.1, G5.2", "spindle": "M3, M4, M5, M7, M8, M9", "path": "G61, G64",
    "expressions": "operators and functions", "numbered": "#1 and on", "named": "#<name>, #<_name>", "indirect": "##1, #[1+1]",
    "position": "#5420 and on, #<_x>", "subs": "o sub, call, return", "flow": "if, while, do, repeat, break, continue", "m98": "M98, M99",
    "messages": "MSG, DEBUG, PRINT", "forms": "spelling, N words, order of words", "stops": "M0, M1, M60", "wrong": "programs to be refused",
    "probe": "G38.2", "tap": "G33.1", "thread": "G33, G76, G7, G8", "context": "M70, M72, M73",
}
MODES = ["planes", "distance", "centres", "units", "feeds", "systems", "g10", "g52", "g92", "machine", "home", "lengths",
         "tools", "table", "dwell", "spindle", "path", "stops", "messages", "probe", "tap", "thread", "context"]
MESSAGES = ["(MSG, change the clamp)", "(DEBUG, at #5420 and #100)", "(PRINT, %.3f #100)", "(msg,again)", "(only words)", "; only words"]
OFF = {"probe", "tap", "thread", "context"}  # not drawn unless named
UNARY = ["ABS", "ACOS", "ASIN", "COS", "EXP", "FIX", "FUP", "ROUND", "LN", "SIN", "SQRT", "TAN"]
BINARY = ["+", "-", "*", "/", "**", "MOD", "EQ", "NE", "GT", "GE", "LT", "LE", "AND", "OR", "XOR"]
AXES = {17: "XYZ", 18: "ZXY", 19: "YZX"}  # the two of the plane, and the third
CENTRE = dict(zip("XYZ", "IJK"))
WRONG = [
    "G1 X1 X2", "G0 G1 X1", "M3 M4", "G17 G2 X5 Y5", "G1 X[1/0]", "G1 XSQRT[-1]", "G1 X#<never_set>", "G1 X[1", "G77", "G0 X1 P2",
    "G4", "#0=1", "G28 G1 X5", "G92", "G10 L2 P12 X1", "o900 endif", "o901 call [1] 2", "M98", "(a (b) c)", "(not closed",
    "G0 X1 )", "G53 G2 X1 I1", "G91 G53 G0 X1\nG90", "G17 G2 X9 I1 K1", "T77 M6", "G43 H77", "M7 M8", "M48 M49", "G1 X1.2.3",
    "G1 X", "G0 X1 F-3", "S-1", "o902 sub\no903 sub\no903 endsub\no902 endsub", "G81 X1 Z-1\nG80", "G17 G81 X1 Z5 R1\nG80",
    "G83 X1 Z-1 R1\nG80", "G82 X1 Z-1 R1\nG80", "#5420=1", "#<_x>=1", "G1 X[2 FOO 3]", "G1 X#6000", "#1.5=2", "G0 A1e2", "X#1=5",
    "o904 repeat [2]\no904 break\no904 endrepeat", "o905 while [0]\no906 endwhile\no905 endwhile", "G80 X5", "N-1 G0 X1",
    "G90 G1 X1 R5", "G33.1 X1", "M19 R400", "G17 G3 R5", "G17 G2 X40 Y40 R1", "o907 if [1] G0 X1\no907 endif", "G0 Q3", "G5.3",
    "G18 G5 X1 Y1 I1 J1 P1 Q1\nG17", "G5.1 X1 Y1 I2", "M200", "G1 XACOS[2]", "G1 XLN[0]", "G1 XATAN[1]", "G2 X1 I1 P0", "M98 P5000",
]


def plain(v, r=None, digits=4):
    """A number as it is written, in one of several spellings."""
    text = f"{v:.{digits}f}".rstrip("0")
    text = "0." if text in ("-0.", "0.") else text
    if r and r.random() < 0.3:
        text = re.sub(r"^(-?)0\.(?=\d)", r"\1.", text)
        return text if r.random() < 0.5 or v < 0 else "+" + text
    return text[:-1] if text.endswith(".") and not (r and r.random() < 0.3) else text


class Program:
    """One program; `self.text` when it is made."""

    def __init__(self, seed, groups):
        self.r = r = random.Random(seed)
        self.on = groups.__contains__
        self.main, self.head, self.tail = [], [], []
        self.unit, self.plane, self.absolute, self.centres = 1.0, 17, True, False
        self.mode, self.turning, self.at = 94, 0, [None] * 3
        self.values, self.named, self.labels, self.subs, self.fanuc = {}, {}, 100, [], []
        self.tool, self.length = False, None  # the unit in which a length was taken up
        self.table_set = False
        self.wrong = self.on("wrong") and r.random() < 0.06
        while True:
            self.draw()
            if max(map(len, [*self.head, *self.main, *self.tail])) < 215:  # the interpreter takes 255 characters
                break
            seed += "+"
            self.__init__(seed, groups)
            return
        if self.wrong:
            self.main.insert(r.randint(len(self.main) // 2, len(self.main)), r.choice(WRONG))
        end = r.choice(["M2", "M30"])
        lines = [*self.head, *self.main, end, *self.tail]
        lines = [part for line in lines for part in line.split("\n")]
        if r.random() < 0.15:
            lines = ["%", *lines, "%"]
        self.text = "\n".join(self.dressed(line) for line in lines) + "\n"

    # Numbers.

    def expression(self, depth):
        """Text and value of an expression in brackets."""
        r = self.r
        for _ in range(20):
            kind = r.random()
            try:
                if depth == 0 or kind < 0.15:
                    return self.leaf()
                if kind < 0.45:
                    name = r.choice(UNARY)
                    if name in ("ACOS", "ASIN"):
                        v = round(r.uniform(-1, 1), 3)
                        a = f"{plain(v, r)}"
                    else:
                        a, v = self.expression(depth - 1)
                    value = unary(name, v)
                    text = f"{name}[{a}]"
                elif kind < 0.52:
                    (a, v), (b, w) = self.expression(depth - 1), self.expression(depth - 1)
                    text, value = f"ATAN[{a}]/[{b}]", math.degrees(math.atan2(v, w))
                    if abs(v) + abs(w) < 1e-3 or abs(abs(value) - 180) < 1e-3:
                        continue
                elif kind < 0.6:
                    a, v = self.expression(depth - 1)
                    text, value = f"-[{a}]", -v
                else:
                    parts, value = self.chain(depth)
                    text = f"[{parts}]"
                if math.isfinite(value) and abs(value) < 1e4:
                    return text, value
            except (ValueError, ZeroDivisionError, OverflowError, TypeError):
                pass
        return self.leaf()

    def chain(self, depth):
        """Operators without brackets between them, so that their ranks count."""
        r = self.r
        items = [self.expression(depth - 1) for _ in range(r.randint(2, 4))]
        operators = [r.choice(BINARY) for _ in items[1:]]
        ranks = [["**"], ["*", "/", "MOD"], ["+", "-"], ["EQ", "NE", "GT", "GE", "LT", "LE"], ["AND", "OR", "XOR"]]
        values, left = [v for _, v in items], operators[:]
        for rank in ranks:
            n = 0
            while n < len(left):
                if left[n] in rank:
                    values[n:n + 2] = [binary(left.pop(n), *values[n:n + 2])]
                else:
                    n += 1
        text = items[0][0]
        for name, (part, _) in zip(operators, items[1:]):
            text += f" {name} {part}" if r.random() < 0.7 or name.isalpha() else f"{name}{part}"
        return text, values[0]

    def leaf(self):
        r = self.r
        known = []
        if self.on("named") and r.random() < 0.05:
            name = r.choice(["a", "deep", "nowhere"])
            return f"EXISTS[#<{name}>]", float(name in self.named)
        if self.on("numbered"):
            known += [(f"#{n}", v) for n, v in self.values.items()]
        if self.on("named"):
            known += [(f"#<{n}>", v) for n, v in self.named.items()]
        if known and r.random() < 0.5:
            text, v = r.choice(known)
            if self.on("indirect") and text[1:].isdigit() and r.random() < 0.3:
                n = int(text[1:])
                return r.choice([f"#[{n - 7}+7]", f"#[{n}]"]), v
            return text, v
        v = round(r.uniform(-9, 9), r.randint(0, 3))
        return plain(v, r), v

    def number(self, v, chance=0.2, digits=4):
        """The text of a number; at times as an expression that comes to it."""
        r = self.r
        v = round(v, digits)
        if not self.on("expressions") or r.random() > chance:
            return plain(v, r if self.on("forms") else None, digits)
        text, value = self.expression(r.randint(1, 2))
        if abs(value) > 500:
            return plain(v)
        rest = f"{v - value:.8f}"
        return f"[{rest} + {text}]" if r.random() < 0.5 else f"[{text}{'' if rest[0] == '-' else '+'}{rest}]"

    # Moves.

    def say(self, line):
        self.main.append(line)

    def label(self):
        self.labels += 1
        return f"o{self.labels}" if self.r.random() < 0.7 else f"o<l_{self.labels}>"

    def coordinate(self, spread=40):
        return round(self.r.uniform(-spread, spread) / self.unit, 3 if self.unit == 1 else 4)

    def feed(self, length=20.0):
        """The F word for the mode."""
        r = self.r
        if self.mode == 93:
            return f" F{plain(round(r.uniform(0.5, 20), 2))}"
        if self.mode == 95:
            return f" F{plain(round(r.uniform(0.05, 0.4) / self.unit, 4))}"
        return f" F{plain(round(r.uniform(50, 900) / self.unit, 1))}"

    def stand(self, rapid=True):
        """Moves to a place that is known after it."""
        self.at = [self.coordinate() for _ in range(3)]
        words = " ".join(f"{a}{self.number(v)}" for a, v in zip("XYZ", self.at))
        self.say(f"G90 G{0 if rapid else 1} {words}{'' if rapid else self.feed()}")
        self.absolute = True

    def known(self):
        if None in self.at:
            self.stand()

    def settle(self):
        """Modes that are known, after parts that may or may not have run."""
        self.plane, self.absolute, self.mode = 17, True, 94
        self.say(f"G17 G90 G94{' G91.1' if self.on('centres') else ''}")
        self.centres = False
        self.say(self.feed().strip())
        self.stand()

    def words(self, target, digits=4):
        """Axis words for a target by axis letter, absolute or not; keeps the position."""
        out = []
        for a, v in target.items():
            n = "XYZ".index(a)
            out.append(f"{a}{self.number(v if self.absolute else v - self.at[n], digits=digits)}")
            self.at[n] = v
        return out

    def line(self):
        self.known()
        r = self.r
        axes = r.sample("XYZ", r.randint(1, 3))
        rapid = r.random() < 0.25
        new = {a: round(self.at["XYZ".index(a)] + r.uniform(-15, 15) / self.unit, 4) for a in axes}
        words = self.words(new)
        self.say(" ".join(r.sample([f"G{0 if rapid else 1}", *words], len(words) + 1)) + ("" if rapid else self.maybe_feed()))

    def maybe_feed(self):
        return self.feed() if self.mode == 93 or self.r.random() < 0.2 else ""

    def arc(self):
        self.known()
        r = self.r
        a, b, c = AXES[self.plane]
        i, j, k = ("XYZ".index(v) for v in (a, b, c))
        start, radius = [self.at[i], self.at[j]], round(r.uniform(1, 15) / self.unit, 4)
        from_, sweep, code = r.uniform(0, math.tau), r.uniform(0.2, 6), r.choice([2, 3])
        whole = r.random() < 0.12
        turn = (math.tau if whole else sweep) * (1 if code == 3 else -1)
        # Seven digits, so that the radii at both ends are the same.
        centre = [round(start[0] - radius * math.cos(from_), 7), round(start[1] - radius * math.sin(from_), 7)]
        away, angle = math.hypot(start[0] - centre[0], start[1] - centre[1]), math.atan2(start[1] - centre[1], start[0] - centre[0])
        end = start if whole else [round(centre[0] + away * math.cos(angle + turn), 7), round(centre[1] + away * math.sin(angle + turn), 7)]
        new = {} if whole and r.random() < 0.5 and self.absolute else {a: end[0], b: end[1]}
        if r.random() < 0.35:
            new[c] = round(self.at[k] + r.uniform(-5, 5) / self.unit, 4)
        words = self.words(new, 7)
        if self.on("radius") and not whole and r.random() < 0.35 and abs(sweep - math.pi) > 0.1:
            words.append(f"R{self.number(away if sweep < math.pi else -away, 0.1, 7)}")
        else:
            offsets = [v if self.centres else v - s for v, s in zip(centre, start)]
            words += [f"{CENTRE[x]}{self.number(v, digits=7)}" for x, v in zip((a, b), offsets)]
        if self.on("turns") and r.random() < 0.2:
            words.append(f"P{r.randint(1, 4)}")
        r.shuffle(words)
        self.say(f"G{code} {' '.join(words)}{self.maybe_feed()}")

    def splines(self):
        if self.plane != 17:
            self.choose_plane(17)
        if self.mode == 93:
            self.choose_mode(94)
        if not self.absolute:
            self.say("G90")
            self.absolute = True
        self.stand(rapid=False)
        r = self.r
        near = lambda: [round(v + r.uniform(-12, 12) / self.unit, 3) for v in self.at[:2]]
        off = lambda: plain(round(r.uniform(-8, 8) / self.unit, 3))
        which = r.random()
        if which < 0.4:
            for n in range(r.randint(1, 3)):
                x, y = near()
                first = f" I{off()} J{off()}" if n == 0 or r.random() < 0.5 else ""
                self.say(f"G5 X{plain(x)} Y{plain(y)}{first} P{off()} Q{off()}")
                self.at[:2] = [x, y]
        elif which < 0.7:
            x, y = near()
            self.say(f"G5.1 X{plain(x)} Y{plain(y)} I{off()} J{off()}")
            self.at[:2] = [x, y]
        else:
            order = r.choice(["", " L3", " L4"])
            points = [near() for _ in range(r.randint(4, 6))]
            for n, (x, y) in enumerate(points):
                self.say(f"{f'G5.2{order} ' if n == 0 else ''}X{plain(x)} Y{plain(y)} P{plain(round(r.uniform(0.5, 2), 2))}")
            self.say("G5.3")
            self.at[:2] = points[-1]
        self.stand()

    def cycles(self):
        r = self.r
        if self.mode == 93:
            self.choose_mode(94)
        if self.plane != 17 and not self.on("planecycles"):
            self.choose_plane(17)
        codes = [81, 82, 73, 83] + [85, 86, 89] * self.on("boring") + [84] * (2 * self.on("tapping"))
        a, b, c = AXES[self.plane]
        self.stand()
        k = "XYZ".index(c)
        code = r.choice(codes)
        if code in (84, 86) and self.turning != 1:
            self.say("S500 M3")
            self.turning = 1
        incremental = self.on("distance") and r.random() < 0.3
        for n in range(r.randint(1, 2)):
            level = self.at[k] if self.at[k] is not None else 0
            if n:
                code = r.choice(codes)
                if code in (84, 86) and self.turning != 1:
                    code = 81
            above, depth = round(r.uniform(-8, 4) / self.unit, 3), round(r.uniform(1, 12) / self.unit, 3)
            base = 0 if incremental else level + above
            words = [f"{c}{self.number(base - depth)}", f"R{self.number(above if incremental else base)}"]
            words += [f"{x}{self.number(self.coordinate(10 if incremental else 40))}" for x in (a, b) if r.random() < 0.9 or n == 0]
            if code in (73, 83):
                words.append(f"Q{self.number(round(depth * r.uniform(0.2, 1.2), 3))}")
            if code in (82, 86, 89) or code == 84 and r.random() < 0.5:
                words.append(f"P{plain(round(r.uniform(0, 1.5), 2))}")
            if self.on("repeats") and r.random() < 0.25:
                words.append(f"L{r.randint(1, 3)}")
            r.shuffle(words)
            retract = r.choice([" G98", " G99", ""])
            self.say(f"G{91 if incremental else 90}{retract} G{code} {' '.join(words)}{self.feed()}")
            for _ in range(r.randint(0, 3)):
                words = [f"{x}{self.number(self.coordinate(10 if incremental else 40))}" for x in r.sample([a, b], r.randint(1, 2))]
                if r.random() < 0.15:
                    words.append(f"R{self.number(round((0 if incremental else level) + above + r.uniform(0, 2), 3))}")
                if self.on("repeats") and r.random() < 0.15:
                    words.append(f"L{r.randint(1, 3)}")
                self.say(f"{r.choice(['', '', '', 'G98 ', 'G99 '])}{' '.join(words)}")
            self.at[k] = None
        if r.random() < 0.8:
            self.say("G80")
        self.at = [None] * 3
        self.stand()

    # Modes and offsets.

    def choose_plane(self, plane):
        self.plane = plane
        self.say(f"G{plane}")

    def choose_mode(self, mode):
        self.mode = mode
        if mode == 95 and not self.turning:
            self.say("S800 M3")
            self.turning = 1
        self.say(f"G{mode}")
        if mode != 93:
            self.say(self.feed().strip())

    def offset_words(self, least=1):
        r = self.r
        return " ".join(f"{a}{self.number(self.coordinate(30))}" for a in r.sample("XYZ", r.randint(least, 3)))

    def modes(self):
        """One change of something in force."""
        r = self.r
        able = [name for name in MODES if self.on(name)]
        if not able:
            return
        what = r.choice(able)
        if what in ("machine", "home", "table") and self.length not in (None, self.unit):
            # The one known mistake of the interpreter: it does not convert a length in force when the unit changes.
            self.say("G49")
            self.length = None
            self.stand()
        if what == "planes":
            self.choose_plane(r.choice([17, 18, 19]))
        elif what == "distance":
            self.known()
            self.absolute = not self.absolute
            self.say(f"G{90 if self.absolute else 91}")
        elif what == "centres":
            self.centres = not self.centres
            self.say("G90.1" if self.centres else "G91.1")
        elif what == "units":
            self.unit = 25.4 if self.unit == 1 else 1.0
            self.say(f"G{21 if self.unit == 1 else 20}")
            if self.mode != 93:
                self.say(self.feed().strip())
            self.stand()
        elif what == "feeds":
            self.choose_mode(r.choice([93, 94, 95]))
        elif what == "systems":
            self.say(r.choice(["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]))
            self.stand()
        elif what == "g10":
            if r.random() < 0.6:
                turn = f" R{plain(round(r.uniform(-180, 180), 1))}" if self.on("rotation") and r.random() < 0.4 else ""
                self.say(f"G10 L2 P{r.randint(0, 9)} {self.offset_words()}{turn}")
            else:
                self.say(f"G10 L20 P{r.randint(0, 9)} {self.offset_words()}")
            self.stand()
        elif what == "g52":
            self.say(f"G52 {self.offset_words()}" if r.random() < 0.7 else "G52 X0 Y0 Z0")
            self.stand()
        elif what == "g92":
            self.say(f"G92 {self.offset_words()}" if r.random() < 0.5 else r.choice(["G92.1", "G92.2", "G92.3"]))
            self.stand()
        elif what == "machine":
            if not self.absolute:
                self.say("G90")
                self.absolute = True
            rapid = r.random() < 0.7
            words = " ".join(f"{a}{self.number(self.coordinate(30))}" for a in r.sample("XYZ", r.randint(1, 3)))
            self.say(f"G53 G{0 if rapid else 1} {words}{'' if rapid else self.feed()}")
            self.stand()
        elif what == "home":
            code = r.choice([28, 30]) if self.on("stored") else 28
            if self.on("stored") and r.random() < 0.35:
                self.say(f"G{code}.1")
            else:
                words = " ".join(f"{a}{self.number(self.coordinate(20))}" for a in r.sample("XYZ", r.randint(0, 3)))
                self.say(f"G{code} {words}".strip())
            self.stand()
        elif what == "lengths":
            code = r.choice(["G43", "G43 H", "G43.1", "G43.2 H", "G49"])
            if code == "G43" and not self.tool:
                code = "G43 H"
            kept = self.length not in (None, self.unit) and code in ("G43.1", "G43.2 H")
            self.length = None if code == "G49" else self.unit
            if kept or code in ("G43.1", "G43.2 H") and r.random() < 0.5:
                self.say("G49")
            self.say(code + (str(r.randint(1, 4)) if code.endswith("H") else " " + self.offset_words() if code == "G43.1" else ""))
            self.stand()
        elif what == "tools":
            # At a change of tool the module gcode takes the whole table anew, as it was at first.
            if self.table_set:
                return
            self.tool = True
            if self.mode == 95:
                self.choose_mode(94)
            self.say(r.choice(["T{} M6", "T{}\nM6", "M6 T{}"]).format(r.randint(1, 4)))
            self.turning = 0  # a tool change stops it
            self.stand()  # the module gcode forgets where an arc ended
        elif what == "table":
            n, l = r.randint(1, 4), r.choice([1, 10, 11])
            self.say(f"G10 L{l} P{n} {self.offset_words()}\nG43 H{n}")
            self.table_set = True
            self.length = self.unit
            self.stand()
        elif what == "dwell":
            self.say(f"G4 P{self.number(round(r.uniform(0, 3), 2))}")
        elif what == "spindle":
            code = r.choice(["M3", "M4", "M5", "M7", "M8", "M9"])
            if code in ("M3", "M4"):
                self.turning = 1 if code == "M3" else -1
                code = f"S{r.randint(100, 5000)} {code}"
            elif code == "M5":
                if self.mode == 95:
                    self.choose_mode(94)
                self.turning = 0
            self.say(code)
        elif what == "path":
            self.say(r.choice(["G61", "G61.1", "G64", f"G64 P{plain(r.choice([0.01, 0.05, 0.1]))}", "G64 P0.05 Q0.02"]))
        elif what == "stops":
            self.say(r.choice(["M0", "M1", "M60"]))
        elif what == "messages":
            self.say(r.choice(MESSAGES))
        elif what == "probe":
            self.known()
            self.say(f"G91 G38.2 Z-{plain(round(r.uniform(1, 5) / self.unit, 3))}{self.feed()}\nG90" if self.mode != 93 else "G94")
            self.mode = 94 if self.mode == 93 else self.mode
            self.absolute = True
            self.say(self.feed().strip())
            self.stand()
        elif what == "tap":
            self.known()
            if not self.turning:
                self.say("S300 M3")
                self.turning = 1
            z = self.at[2] if self.absolute else 0
            self.say(f"G33.1 Z{plain(round(z - r.uniform(1, 9) / self.unit, 3))} K{plain(round(r.uniform(0.5, 2) / self.unit, 4))}")
            self.stand()
        elif what == "thread":
            self.known()
            if self.mode == 93:
                self.mode = 94
                self.say(f"G94{self.feed()}")
            if not self.turning:
                self.say("S300 M3")
                self.turning = 1
            length = lambda a, b: plain(round(r.uniform(a, b) / self.unit, 4))
            x = self.at[0] if self.absolute else 0
            z = self.at[2] if self.absolute else 0
            if r.random() < 0.5:
                self.say(f"G33 Z{plain(round(z - r.uniform(1, 9) / self.unit, 3))} K{length(0.5, 2)}")
                self.say(f"X{plain(round(x - r.uniform(1, 9) / self.unit, 3))} K{length(0.5, 2)}")
            else:
                diameters = r.random() < 0.3
                words = f"P{length(0.5, 2)} Z{plain(round(z + r.choice([-1, 1]) * r.uniform(5, 20) / self.unit, 3))}"
                words += f" I{r.choice(['', '-'])}{length(0.2, 2)} J{length(0.1, 0.3)} K{length(0.5, 1.5)}"
                for word, value in [("R", length(0.5, 2.5)), ("Q", plain(round(r.uniform(-5, 30), 2))), ("H", str(r.randint(0, 2))),
                                    ("E", length(0.2, 2)), ("L", str(r.randint(0, 3)))]:
                    words += f" {word}{value}" if r.random() < 0.5 else ""
                self.say(f"{'G7 ' if diameters else ''}G76 {words}")
                if diameters:
                    self.say(f"X{plain(round(2 * x + 3 / self.unit, 3))} {words}\nG8")
            self.stand()
        elif what == "context":
            self.say("M70\nG91 G20\nM72")
            self.unit_known()

    def unit_known(self):
        self.say("G90" if self.absolute else "G91")
        self.say("G21" if self.unit == 1 else "G20")
        self.stand()

    # Parameters and flow.

    def assign(self):
        r = self.r
        parts = []
        fresh = {}
        for _ in range(r.randint(1, 2)):
            if self.on("named") and (r.random() < 0.5 or not self.on("numbered")):
                name = r.choice(["a", "deep", "_all", "_wide value", "Step 2"])
                text, v = self.expression(2) if self.on("expressions") else self.leaf()
                fresh[("n", name.replace(" ", "").lower())] = v
                parts.append(f"#<{name}>={text if text[0] in '[#-+.0123456789' or text[0].isalpha() else f'[{text}]'}")
            elif self.on("numbered"):
                n = r.choice([31, 32, 100, 101, 102, 499, 1000, 4999])
                text, v = self.expression(2) if self.on("expressions") else self.leaf()
                fresh[("#", n)] = v
                parts.append(f"#{n}={text}")
        if not parts:
            return
        if r.random() < 0.25 and None not in self.at:
            old, self.main = self.main, []
            self.line()
            lines, self.main = self.main, old
            self.main += lines[:-1] + [f"{' '.join(parts)} {lines[-1]}"]
        else:
            self.say(" ".join(parts))
        for (kind, name), v in fresh.items():
            (self.named if kind == "n" else self.values)[name] = v

    def indirect(self):
        r = self.r
        self.say("#31=100")
        self.values[31] = 100
        self.say("#100=" + plain(round(r.uniform(-9, 9), 2)))
        self.values.pop(100, None)
        self.stand()
        self.say(f"G1 X##31 Y[##31 * 2]{self.feed()}")
        self.say("##31=4")
        self.say(f"G1 X#[#31] Y#[#31 + 0]{self.feed()}")
        self.values[100] = 4
        self.stand()

    def positions(self):
        self.known()
        r = self.r
        d = lambda: plain(round(r.uniform(-9, 9) / self.unit, 3))
        if not self.absolute:
            self.say("G90")
            self.absolute = True
        self.say(f"G1 X[#5420 + {d()}] Y[#<_y> - {d()}]{self.feed()}")
        self.say(f"G0 Z[#5422+{d()}]")
        self.stand()

    def body(self, counter=None, arguments=False):
        """Lines that leave the modes known: G17 G90 G94."""
        r = self.r
        keep = self.main, self.at, self.plane, self.absolute, self.mode, self.centres, self.values, self.named
        self.main, self.plane, self.absolute, self.mode, self.centres = [], 17, True, 94, False
        self.values, self.named = {}, {}
        self.say(f"G17 G90 G94{' G91.1' if self.on('centres') else ''}{self.feed()}")
        self.stand()
        for _ in range(r.randint(1, 3)):
            r.choice([self.line, self.arc if self.on("arcs") else self.line])()
        if counter:
            self.say(f"G1 X[{counter} * 1.5] Y{counter}{self.feed()}")
            self.at = [None] * 3
        if arguments:
            self.say(f"G1 X#1 Y[#2 / 2] Z[#3 + 1]{self.feed()}")
            self.say("G91 G1 X[#1 - 2] Y-1\nG90")
            self.at = [None] * 3
        lines = self.main
        self.main, self.at, self.plane, self.absolute, self.mode, self.centres, self.values, self.named = keep
        return lines

    def condition(self):
        if self.on("expressions"):
            text, _ = self.expression(2)
            return f"[{text} {self.r.choice(['GT', 'LT', 'GE', 'LE', 'NE', 'EQ'])} {plain(round(self.r.uniform(-5, 5), 1))}]"
        return self.r.choice(["[1]", "[0]", "[2 GT 1]"])

    def flow(self):
        r = self.r
        self.say("; a branch or a loop")
        label, count = self.label(), f"#{r.choice([200, 201, 202])}"
        kind = r.choice(["if", "while", "do", "repeat"])
        if kind == "if":
            self.say(f"{label} if {self.condition()}")
            self.main += self.body()
            for _ in range(r.randint(0, 2)):
                self.say(f"{label} elseif {self.condition()}")
                self.main += self.body()
            if r.random() < 0.6:
                self.say(f"{label} else")
                self.main += self.body()
            self.say(f"{label} endif")
        elif kind == "repeat":
            self.say(f"{label} repeat [{r.randint(0, 3)}{r.choice(['', '', '.4'])}]")
            self.main += self.body()
            self.say(f"{label} endrepeat")
        else:
            limit = r.randint(1, 4)
            self.say(f"{count}=0")
            self.say(f"{label} while [{count} LT {limit}]" if kind == "while" else f"{label} do")
            self.say(f"{count}=[{count} + 1]")
            jump = r.choice(["", "break", "continue", "continue"])
            if jump:
                inner = self.label()
                self.say(f"{inner} if [{count} EQ {r.randint(1, 3)}]\n{label} {jump}\n{inner} endif")
            self.main += self.body(count)
            self.say(f"{label} endwhile" if kind == "while" else f"{label} while [{count} LT {limit}]")
        self.settle()

    def sub(self):
        """A call of a subroutine; some are made here, before or after the main part."""
        r = self.r
        if not self.subs or r.random() < 0.5:
            name = self.label()
            lines = [f"{name} sub", *self.body(arguments=True)]
            if r.random() < 0.4:
                inner = self.label()
                lines += [f"{inner} if [#1 GT {r.randint(-5, 5)}]", f"{name} return [#1 * 2]", f"{inner} endif"]
            if r.random() < 0.3:
                lines += ["#<own>=[#1 + #2]", f"G1 Z#<own>{self.feed()}"]
            if r.random() < 0.3 and self.subs:
                called, first = r.choice(self.subs)
                if first:
                    lines += [f"{called} call [#2] [#1]", f"G1 X#1{self.feed()}"]
            lines += [f"{name} endsub" + (f" [#2 + {r.randint(1, 9)}]" if r.random() < 0.5 else "")]
            first = r.random() < 0.6
            (self.head if first else self.tail).extend(lines)
            self.subs.append((name, first))
        name, _ = r.choice(self.subs)
        arguments = [self.number(self.coordinate(20), 0.3) for _ in range(r.randint(0, 4))]
        self.say(f"{name} call " + " ".join(f"[{a}]" for a in arguments))
        if r.random() < 0.5:
            self.say(f"G90 G1 X[#<_value> / 10] Y#<_value_returned>{' F100' if self.mode != 93 else ''}")
        self.settle()

    def m98(self):
        r = self.r
        if not self.fanuc or r.random() < 0.5:
            self.labels += 1
            self.fanuc.append(self.labels)
            self.tail += [f"O{self.labels}", *self.body(), *(["#33=[#33 + 1]", "G91 G1 X#33 F200", "G90"] if r.random() < 0.4 else []), "M99"]
        self.say(f"M98 P{r.choice(self.fanuc)}{r.choice(['', '', ' L2', ' L3'])}")
        self.settle()

    # All of it.

    def draw(self):
        r = self.r
        self.say(r.choice(["G21 G90 G17 G94 G54", "G21 G90", "G17 G21 G40 G49 G80 G90 G94"]))
        if self.on("tools") and r.random() < 0.7:
            self.say(f"T{r.randint(1, 4)} M6")
            self.tool = True
            if self.on("lengths") and r.random() < 0.7:
                self.say("G43")
                self.length = self.unit
        if self.on("spindle"):
            self.say(f"S{r.randint(500, 9000)} M3")
            self.turning = 1
        self.say(self.feed().strip())
        self.stand()
        parts = [(self.line, 6), (self.modes, 9)]
        numbered = self.on("numbered")
        parts += [(self.arc, 6)] * self.on("arcs") + [(self.cycles, 2.5)] * self.on("cycles") + [(self.splines, 1.2)] * self.on("splines")
        parts += [(self.assign, 2.5)] * (self.on("named") or numbered) + [(self.flow, 1.3)] * (self.on("flow") and numbered)
        parts += [(self.sub, 1.2)] * (self.on("subs") and numbered) + [(self.m98, 0.7)] * (self.on("m98") and numbered)
        parts += [(self.indirect, 0.5)] * (self.on("indirect") and numbered) + [(self.positions, 0.6)] * self.on("position")
        steps, weights = zip(*parts)
        for step in r.choices(steps, weights, k=r.randint(8, 24)):
            step()

    def dressed(self, line):
        """The same block in another spelling."""
        r = self.r
        if not self.on("forms") or "(" in line or ";" in line or line.startswith("%"):
            return line
        if r.random() < 0.1 and not line.startswith("/"):
            line = f"N{r.randint(1, 99999)} {line}"
        if r.random() < 0.1:
            line = line.lower()
        if r.random() < 0.05 and not re.search(r"[a-z#<]", line):
            line = line.replace(" ", "")
        return line + r.choice(["", "", "", "", "", "", " ", " (note)", " ; note", "\n"])


def unary(name, v):
    return {"ABS": abs, "ACOS": lambda x: math.degrees(math.acos(x)), "ASIN": lambda x: math.degrees(math.asin(x)),
            "COS": lambda x: math.cos(math.radians(x)), "EXP": math.exp, "FIX": math.floor, "FUP": math.ceil,
            "ROUND": lambda x: math.floor(abs(x) + 0.5) * (1 if x > 0 else -1), "LN": math.log, "SIN": lambda x: math.sin(math.radians(x)),
            "SQRT": math.sqrt, "TAN": lambda x: math.tan(math.radians(x))}[name](v)


def power(a, b):
    if a < 0 and abs(b - round(b)) > 1e-9 or abs(a) < 1e-6:
        raise ValueError
    return a ** b


def binary(name, a, b):
    if name in ("EQ", "NE", "GT", "GE", "LT", "LE") and 0 < abs(a - b) < 1e-2 or name == "/" and abs(b) < 1e-3:
        raise ValueError  # too near to a border
    if name == "MOD":
        if abs(b) < 1e-3 or min(math.fmod(a, b) % abs(b), abs(b) - a % abs(b)) < 1e-6:
            raise ValueError
        return math.fmod(a, b) + (abs(b) if math.fmod(a, b) < 0 else 0)
    return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b, "**": lambda: power(a, b),
            "EQ": lambda: float(a == b), "NE": lambda: float(a != b), "GT": lambda: float(a > b), "GE": lambda: float(a >= b),
            "LT": lambda: float(a < b), "LE": lambda: float(a <= b), "AND": lambda: float(bool(a) and bool(b)),
            "OR": lambda: float(bool(a) or bool(b)), "XOR": lambda: float(bool(a) != bool(b))}[name]()


WORDS = re.compile(
    r"(?P<o>\bo(?:<[^>]*>|\[[^\]]*\]|\d+)[ \t]*(?P<word>[a-z]*))|(?P<code>[GM][ \t]*\d+(?:\.\d+)?)"
    rf"|(?P<function>{'|'.join([*UNARY, 'ATAN', 'EXISTS'])})\["
    r"|(?P<operator>\*\*|(?<=[\s\]])(?:MOD|EQ|NE|GT|GE|LT|LE|AND|OR|XOR)(?=[\s\[#])|[-+*/](?=[\s\[#]))"
    r"|(?P<parameter>#\d|#<_|#<|##|#\[)|(?P<magic>\((?:MSG|DEBUG|PRINT),)", re.I)
PARAMETERS = {"#<": "#<name>", "#<_": "#<_name>", "##": "##1", "#[": "#[..]"}


def count(text, counts=None):
    """How often each word stands in a text."""
    counts = collections.Counter() if counts is None else counts
    for found in WORDS.finditer(text):
        if found["o"]:
            counts[f"o {(found['word'] or 'alone').lower()}"] += 1
        elif found["code"]:
            counts[re.sub(r"(?<=[GM])0+(?=\d)", "", re.sub(r"\s", "", found["code"].upper()))] += 1
        else:
            text = found[found.lastgroup].upper()
            counts[PARAMETERS.get(text, "#1") if found.lastgroup == "parameter" else text] += 1
    return counts
