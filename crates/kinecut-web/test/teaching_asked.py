"""Figures whose numbers are answers of kinecut: steps of teaching.py. Each holds the numbers of the page against what the program prints for the input that
the figure shows to copy."""

import math
import re
import shutil
import tempfile
from pathlib import Path

from common import EXAMPLES, LONG
from figures import Verb, choose, figure, number, plain, put, reset, same, settled, told
from playwright.sync_api import Page


def housing(page: Page, verb: Verb) -> None:
    """Figure 1.1: times of the chosen bore are those of `kinecut hole`; a bore that the cutter does not fit into has none; a blind bore differs from one that goes through."""
    choose(page, 1)
    one = figure(page, "1.1")
    for inputs in ({}, {"D1": 65, "D2": 38.5}, {"d": 12}):
        put(page, "1.1", **inputs)
        for bore in range(4):
            one.locator(f'[data-press="bore{bore + 1}"]').click()
            settled(page, "1.1")
            answer = verb("hole", "-", text=one.locator("[data-toml]").inner_text())
            row = one.locator(f'[data-number="m{bore + 1}"]')
            if "feed_time" not in answer:
                assert row.count() == 0 and "fit" in answer["message"], answer
                continue
            same(page, "1.1", f"m{bore + 1}", answer["feed_time"])
            same(page, "1.1", "turns", answer["passes"][0]["turns"])
            same(page, "1.1", "length", answer["feed_length"])
            assert one.locator("[data-section]").get_attribute("data-section") == ("blind" if bore == 2 else "through")
    drill = """[tool]\nnumber = 1\ntype = "drill"\ndiameter = {D}\npoint = {{ twist = {{ point_angle = 118 }} }}\nflute_length = 200\n
[operation]\ntype = "drill"\ntool = 1\nentry = {{ surface = "plane" }}\n{end}\napproach = 2\ncutting_speed = 25\nfeed_per_rev = {{ entry = 0.2, steady = 0.3, exit = 0.2 }}\n"""
    for bore, size, end in [(1, 65, 'exit = { surface = "plane" }\nlength = 50\noverrun = 2'), (3, 32, "depth = 25"), (4, 16, 'exit = { surface = "plane" }\nlength = 50\noverrun = 2')]:
        same(page, "1.1", f"d{bore}", verb("drill", "-", text=drill.format(D=size, end=end))["holes"][0]["time"])
    reset(page, "1.1")
    assert one.locator('[data-number="m4"]').count() == 0 and one.locator('[data-number="d4"]').count() == 1


