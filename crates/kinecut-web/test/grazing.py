"""The windows of a grazing curve and of an envelope in a browser, as a person uses them: python3 grazing.py KINECUT [STEP ..]. Numbers are
read back from the page and compared with what the command line prints for the same text; the forms of the curve on a torus are reached by
dragging. Needs and settings: common.py."""

import json
import math
from statistics import median

from common import LONG, MARK, SIZES, UNMARKED, WEEKLY, Script, Served, Stage, clean, frame, open_file, painted, settled, shell, shot, visited
from playwright.sync_api import Browser, Page

FOLDER = "06_five_axis_sweep"
MOVING = "main.moving"
# The bound for nineteen of twenty answers to a key [ms].
DRAWN = 100
SECTION = """title = "Corner of 5 about a fixed centre"
tool.shape.apt = { corner_radius = 5, centre_radius = 6, centre_height = 8, lower_angle = 10, upper_angle = 0, height = 40 }
twist = { velocity = [300, 40, -260], turn = [120, 900, 0] }
"""


def asked(program: str, verb: str, text: str, beside: str, *more: str):
    """The answer of the command line to the same text."""
    return shell(program, verb, "-", *more, text=text, folder=beside)


class Heard:
    """Questions of the page to a verb, and the answers."""

    def __init__(self, page: Page, verb: str):
        self.all: list = []
        self.page = page
        self.verb = verb
        page.on("response", self.hear)

    def hear(self, response) -> None:
        if response.url.endswith(f"/api/verb/{self.verb}"):
            self.all.append(response)

    def text(self) -> str:
        return self.all[-1].request.post_data_json["text"]

    def answer(self):
        return self.all[-1].json()

    def end(self) -> None:
        self.page.remove_listener("response", self.hear)


def opened(page: Page, name: str) -> None:
    open_file(page, f"{FOLDER}/{name}")
    page.locator(f'.tab.on button[title="{FOLDER}/{name}"]').wait_for()
    assert settled(page, MOVING) == "done", name


def drawn(page: Page) -> None:
    """Waits for what comes after the answer: the cases of the paper where they are looked at, the volumes of a move."""
    painted(page)
    page.wait_for_function(
        """() => !document.querySelector('details.paper[open]:not(:has(q))')
          && (!document.querySelector('[data-fact="whole"]') || /cm³/.test(document.querySelector('[data-fact="whole"] dd').textContent))""",
        timeout=LONG,
    )


def number(text: str) -> float:
    return float(text.replace("\u2212", "-").split()[0].rstrip("°%"))


def rows(page: Page, table: str) -> list[list[str]]:
    return page.locator(f'[data-table="{table}"] tbody tr').evaluate_all("all => all.map(r => [...r.cells].map(c => c.textContent.trim()))")


def vector(page: Page, name: str) -> list[float]:
    return [float(v) for v in page.locator(f'[data-vector="{name}"] input').evaluate_all("all => all.map(i => i.value)")]


