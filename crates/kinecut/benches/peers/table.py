"""Table and plot of `run`, and the project file that CAMotics reads."""

import math

import inputs

HEAD = ("case", "program", "step", "wall", "CPU", "peak", "volume off", "off/exact", "largest", "rms", "to kinecut")
UNITS = ("", "", "[mm]", "[s]", "[s]", "[MiB]", "[mm³]", "", "[mm]", "[mm]", "")


def base(row, rows):
    """The run of kinecut that a row stands beside: same case, then same form and step before either alone."""
    ours = [r for r in rows if r["case"] == row["case"] and r["program"] == "kinecut" and r["code"] in (0, 1)]
    return max(ours, key=lambda r: (r["step"] == row["step"]) * 2 + (r["form"] == row["form"]), default=None)


def show(rows, notes, floor):
    lines = [HEAD, UNITS]
    for row in rows:
        number = lambda key, form: format(row[key], form) if row.get(key) is not None else "-"
        beside, program = base(row, rows), row["program"] + ("" if row["form"] == "lines" else f", {row['form']}")
        failed = row["code"] not in (0, 1) or row["program"] != "kinecut" and row["code"]
        part = row["off"] / row["reference"] if row.get("off") is not None and row.get("reference") else None
        lines.append((row["case"], program + (" *" if row.get("alone") else ""), f"{row['step']:g}" if row["step"] else "-",
                      "failed" if failed else number("wall", ".2f"), number("cpu", ".2f"),
                      f"< {floor:.0f}" if row["peak"] <= floor * 1.05 else number("peak", ".0f"), number("off", "+.3f"),
                      f"{part:+.1e}" if part is not None else "-", number("largest", ".5f"), number("rms", ".5f"),
                      f"{row['wall'] / beside['wall']:.2f}" if beside and not failed else "-"))
    widths = [max(len(line[n]) for line in lines) for n in range(len(HEAD))]
    for line in lines:
        print("  ".join(text.ljust(w) if n < 2 else text.rjust(w) for n, (text, w) in enumerate(zip(line, widths))).rstrip())
    print("\n* wall and CPU of the work alone, as the program tells it: reading of moves, start and compiling do not count.\n"
          "Peak of the whole process. To kinecut: wall over that of kinecut's run of the same case and step, with the same result if\n"
          "there is one, else with the nearest. Largest and rms: heights against the exact envelope, at points without a wall within\n"
          "0.25 mm. Volume of a mesh that is not closed: from these heights.\n")
    print("\n".join(notes))


def camotics(case, step):
    tool = {"units": "metric", "shape": "ballnose" if case.tool.kind == "ball-nose" else "cylindrical", "length": case.tool.length,
            "diameter": case.tool.diameter, "description": ""}
    block = {"automatic": False, "margin": 0, "bounds": {"min": case.stock[:3], "max": case.stock[3:]}}
    return {"units": "metric", "resolution-mode": "manual", "resolution": step, "tools": {"1": tool}, "workpiece": block,
            "files": ["program.nc"]}


def exponent(points):
    """Slope of the straight line through the logarithms, by least squares."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mx, my = (sum(v) / len(logs) for v in zip(*logs))
    return sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs)


def panel(left, title, unit, points):
    """Panel of a plot: wall and CPU over one quantity, both axes logarithmic."""
    xs, ys = [p[0] for p in points], [v for p in points for v in p[1:]]
    across = lambda v: left + 60 + 280 * math.log(v / min(xs)) / math.log(max(xs) / min(xs))
    low, high = min(ys) / 1.2, max(ys) * 1.2
    down = lambda v: 300 - 250 * math.log(v / low) / math.log(high / low)
    out = [f'<path d="M{left + 50} 40V310H{left + 350}"/>', f'<text x="{left + 50}" y="25">{title}</text>',
           f'<text x="{left + 200}" y="350" text-anchor="middle">{unit}</text>', f'<text x="{left + 8}" y="36">s</text>']
    for x in sorted(set(xs)):
        out.append(f'<path d="M{across(x):.1f} 310v5"/><text x="{across(x):.1f}" y="330" text-anchor="middle">{x:g}</text>')
    for y in (m * 10.0**e for e in range(-4, 5) for m in (1, 2, 5)):
        if low <= y <= high:
            out.append(f'<path d="M{left + 50} {down(y):.1f}h-5"/><text x="{left + 42}" y="{down(y) + 4:.1f}" text-anchor="end">{y:g}</text>')
    for n, dash in ((1, ""), (2, ' stroke-dasharray="5 4"')):
        line = " ".join(f"{across(p[0]):.1f},{down(p[n]):.1f}" for p in sorted(points))
        out.append(f'<polyline points="{line}"{dash}/>')
        out += [f'<circle cx="{across(p[0]):.1f}" cy="{down(p[n]):.1f}" r="2.5"/>' for p in points]
    return out


def plot(bench, path, coarse):
    """Cost of kinecut on case b: over the step with all moves, over the moves at one step."""
    over = {"step": [], "moves": []}
    for kind, steps, shares in (("step", (0.4, 0.2, 0.1, 0.05), (1,)), ("moves", (0.1,), (1 / 8, 1 / 4, 1 / 2, 1))):
        for share in shares:
            case = inputs.wave(inputs.Tool("ball-nose", 6), f"b, {share:g} of all", share)
            case.write(bench.folder(case))
            for step in steps:
                found = bench.ours(case, step * coarse, None)
                over[kind].append((step * coarse if kind == "step" else len(case.moves) - 1, found["wall"], found["cpu"]))
    out, left = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 820 370" font-family="sans-serif" font-size="12">',
                 '<rect width="820" height="370" fill="#fff"/><g stroke="#000" fill="none">'], 0
    for kind, points in over.items():
        wall, cpu = (exponent([(p[0], p[n]) for p in points]) for n in (1, 2))
        title = f"time over {kind}, exponent: wall {wall:.2f}, CPU (dashed) {cpu:.2f}"
        print(title)
        for n, part in enumerate(panel(left, title, "step [mm]" if kind == "step" else "moves", points)):
            out.append(part.replace("<text", '<text stroke="none" fill="#000"'))
        left += 410
    path.write_text("\n".join(out) + "\n</g></svg>\n")