def bored(page: Page, verb: Verb) -> None:
    """Figure 1.2: way, time, speed and load are those of `kinecut hole --samples rough` for the input that is shown."""
    choose(page, 1)
    one = figure(page, "1.2")
    for inputs in ({}, {"strategy": 1}, {"entry": 1, "strategy": 3}, {"D": 120, "d": 25, "H": 6, "delta": 0.5}):
        reset(page, "1.2")
        for key, value in inputs.items():
            put(page, "1.2", **{key: value})
        settled(page, "1.2")
        rough = verb("hole", "-", "--samples", "rough", text=one.locator("[data-toml]").inner_text())["passes"][0]
        run, samples = rough["run"], rough["run"]["samples"]
        for key, wanted in [("R", rough["path_radius"]), ("n", rough["turns"]), ("step", rough["step"]), ("L", rough["length"]), ("all", run["length"]), ("peak", math.degrees(run["peaks"]["engagement"]))]:
            same(page, "1.2", key, wanted)
        for i in (len(samples["s"]) // 4, len(samples["s"]) // 2, 3 * len(samples["s"]) // 4):
            s = round(samples["s"][i], 2)
            put(page, "1.2", s=s)
            for key, wanted, off in [("time", samples["time"][i], 0.002), ("speed", samples["speed"][i], 0.2)]:
                assert abs(number(page, "1.2", key) - wanted) < off, (inputs, key, told(page, "1.2", key), wanted)
            if samples["engagement"][i] is None:
                assert one.locator('[data-number="angle"]').count() == 0
            else:
                assert abs(number(page, "1.2", "angle") - math.degrees(samples["engagement"][i])) < 0.15, (inputs, s, told(page, "1.2", "angle"))
            # The cutter is where the way is, within what a chord of the drawing leaves out; its disc is what the section shows as removed.
            k = min(range(len(run["way"]["s"])), key=lambda j: abs(run["way"]["s"][j] - s))
            far = math.hypot(run["way"]["x"][k], run["way"]["y"][k])
            high = float(one.locator("[data-removed]").get_attribute("data-removed").split()[1])
            d = inputs.get("d", 40)
            assert high >= far + d / 2 - 0.6, (s, far, high)
    reset(page, "1.2")
    # At the very start the cutter is in a slot; back through what is cleared no load is shown.
    put(page, "1.2", s=0.3)
    assert number(page, "1.2", "angle") > 160, told(page, "1.2", "angle")
    put(page, "1.2", s=5600)
    settled(page, "1.2")
    assert one.locator('[data-number="angle"]').count() == 0 and "not measured" in one.locator("figcaption").inner_text()
    reset(page, "1.2")
    # A path of constant engagement cannot begin in the middle: kinecut's reason is shown, and no number.
    put(page, "1.2", strategy=3)
    settled(page, "1.2")
    assert "cannot start in the centre" in one.locator(".sentence").inner_text() and one.locator("[data-number]").count() == 0
    reset(page, "1.2")


def schemes(page: Page, verb: Verb) -> None:
    """Figures 2.2 and 2.3: lengths, Z, times and first contacts are those of `kinecut drill` for the input that is shown, and the lengths of points those of the paper."""
    choose(page, 2)

    def hole(name: str) -> dict:
        settled(page, name)
        return verb("drill", "-", "--paper", "--load", text=figure(page, name).locator("[data-toml]").inner_text())["holes"][0]

    cases = [({}, "tip"), ({"alphaOut": 31}, "tip"), ({"alphaOut": 40}, "corner"), ({"alphaOut": -25, "L": 31.5, "overrun": 0}, "tip"), ({"form": 1, "alphaOut": 10, "D": 12.5, "point": 130}, "tip"), ({"L": 6, "alphaOut": 0}, "tip")]
    for inputs, first in cases:
        reset(page, "2.2")
        put(page, "2.2", **inputs)
        one = hole("2.2")
        for key, wanted in {"Lin": "L_vr", "Lfull": "L_ust", "Lout": "L_vyh", "Lall": "L_rx", "L1": "L_vr1", "L2": "L_vyh2"}.items():
            same(page, "2.2", key, one["lengths"][wanted])
        for key, wanted in {"Z1": "Z_nvr1", "Z2": "Z_nvr2", "Z3": "Z_nvyh1", "Z4": "Z_end", "K3": "Z_kvyh1", "K4": "Z_kvyh2"}.items():
            same(page, "2.2", key, one["coordinates"][wanted])
        same(page, "2.2", "all", one["time"])
        # The chain adds up in the numbers that are shown, and both frames are L apart.
        shown = {key: number(page, "2.2", key) for key in ("Lin", "Lfull", "Lout", "Lall", "Z3", "K3")}
        assert abs(shown["Lin"] + shown["Lfull"] + shown["Lout"] - shown["Lall"]) < 0.0015, shown
        assert abs(shown["Z3"] + plain(figure(page, "2.2").locator('[data-field="L"]').input_value()) - shown["K3"]) < 0.0011, shown
        caption = figure(page, "2.2").locator("figcaption").inner_text()
        assert ("The tip breaks through first" in caption) == (first == "tip") and ("Warning: the corner" in caption) == (first == "corner"), caption
        assert ("Steady cutting is negative" in caption) == (one["lengths"]["L_ust"] < 0), caption
        for share in (0.1, 0.5, 0.9):
            z = round(one["coordinates"]["Z_nvr1"] - share * one["lengths"]["L_rx"], 3)
            put(page, "2.2", Z=z)
            way = one["coordinates"]["Z_nvr1"] - z
            load = one["load"]
            i = next(k for k, w in enumerate(load["way"]) if w >= way)
            t = (way - load["way"][i - 1]) / (load["way"][i] - load["way"][i - 1])
            wanted = 100 * (load["share"][i - 1] + t * (load["share"][i] - load["share"][i - 1]))
            assert abs(number(page, "2.2", "share") - wanted) < 0.11, (inputs, z, told(page, "2.2", "share"), wanted)
            zone = next(k for k, zone in enumerate(one["zones"]) if z >= zone["to"])
            before = sum(k["time"] for k in one["zones"][:zone])
            stretch = one["zones"][zone]
            same(page, "2.2", "feed", stretch["feed"])
            assert abs(number(page, "2.2", "time") - before - stretch["time"] * (stretch["from"] - z) / (stretch["from"] - stretch["to"])) < 0.002
    reset(page, "2.2")
    # The lengths that are printed in the paper, and its cosine.
    assert [told(page, "2.3", f"L{i}") for i in range(8)] == ["6.009", "7.907", "4.202", "9.134", "5.107", "5.107", "2.887", "0.000"]
    assert [figure(page, "2.3").locator(f'[data-printed-number="L{i}"]').inner_text() for i in (3, 4, 5)] == ["", "4.378", "4.378"]
    assert figure(page, "2.3").locator("[data-point]").count() == 16 and figure(page, "2.3").locator("[data-point] .part").count() == 16
    for inputs in ({}, {"D": 16, "point": 100, "alpha": 35}, {"D": 30, "alpha": 0, "rho": 25}):
        put(page, "2.3", form=2)
        put(page, "2.3", **{k: v for k, v in inputs.items() if k == "rho"})
        put(page, "2.3", form=0)
        put(page, "2.3", **{k: v for k, v in inputs.items() if k != "rho"})
        for form in range(8):
            put(page, "2.3", form=form)
            one = hole("2.3")
            same(page, "2.3", f"L{form}", one["lengths"]["L_vr1"])
            same(page, "2.3", f"r{form}", one["first_contact_radius"])
    reset(page, "2.3")
    put(page, "2.3", form=2)
    put(page, "2.3", rho=8)
    settled(page, "2.3")
    assert "refuses" in figure(page, "2.3").locator(".sentence").inner_text()
    reset(page, "2.3")


def window(page: Page, verb: Verb) -> None:
    """Figures 2.1 and 2.7: what is computed and the three columns are those of `kinecut drill --paper`, and the printed ones those of the paper."""
    choose(page, 2)
    one = figure(page, "2.1")

    def hole(name: str) -> dict:
        settled(page, name)
        return verb("drill", "-", "--paper", text=figure(page, name).locator("[data-toml]").inner_text())

    for inputs in ({}, {"RS": 30, "x": 4}, {"D": 12, "form": 0, "L": 20, "approach": 1}):
        for key, value in inputs.items():
            put(page, "2.1", **{key: value})
        plan = hole("2.1")["holes"][0]
        assert plan["lengths"]["L_vyh"] == plan["coordinates"]["Z_nvyh1"] - plan["coordinates"]["Z_end"] or abs(plan["lengths"]["L_vyh"] - plan["coordinates"]["Z_nvyh1"] + plan["coordinates"]["Z_end"]) < 1e-9
        for key, wanted in [("need", plan["lengths"]["L_vyh"]), ("Z3", plan["coordinates"]["Z_nvyh1"]), ("Z4", plan["coordinates"]["Z_end"]), ("time", plan["time"]), ("last", plan["last_contact_radius"])]:
            same(page, "2.1", key, wanted)
        need = plan["lengths"]["L_vyh"]
        for b, words in [(round(need - 0.01, 3), "not out"), (round(need + 0.01, 3), "is out")]:
            put(page, "2.1", b=b)
            settled(page, "2.1")
            assert f"the point is {words}" in one.locator("figcaption").inner_text() if words == "not out" else "the point is out" in one.locator("figcaption").inner_text(), (b, need)
            assert (one.locator("svg .wrongline").count() == 1) == (words == "not out")
    reset(page, "2.1")
    assert told(page, "2.1", "need") == "7.907" and told(page, "2.1", "short") == "1.907"
    # The paper's own window: every number that it prints, and the exact ones.
    printed = {"t1": "1.485", "t2": "26.784", "t3": "7.091", "t": "35.360", "Z4": "−159.405", "K4": "−109.405", "L1": "7.907"}
    for key, text in printed.items():
        assert figure(page, "2.7").locator(f'[data-printed-number="{key}"]').inner_text() == text, key
    assert [told(page, "2.7", key) for key in ("t1", "t2", "t3", "t")] == ["2.490", "26.784", "7.469", "36.743"]
    cases = [{}, {"kindOut": 2, "RSout": 40, "xOut": 6}, {"kindIn": 0, "alphaIn": 20, "kindOut": 0, "alphaOut": -15}, {"kindIn": 1, "RSin": 60, "xIn": 5, "approach": 3.5}]
    for inputs in cases:
        reset(page, "2.7")
        for key, value in inputs.items():
            put(page, "2.7", **{key: value})
        sheet = hole("2.7")
        plan = sheet["holes"][0]
        for key, group, of in [("L1", "lengths", "L_vr1"), ("L2", "lengths", "L_vr2"), ("L3", "lengths", "L_vyh2"), ("Z1", "coordinates", "Z_nvr1"), ("Z2", "coordinates", "Z_nvr2"), ("Z4", "coordinates", "Z_nvyh2")]:
            same(page, "2.7", key, plan[group][of])
            formula = figure(page, "2.7").locator(f'[data-line="{key}"] text').nth(2).text_content()
            assert abs(plain(formula) - plan["paper"][group][of]) < 0.00051, (inputs, key, formula)
            if of in plan["paper"]["printed_lengths"]:
                assert abs(plain(figure(page, "2.7").locator(f'[data-printed-number="{key}"]').inner_text()) - plan["paper"]["printed_lengths"][of]) < 0.00051
        same(page, "2.7", "t", plan["time"])
        for i, key in enumerate(("t1", "t2", "t3", "t")):
            shown = figure(page, "2.7").locator(f'[data-line="{key}"] text').nth(3).text_content()
            assert abs(plain(shown) - plan["paper"]["printed_times"][i]) < 0.00051, (inputs, key)
        # The page names the file of its question in the program's head, the shell the standard input: the blocks are the same.
        blocks = [line for line in figure(page, "2.7").locator("[data-program]").inner_text().splitlines() if line.startswith("N")]
        assert blocks == [line for line in sheet["program"].splitlines() if line.startswith("N")] and len(blocks) > 10, blocks
    # The answer to the question for the class holds.
    reset(page, "2.7")
    put(page, "2.7", kindOut=0)
    put(page, "2.7", approach=0)
    settled(page, "2.7")
    assert figure(page, "2.7").locator(".differs").inner_text().startswith("1 of the numbers")
    put(page, "2.7", form=0, point=90)
    settled(page, "2.7")
    assert "all numbers that the program prints are the exact ones" in figure(page, "2.7").locator(".differs").inner_text()
    reset(page, "2.7")


def positions(page: Page, verb: Verb) -> None:
    """Figure 4.4: lengths, angles and exits are those of `kinecut face` about the drawing of the cover."""
    choose(page, 4)
    folder = EXAMPLES / "04_gear_pump_cover"
    text = (folder / "face.toml").read_text()
    one = figure(page, "4.4")
    for gamma, c in [(20, 0), (322.726, 0.521), (150, -3), (0, 2)]:
        put(page, "4.4", gamma=gamma, c=c)
        settled(page, "4.4")
        answer = verb("face", "-", "--events", text=f"{text}{one.locator('[data-toml]').inner_text()}", folder=folder)
        way = answer["ways"][0]
        for key, wanted in [("bad", way["bad"]), ("exits", way["exits"]), ("entries", way["entries"]), ("least", answer["optimum"]["value"]), ("bound", answer["optimum"]["lower_bound"])]:
            # The drawing has arcs to the digits of a DXF, the figure to all.
            assert abs(number(page, "4.4", key) - wanted) < 0.002, (gamma, key, told(page, "4.4", key), wanted)
        bad = [s for s in answer["stretches"] if s["met"] == "exit" and s["weight"] > 0]
        # A stretch of no length comes and goes with those digits.
        assert len([s for s in bad if s["to"] - s["from"] > 1e-4]) <= number(page, "4.4", "count") <= len(bad) + 3
        assert one.locator("[data-revolution]").count() == 6
        for tile in one.locator("[data-revolution]").all():
            turn = int(tile.get_attribute("data-revolution"))
            events = [e for e in answer["events"] if e["tooth"] == 0 and e["front"] and e["exit"] and math.floor(e["spindle_turned"] / 360) == turn]
            wanted = f"{sum(e['exit_angle'] < 90 for e in events)} bad of {len(events)}"
            assert wanted in tile.text_content(), (turn, wanted, tile.text_content())
            for e in events:
                if e["exit_angle"] < 90:
                    assert f"{e['exit_angle']:.0f}°" in tile.text_content(), (turn, e)
    put(page, "4.4", gamma=30, c=0)
    settled(page, "4.4")
    # A tile says what the figure says at that turn.
    assert f"{number(page, '4.4', 'bad'):.1f} mm in {told(page, '4.4', 'count')}" in one.locator('[data-tile="30"]').text_content()
    assert "too wide" in one.locator('[data-tile="90"]').text_content()
    put(page, "4.4", gamma=90)
    settled(page, "4.4")
    assert "wider" in one.locator(".sentence").inner_text() or "too wide" in one.locator(".sentence").inner_text()
    assert one.locator("[data-number]").count() == 0
    one.locator('[data-press="best"]').click()
    assert abs(number(page, "4.4", "above")) < 0.001 and plain(one.locator('[data-field="gamma"]').input_value()) > 142.7, told(page, "4.4", "above")
    reset(page, "4.4")


def grazed(page: Page, verb: Verb) -> None:
    """Paper 3: curve, folds, grazing points and forms are those of `kinecut grazing` for the input that the figure shows to copy."""
    choose(page, 3)

    def sheets(name: str) -> list[dict]:
        settled(page, name)
        answer = verb("grazing", "-", text=figure(page, name).locator("[data-toml]").inner_text())
        return answer if isinstance(answer, list) else [answer]

    for inputs in ({}, {"vz": 900, "wx": -400}, {"vx": 0, "vy": 0, "vz": -300, "wx": 0, "wy": 0}, {"D": 16, "rc": 2}):
        put(page, "3.1", **inputs)
        [sheet] = sheets("3.1")
        for key, wanted in [
            ("loops", len(sheet["loops"])),
            ("length", sum(loop["length"] for loop in sheet["loops"])),
            ("winding", sum(loop["winding"] for loop in sheet["loops"])),
            ("folds", len(sheet["folds"])),
            ("share", 100 * sheet["entering"]["entering_area"] / sheet["entering"]["area"]),
            ("gained", sheet["entering"]["gained"] / 1000),
            ("top", math.hypot(*sheet["ends"][1]["velocity"])),
        ]:
            same(page, "3.1", key, wanted)
    # The tool that spins about its own axis slides in itself.
    still = [told(page, "3.1", key) for key in ("loops", "length", "folds", "gained")]
    put(page, "3.1", wz=1000)
    assert [told(page, "3.1", key) for key in ("loops", "length", "folds", "gained")] == still
    assert figure(page, "3.1").locator("[data-toml]").inner_text().endswith("1000]\n")
    reset(page, "3.1")
    # No motion has no curve, and kinecut says why.
    put(page, "3.1", vx=0, vy=0, vz=0, wx=0, wy=0)
    settled(page, "3.1")
    assert "KC1201" in figure(page, "3.1").locator(".sentence").inner_text() and figure(page, "3.1").locator("[data-number]").count() == 0
    reset(page, "3.1")
    for way in (8.5, 20, 45, 56, 65):
        put(page, "3.2", s=way)
        [sheet] = sheets("3.2")
        r, z = number(page, "3.2", "r"), number(page, "3.2", "z")
        ends = [(band["enters"][k], band["normals"][k]) for band in sheet["bands"] for k in (0, 1) if band["enters"] and math.dist(band["places"][k], (r, z)) < 0.001]
        assert any(abs((number(page, "3.2", "first") - p[0] + 180) % 360 - 180) < 0.001 and abs((number(page, "3.2", "second") - p[1] + 180) % 360 - 180) < 0.001 for p, _ in ends), (way, r, z, ends)
        assert number(page, "3.2", "off") < 1e-9
        if figure(page, "3.2").locator('[data-number="QP"]').count():
            assert abs(math.hypot(r, z - number(page, "3.2", "zQ")) - number(page, "3.2", "QP")) < 0.002
    reset(page, "3.2")
    # At the tip of this mill the whole circle enters.
    put(page, "3.2", s=1)
    settled(page, "3.2")
    assert "whole circle enters" in figure(page, "3.2").locator(".sentence").inner_text()
    reset(page, "3.2")
    folds: list[list[str]] = []
    for inputs in ({}, {"r": 4}, {"r": 2}, {"r": 8, "xc": 10}):
        put(page, "3.3", **inputs)
        for letter, sheet in zip("ab", sheets("3.3")):
            torus = next(i for i, piece in enumerate(sheet["pieces"]) if "torus" in piece["what"])
            wanted = sorted(f["u"] for f in sheet["folds"] if f["piece"] == torus)
            same(page, "3.3", f"folds{letter.upper()}", len(wanted))
            for i, u in enumerate(wanted):
                same(page, "3.3", f"{letter}{i}", u)
        folds.append([told(page, "3.3", key) for key in ("a0", "a1", "b0", "b1") if figure(page, "3.3").locator(f'[data-number="{key}"]').count()])
    # The tube radius is not in the condition of a fold; the centre is.
    assert folds[0] == folds[1] == folds[2] != folds[3] and len(folds[0]) == 4 and folds[0][:2] == folds[0][2:], folds
    reset(page, "3.3")
    names = {"nothing": "no curve on the torus", "two through-branches": "two through-branches", "one U": "one U", "two U": "two U", "one closed loop": "one closed loop"}
    signs = {"nothing": "–", "two through-branches": "‖", "one U": "∪", "two U": "⊍", "one closed loop": "○"}
    for vz, wy in [(300, 3000), (0, 0), (-150, 6000), (450, -1500)]:
        put(page, "3.4", vz=vz, wy=wy)
        [sheet] = sheets("3.4")
        torus = next(i for i, piece in enumerate(sheet["pieces"]) if "torus" in piece["what"])
        outcome = sheet["pieces"][torus]["outcome"]
        assert figure(page, "3.4").locator("figcaption").inner_text().find(f"°/min: {names[outcome]}") > 0, (vz, wy, outcome)
        assert figure(page, "3.4").locator(f'[data-form="{vz} {wy}"]').text_content() == signs[outcome], (vz, wy, outcome)
        same(page, "3.4", "folds", sum(f["piece"] == torus for f in sheet["folds"]))
    seen = set(figure(page, "3.4").locator("[data-form]").all_text_contents())
    assert len(seen) >= 4 and "?" not in seen, seen
    cones = next(group["cones"][0] for group in verb("grazing", "-", "--gallery", text="") if group["cones"])
    same(page, "3.4", "few", cones[0]["distance"])
    same(page, "3.4", "many", cones[-1]["distance"])
    reset(page, "3.4")


def held(page: Page, verb: Verb) -> None:
    """A saved page goes from one of the inputs whose answers it holds to the next, and shows no number for others; it says of each figure which kind it is."""
    choose(page, 4)
    folder = Path(tempfile.mkdtemp(prefix="kinecut-held-"))
    with page.expect_download(timeout=LONG) as kept:
        page.locator('[data-save="alone"]').click()
    path = folder / "page.html"
    kept.value.save_as(path)
    alone = page.context.browser.new_page()
    try:
        alone.goto(path.as_uri())
        one = figure(alone, "4.4")
        one.wait_for()
        assert re.search(r"saved in this page for \d\d inputs", one.locator("figcaption").inner_text())
        assert "computed in the page itself" in figure(alone, "4.5").locator("figcaption").inner_text()
        text = (EXAMPLES / "04_gear_pump_cover/face.toml").read_text()
        seen = set()
        one.locator(".handle").first.focus()
        for _ in range(2):
            alone.keyboard.press("ArrowRight")
            assert one.get_attribute("data-is") == "there"
            seen.add(one.locator('[data-field="gamma"]').input_value())
            way = verb("face", "-", text=f"{text}{one.locator('[data-toml]').inner_text()}", folder=EXAMPLES / "04_gear_pump_cover")["ways"][0]
            assert abs(number(alone, "4.4", "bad") - way["bad"]) < 0.002, (seen, way)
        assert len(seen) == 2, seen
        put(alone, "4.4", gamma=33.3)
        assert one.get_attribute("data-is") == "unsaved" and one.locator("[data-number]").count() == 0 and "no answer" in one.locator(".sentence").inner_text()
        one.locator("[data-reset]").click()
        assert number(alone, "4.4", "bad") == 210.017
    finally:
        alone.close()
        shutil.rmtree(folder, ignore_errors=True)
    choose(page, 1)


STEPS = [housing, bored, schemes, window, grazed, positions, held]