def agrees(page: Page, sheet: dict) -> None:
    """Tables, facts and plane are the sheet's."""
    shown = rows(page, "spans")
    spans = sheet["spans"]
    assert len(shown) == len(spans), (len(shown), len(spans))
    for row, span in zip(shown, spans):
        assert row[0] == sheet["pieces"][span["piece"]]["what"], (row, span)
        for k, name in ((0, "from"), (1, "to")):
            assert abs(number(row[3 + k].removesuffix("fold")) - span[name]) < 5.1e-5, (row, span)
            assert row[3 + k].endswith("fold") == span["folds"][k], (row, span)
            assert abs(number(row[5 + k]) - span["lengths"][k]) < 5.1e-7, (row, span)
    loops = rows(page, "loops")
    assert [(int(r[2]), r[1] == "yes") for r in loops] == [(one["winding"], one["closed"]) for one in sheet["loops"]], loops
    assert all(abs(number(r[3]) - one["length"]) < 5.1e-7 for r, one in zip(loops, sheet["loops"])), loops
    fact = lambda name: page.locator(f'[data-fact="{name}"] dd').first.inner_text()
    assert int(fact("curves").split()[0]) == len(sheet["loops"])
    assert abs(number(fact("length")) - sum(one["length"] for one in sheet["loops"])) < 5.1e-4
    entering = sheet["entering"]
    assert abs(number(fact("enters")) - 100 * entering["entering_area"] / entering["area"]) < 0.051
    for name, known in (("velocity", sheet["twist"]["velocity"]), ("turn", sheet["twist"]["turn"]), ("top", sheet["ends"][1]["velocity"])):
        told = vector(page, name)
        assert all(abs(a - b) <= 6e-6 * max(1, abs(b)) for a, b in zip(told, known)), (name, told, known)
    # Folds are in the plane at their angles.
    frame = page.locator(".plane .frame").get_attribute("d")
    left, right = (float(part) for part in (frame[1:].split(" ")[0], frame.split("H")[1].split("V")[0]))
    places = sorted(page.locator(".plane svg .fold").evaluate_all("all => all.map(c => Number(c.getAttribute('cx')))"))
    wanted = sorted(left + (right - left) * fold["theta"] / 360 for fold in sheet["folds"])
    assert len(places) == len(wanted) and all(abs(a - b) < 0.1 for a, b in zip(places, wanted)), (places, wanted)
    drawn = page.locator(".plane [data-span]").evaluate_all("all => all.map(p => Number(p.dataset.span))")
    assert set(drawn) == set(range(len(spans))), drawn


def numbers(page: Page, served: Served, program: str) -> None:
    """Every number of the page is the verb's."""
    opened(page, "tool.toml")
    beside = str(served.folder / FOLDER)
    sheet = asked(program, "grazing", (served.folder / FOLDER / "tool.toml").read_text(), beside)
    agrees(page, sheet)
    assert page.locator('[data-fact="outcome"] dd').inner_text().startswith("one U")
    # A span that is chosen in the table is marked in the plane.
    page.locator('[data-row="2"] button').click()
    assert page.locator(".plane .curve.on").count() == 2 and page.locator(".plane .curve.on").first.get_attribute("data-span") == "2"
    page.locator('[data-row="2"] button').click()
    assert page.locator(".plane .curve.on").count() == 0
    shot(page, "grazing-tool")


def drag(page: Page, which: str, right: float, down: float, steps: int = 24) -> None:
    page.evaluate("() => scrollTo(0, 0)")
    box = page.locator(f'[data-grip="{which}"]').bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for i in range(1, steps + 1):
        page.mouse.move(x + right * i / steps, y + down * i / steps)
        frame(page)
    page.mouse.up()
    assert settled(page, MOVING) == "done"


def hands(page: Page, served: Served, program: str) -> None:
    """Arrows are dragged and moved by keys: the curve follows, and the text is the motion that is shown."""
    beside = str(served.folder / FOLDER)
    page.locator('[data-view="top"]').click()
    before = {name: vector(page, name) for name in ("tip", "top")}
    heard = Heard(page, "grazing")
    drag(page, "top", 0, -60)
    assert len(heard.all) > 3, "the curve did not follow the hand"
    after = {name: vector(page, name) for name in ("tip", "top")}
    # From above, up is Y: the top goes there, the tip stays; both go on along the axis as before.
    size = max(map(abs, after["top"]))
    assert after["top"][1] - before["top"][1] > 0.2 * size, (before, after)
    assert abs(after["top"][0] - before["top"][0]) < 0.02 * size and abs(after["tip"][1] - before["tip"][1]) < 2e-3 * size, (before, after)
    assert after["tip"][2] == after["top"][2] == before["tip"][2]
    agrees(page, asked(program, "grazing", heard.text(), beside))
    assert "# degrees/min" in heard.text(), "more than the numbers was changed"
    # With Shift both ends go along: the turn stays.
    turn = vector(page, "turn")
    page.keyboard.down("Shift")
    drag(page, "tip", 40, 0)
    page.keyboard.up("Shift")
    assert all(abs(a - b) < 3e-3 * max(map(abs, turn)) for a, b in zip(vector(page, "turn"), turn)), (turn, vector(page, "turn"))
    # Keys, one by one: how long each takes until the curve is on the screen.
    grip = page.locator('[data-grip="tip"]')
    grip.focus()
    times = []
    known = vector(page, "tip")
    for key in ("ArrowRight", "ArrowUp") * 10:
        count = page.evaluate("() => Number(document.documentElement.dataset.drawn)")
        page.keyboard.press(key)
        page.wait_for_function("n => Number(document.documentElement.dataset.drawn) > n", arg=count, timeout=LONG)
        times.append(page.evaluate("() => Number(document.documentElement.dataset.drawnMs)"))
    moved = vector(page, "tip")
    assert moved[0] > known[0] and moved[1] > known[1], (known, moved)
    agrees(page, asked(program, "grazing", heard.text(), beside))
    print(f"  from the key to the curve: {median(times):.0f} ms in the middle, {max(times):.0f} ms at most", flush=True)
    if WEEKLY:
        assert sorted(times)[int(0.95 * len(times))] < DRAWN, times
    # Typed numbers; the spin of the spindle changes nothing.
    lengths = rows(page, "loops")
    page.locator("#g-turn-Z").fill("5000")
    assert settled(page, MOVING) == "done"
    assert vector(page, "turn")[2] == 5000 and rows(page, "loops") == lengths
    page.locator("#g-velocity-X").fill("777")
    assert settled(page, MOVING) == "done"
    assert vector(page, "velocity")[0] == 777
    agrees(page, asked(program, "grazing", heard.text(), beside))
    heard.end()
    # Back to the text as it was.
    page.locator(".stage canvas").focus()
    for _ in range(40):
        if page.locator(".tab.on .dot").count() == 0:
            break
        page.keyboard.press("Control+z")
        settled(page, MOVING)
    assert page.locator(".tab.on .dot").count() == 0, "undo does not lead back"


def outcome(page: Page) -> str:
    return page.locator('[data-fact="outcome"] dd').first.evaluate("d => d.firstElementChild.textContent")


def outcomes(page: Page, served: Served, program: str) -> None:
    """The forms that the curve can have on a torus, reached by dragging the top's velocity."""
    beside = str(served.folder / FOLDER)
    opened(page, "tool.toml")
    page.locator(".paper summary").click()
    page.locator("[data-case]").first.wait_for(timeout=LONG)
    assert page.locator(".paper q").count() == 9
    verdicts = page.locator(".paper .tag").all_inner_texts()
    assert sorted(set(verdicts)) == ["corrected", "not needed", "right"], verdicts
    reached: set[str] = set()
    for case, right, down in (
        ("Torus outward: nothing", 0, -1),
        ("Torus outward: one closed loop", 0, -1),
        ("Torus outward: two U", 1, 0),
        ("Torus inward: two U", 0, 1),
    ):
        page.locator(f'[data-case="{case}"]').click()
        assert settled(page, MOVING) == "done"
        page.locator('[data-view="top"]').click()
        was = outcome(page)
        assert was == case.split(": ")[1], (case, was)
        heard = Heard(page, "grazing")
        # There and back: each border is crossed twice.
        for way in [1] * 10 + [-1] * 12:
            drag(page, "top", 8 * way * right, 8 * way * down, steps=2)
            now = outcome(page)
            if now == was:
                continue
            reached.add(now)
            # Behind each border the page says what the command line says.
            sheet = asked(program, "grazing", heard.text(), beside)
            piece = next(p for p in sheet["pieces"] if "torus" in p["what"])
            assert piece["outcome"] == now, (piece, now)
            agrees(page, sheet)
            was = now
        heard.end()
    print(f"  reached by dragging: {sorted(reached)}", flush=True)
    wanted = {"nothing", "two through-branches", "one U", "two U", "one closed loop"}
    assert wanted <= reached, reached
    shot(page, "grazing-case")
    page.locator(".paper summary").click()
    page.locator(".stage canvas").focus()
    for _ in range(60):
        if page.locator(".tab.on .dot").count() == 0:
            break
        page.keyboard.press("Control+z")
        settled(page, MOVING)


def radius(page: Page, served: Served) -> None:
    """The radius of a torus is not in the equation of its folds; its centre is."""
    (served.folder / FOLDER / "section.toml").write_text(SECTION)
    opened(page, "section.toml")

    def folds() -> list[str]:
        return [cell for row in rows(page, "spans") if "torus" in row[0] for cell in row[3:5] if cell.endswith("fold")]

    known = folds()
    assert known, rows(page, "spans")
    field = page.locator('[data-key="tool.shape.apt.corner_radius"] input')
    field.fill("4")
    assert settled(page, MOVING) == "done"
    assert folds() == known, (known, folds())
    page.locator('[data-key="tool.shape.apt.centre_radius"] input').fill("7")
    assert settled(page, MOVING) == "done"
    assert folds() != known
    # A wrong number: its sentence at its field; what is older is said to be, and stays.
    field.fill("-1")
    assert settled(page, MOVING) == "wrong"
    assert page.locator(".across.wrong").is_visible() and page.locator(".oldness").is_visible()
    assert rows(page, "spans"), "what was known has gone"
    field.fill("5")
    assert settled(page, MOVING) == "done" and page.locator(".across.wrong").count() == 0


def places(page: Page) -> None:
    """The place under the pointer is shown on both pictures; by keys too."""
    opened(page, "tool.toml")
    plane = page.locator(".plane svg")
    box = plane.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.62, box["y"] + 240)
    painted(page)
    assert page.locator(".plane .spot").count() == 1 and page.locator(".marks .spot").count() == 1
    assert page.locator(".readout").get_attribute("data-readout") in ("enters", "leaves")
    # On a fold of the curve.
    page.locator(".plane svg .fold").first.hover(force=True)
    painted(page)
    assert page.locator(".readout").get_attribute("data-readout") == "curve"
    plane.focus()
    told = page.locator(".readout").inner_text()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    painted(page)
    assert page.locator(".readout").inner_text() != told
    page.keyboard.press("Escape")
    # On the tool itself.
    page.locator('[data-view="front"]').click()
    page.locator(".stage canvas").hover()
    painted(page)
    assert page.locator(".readout").get_attribute("data-readout") != "", "nothing under the pointer in the middle of the tool"


def lists(page: Page, served: Served, program: str) -> None:
    """A list of questions; a motion that is a pose becomes a twist when it is dragged; that of a program stays."""
    opened(page, "motions.toml")
    beside = str(served.folder / FOLDER)
    text = (served.folder / FOLDER / "motions.toml").read_text()
    all_of = asked(program, "grazing", text, beside)
    for i, sheet in enumerate(all_of):
        page.locator(".head select").select_option(str(i))
        painted(page)
        agrees(page, sheet)
    heard = Heard(page, "grazing")
    page.locator('[data-view="top"]').click()
    drag(page, "top", 30, 10)
    made = heard.text()
    assert made.count("twist") == 4 and "pose =" not in made and "rate =" not in made, made
    assert made.split("[[grazing]]")[:4] == text.split("[[grazing]]")[:4], "another question was changed"
    agrees(page, asked(program, "grazing", made, beside)[3])
    heard.end()
    # The tool of a file is put into the text, and then has fields.
    page.locator("[data-put]").click()
    page.locator('[data-key="grazing[3].tool.shape.barrel.diameter"] input').fill("18")
    assert settled(page, MOVING) == "done"
    opened(page, "moment.toml")
    assert page.locator("[data-grip]").count() == 0 and page.locator(".motion fieldset[disabled]").count() == 4


def moved(page: Page, at: int) -> None:
    page.locator(".time input").fill(str(at))
    page.wait_for_function("at => document.documentElement.dataset.moment === at", arg=str(at), timeout=LONG)


def sweeps(page: Page, served: Served, program: str) -> None:
    """A move is scrubbed: the curve at each moment, what is swept in all and up to the moment."""
    opened(page, "envelope.toml")
    beside = str(served.folder / FOLDER)
    text = (served.folder / FOLDER / "envelope.toml").read_text()
    growth = asked(program, "envelope", text, beside, "--moments", "48")
    page.wait_for_function("() => document.documentElement.dataset.growth !== undefined", timeout=LONG)
    assert int(page.evaluate("() => document.documentElement.dataset.growth")) == growth["triangles"]
    tool = json.dumps({"shape": {"bull-nose": {"diameter": 20, "corner_radius": 5, "flute_length": 24}}, "shank_diameter": 16, "stickout": 42,
                       "holder": [{"height": 12, "lower_diameter": 34, "upper_diameter": 40}]})  # fmt: skip
    triangles = -1
    times = []
    for at in (0, 12, 24, 25, 36, 48):
        moved(page, at)
        times.append(page.evaluate("() => Number(document.documentElement.dataset.momentMs)"))
        moment = growth["moments"][at]
        assert int(page.locator(".tool canvas").get_attribute("data-triangles")) == moment["triangles"] > triangles
        triangles = moment["triangles"]
        # The curve of the plane is that of the tool under the motion at this moment.
        twist = {"velocity": moment["velocity"], "turn": moment["turn"]}
        sheet = asked(program, "grazing", json.dumps({"tool": json.loads(tool), "tolerance": growth["tolerance"], "twist": twist}), beside)
        shown = rows(page, "spans")
        assert len(shown) == len(sheet["spans"])
        assert all(abs(number(r[5]) - s["lengths"][0]) < 2e-6 for r, s in zip(shown, sheet["spans"])), (shown, sheet["spans"])
    print(f"  from the slider to the curve: {median(times):.0f} ms in the middle", flush=True)
    volume = lambda name: page.locator(f'[data-fact="{name}"] dd').first.evaluate("d => d.firstChild.textContent")
    page.wait_for_function("() => /cm³/.test(document.querySelector('[data-fact=\"whole\"] dd').textContent)", timeout=LONG)
    whole = asked(program, "envelope", text, beside)
    assert abs(number(volume("whole")) - whole["mesh"]["volume"] / 1000) < 5.1e-4, (volume("whole"), whole["mesh"])
    assert volume("now") == volume("whole")
    moved(page, 24)
    page.wait_for_function("() => /cm³/.test(document.querySelector('[data-fact=\"now\"] dd').textContent)", timeout=LONG)
    half = asked(program, "envelope", f"until = 0.5\n{text}", beside)
    assert abs(number(volume("now")) - half["mesh"]["volume"] / 1000) < 5.1e-4, (volume("now"), half["mesh"])
    shot(page, "envelope-half")
    # Play goes to the end by itself.
    moved(page, 40)
    page.locator("[data-play]").click()
    page.wait_for_function("() => document.querySelector('.time input').value === '48'", timeout=LONG)
    page.wait_for_function("() => document.querySelector('[data-play]').dataset.play === 'off'")
    # A number of the move, and a wrong one.
    page.locator('[data-key="move.to"] input').first.fill("40")
    assert settled(page, MOVING) == "done"
    assert abs(number(page.locator('[data-fact="way"] dd').first.evaluate("d => d.firstChild.textContent")) - math.hypot(40, 10, 8)) < 6e-4
    page.locator('[data-key="tool.shape.bull-nose.diameter"] input').fill("0")
    assert settled(page, MOVING) == "wrong" and page.locator(".across.wrong").is_visible()
    page.locator('[data-key="tool.shape.bull-nose.diameter"] input').fill("20")
    assert settled(page, MOVING) == "done"


def moves(page: Page) -> None:
    """Each class of moves has its growth."""
    opened(page, "envelopes.toml")
    moved(page, 20)
    for i in range(page.locator(".head select option").count()):
        if i > 0:
            with page.expect_response("**/api/verb/grazing", timeout=LONG):
                page.locator(".head select").select_option(str(i))
        painted(page)
        assert page.locator(".across").count() == 0, (i, page.locator(".across").all_inner_texts())
        page.locator('[data-table="spans"] tbody tr').nth(2).wait_for(timeout=LONG)
        assert int(page.locator(".tool canvas").get_attribute("data-triangles")) > 0, i


def begun(page: Page) -> None:
    """New questions by the command, saved as files."""
    for name, wanted in (("grazing", "Bull-nose end mill in motion"), ("envelope", "Bull-nose end mill, leaning over along a line")):
        page.locator('[data-open="new"]').click()
        page.locator(f'[data-new="{name}"]').click()
        assert settled(page, MOVING) == "done"
        assert page.locator("h1").inner_text() == wanted
        page.keyboard.press("Control+s")
        page.wait_for_function("() => document.querySelector('.tab.on .dot') === null", timeout=LONG)
        assert settled(page, MOVING) == "done"


def looks(browser: Browser, served: Served) -> None:
    """Both themes, three widths: no violation, no sideways scroll."""
    for theme in ("light", "dark"):
        for size in SIZES:
            one, page = visited(browser, size, theme, served.address)
            page.locator('[data-open="files"]').wait_for()
            for name in ("tool.toml", "envelope.toml"):
                opened(page, name)
                if name == "envelope.toml":
                    page.wait_for_function("() => document.documentElement.dataset.growth !== undefined && document.documentElement.dataset.moment !== undefined", timeout=LONG)
                painted(page)
                wide = page.evaluate("() => document.documentElement.scrollWidth - innerWidth")
                assert wide <= 0, (name, size, wide)
                clean(page, f"{name} {theme} {size[0]}")
                shot(page, f"{name.split('.')[0]}-{theme}-{size[0]}")
            one.close(served.address)


def pseudo(browser: Browser, served: Served) -> None:
    """No text outside the catalogue."""
    one, page = visited(browser, SIZES[0], "light", served.at("lang=pseudo"))
    found = []
    for name in ("tool.toml", "motions.toml", "moment.toml", "envelope.toml"):
        page.locator('[data-open="files"]').click()
        page.get_by_role("menuitem", name=f"{FOLDER}/{name}", exact=True).click()
        page.locator(f'.tab.on button[title="{FOLDER}/{name}"]').wait_for()
        settled(page, MOVING)
        page.locator("details").evaluate_all("all => all.forEach(d => (d.open = true))")
        drawn(page)
        found += page.evaluate(UNMARKED, MARK)
    assert not found, sorted(set(found))
    one.close(served.address)


SCRIPT = Script(
    "the windows of a moving tool",
    (FOLDER,),
    {
        "numbers": lambda s: numbers(s.page, s.served, s.program),
        "hands": lambda s: (opened(s.page, "tool.toml"), hands(s.page, s.served, s.program)),
        "outcomes": lambda s: outcomes(s.page, s.served, s.program),
        "radius": lambda s: radius(s.page, s.served),
        "places": lambda s: places(s.page),
        "lists": lambda s: lists(s.page, s.served, s.program),
        "sweeps": lambda s: sweeps(s.page, s.served, s.program),
        "moves": lambda s: moves(s.page),
        "begun": lambda s: begun(s.page),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    lambda s: s.watched.opened(s.served.address),
    always=("closes",),
)

if __name__ == "__main__":
    SCRIPT.main()
