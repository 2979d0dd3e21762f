"""The window of face milling in a browser, as a person uses it: python3 face.py KINECUT [STEP ...]. Its numbers are held against those that the
program itself prints with `kinecut face --json`. Needs and settings: common.py."""

import re

from common import EXAMPLES, LONG, MARK, SIZES, UNMARKED, WEEKLY, Script, Served, Stage, Watched, clean, kept_back, shares, shell, shot, still
from playwright.sync_api import Browser, Page

COVER = "04_gear_pump_cover/face.toml"
# Moves of the part whose times are measured, and the bound for nineteen of twenty answers under the pointer [ms].
MOVES = 60
ANSWERED = 50


class Verb:
    """The program at the shell."""

    def __init__(self, program: str):
        self.program = program
        self.text = (EXAMPLES / COVER).read_text()

    def face(self, *flags: str, **keys: str) -> dict:
        """What it prints of the cover; `keys` are added to the operation, as TOML."""
        text = self.text + "".join(f"{key} = {value}\n" for key, value in keys.items())
        return self.of(text, *flags)

    def of(self, text: str, *flags: str) -> dict:
        return shell(self.program, "face", "-", *flags, text=text, folder=EXAMPLES / "04_gear_pump_cover")


def opened(watched: Watched, served: Served, query: str = "") -> Page:
    page = watched.opened(served.at(query) if query else served.address)
    page.locator('[data-open="facing"]').click()
    return page


def fact(page: Page, name: str) -> str:
    return page.locator(f'[data-fact="{name}"] dd').inner_text()


def drawn(page: Page) -> int:
    return int(page.evaluate("() => document.documentElement.dataset.face ?? '0'"))


def settled(page: Page, after: int) -> None:
    """Waits until the exits of the newest placement are on the screen."""
    page.wait_for_function(f"() => Number(document.documentElement.dataset.face ?? 0) > {after}", timeout=LONG)
    page.locator('[data-fact="hand"]:not([data-late])').wait_for(timeout=LONG)
    still(page)


def number(page: Page, name: str):
    return page.locator(f'[data-face="{name}"] input')


def put(page: Page, **values: str) -> None:
    for name, value in values.items():
        before = drawn(page)
        if number(page, name).input_value() == value:
            continue
        number(page, name).fill(value)
        settled(page, before)


def cover(page: Page) -> None:
    page.get_by_role("button", name=COVER, exact=True).click()
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)
    still(page)


def compared(page: Page) -> None:
    page.locator(".graph .cell").first.wait_for(timeout=LONG)
    page.locator(".method").wait_for(timeout=LONG)
    still(page)


def printed(told: dict, way: str = "bad") -> float:
    return told["ways"][told["chosen"]][way]


def reads(page: Page, verb: Verb) -> None:
    """The example is opened by clicking, and its printed numbers are read back."""
    clean(page, "start")
    shot(page, "face-start")
    cover(page)
    told = verb.face()
    assert f"{told['optimum']['value']:.3f} mm" == "117.690 mm" and fact(page, "least").startswith("117.690 mm"), fact(page, "least")
    turn, value = re.search(r"turn ([\d.]+)°, offset (\S+) mm", fact(page, "least")).groups()
    assert abs(float(turn) - told["optimum"]["placement"]["turn"]) < 0.006 and value == "0.52", fact(page, "least")
    assert fact(page, "drawn").startswith("180.8 mm"), fact(page, "drawn")
    assert "8 loops, 638.2 mm" in page.locator(".head").inner_text()
    certificate = page.locator(".cert").inner_text()
    assert "proven least" in certificate and f"{told['optimum']['lower_bound']:.4f} mm" in certificate, certificate
    assert "115.2 mm of it no straight pass avoids" in certificate, certificate
    # As drawn, to begin with.
    assert number(page, "turn").input_value() == "0" and fact(page, "hand").startswith("180.8 mm bad"), fact(page, "hand")
    assert page.title() == f"Facing {COVER}"


def drags(page: Page) -> None:
    """The ring turns the part, anything else shifts it; the exits follow, and their numbers are the verb's."""
    held = page.locator(".held")
    held.scroll_into_view_if_needed()
    box = held.bounding_box()
    grip, pivot = (page.locator(".held .grip").nth(i).evaluate("e => [e.cx.baseVal.value, e.cy.baseVal.value]") for i in (0, 1))
    before = drawn(page)
    page.mouse.move(box["x"] + grip[0], box["y"] + grip[1])
    page.mouse.down()
    for dy in range(4, 44, 4):
        page.mouse.move(box["x"] + grip[0] - 5, box["y"] + grip[1] + dy)
    page.mouse.up()
    settled(page, before)
    turn = float(number(page, "turn").input_value())
    assert 330 < turn < 358, turn
    before = drawn(page)
    start = (box["x"] + pivot[0] + 30, box["y"] + pivot[1] + 40)
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 30, start[1] + 5)
    page.mouse.move(start[0] + 30, start[1] + 8)
    page.mouse.up()
    settled(page, before)
    offset = float(number(page, "offset").input_value())
    assert 0.5 < offset < 4, offset
    put(page, turn="337", offset="2.4")
    # The same at the shell: the middle of the width is that of the least offset and the greatest.
    assert fact(page, "hand").startswith("136.8 mm bad") and "of 289.0 mm of tooth exits" in fact(page, "hand"), fact(page, "hand")
    assert fact(page, "pass").startswith("19.4 s") and "796 rev/min, 669 mm/min" in fact(page, "pass"), fact(page, "pass")
    red = page.locator(".exits .ex-bad")
    # The red strokes are as long as the number says, at the scale of the drawing.
    scale = page.locator(".held .cutter > circle").first.evaluate("e => e.r.baseVal.value") / 50
    assert abs(red.evaluate("e => e.getTotalLength()") / scale - 136.8) < 0.3, red.evaluate("e => e.getTotalLength()") / scale
    # So are the rows of the table.
    page.locator(".numbers summary").click()
    told = [float(n) for n in page.locator(".numbers tbody td:nth-child(3)").all_inner_texts()]
    assert abs(sum(told) - 136.8) < 0.06, sum(told)
    shot(page, "face-drag")
    clean(page, "dragged")
    page.locator(".numbers summary").click()


def arrows(page: Page) -> None:
    """All of it by the keyboard."""
    put(page, turn="10", offset="1")
    held = page.locator(".held")
    held.focus()
    for key, name, value in (("ArrowLeft", "turn", "11"), ("Shift+ArrowRight", "turn", "1"), ("Alt+ArrowLeft", "turn", "1.1"), ("ArrowDown", "offset", "1.1"), ("Shift+ArrowUp", "offset", "0.1")):
        before = drawn(page)
        held.press(key)
        settled(page, before)
        assert number(page, name).input_value() == value, (key, number(page, name).input_value())
    assert re.search(r"[\d.]+ mm of edge with bad exits at turn 1\.1°, offset 0\.10 mm", page.locator("#face-live").inner_text())


def where(page: Page) -> tuple[str, str]:
    return number(page, "turn").input_value(), number(page, "offset").input_value()


def stroke(page: Page, start: tuple[float, float], by: tuple[float, float], button: str = "left") -> None:
    """Draws the pointer over the drawing: from a point of it, by pixels."""
    box = page.locator(".held").bounding_box()
    x, y = box["x"] + start[0], box["y"] + start[1]
    page.mouse.move(x, y)
    page.mouse.down(button=button)
    page.mouse.move(x + by[0] / 2, y + by[1] / 2)
    page.mouse.move(x + by[0], y + by[1])
    page.mouse.up(button=button)


def undoes(page: Page) -> None:
    """Placements and weights are taken back and done again, by keys and by buttons; a drag is one change; a field that is typed into follows."""
    page.locator('[data-do="fit"]').click()
    put(page, turn="10", offset="1")
    pivot = page.locator(".held .grip").nth(1).evaluate("e => [e.cx.baseVal.value, e.cy.baseVal.value]")
    before = drawn(page)
    stroke(page, (pivot[0] + 30, pivot[1] + 40), (0, 20))
    settled(page, before)
    dragged = where(page)
    assert dragged[0] == "10" and float(dragged[1]) > 1.5, dragged
    before = drawn(page)
    page.get_by_role("button", name="Go to the least").click()
    settled(page, before)
    least = where(page)
    before = drawn(page)
    number(page, "weight-BOLTS").fill("0")
    settled(page, before)
    for key, expected, weight in (("Control+z", least, ""), ("Control+z", dragged, ""), ("Control+z", ("10", "1"), ""), ("Control+Shift+z", dragged, ""), ("Control+y", least, ""), ("Control+y", least, "0")):
        page.keyboard.press(key)
        page.wait_for_function("want => document.querySelector('[data-face=turn] input').value === want[0] && document.querySelector('[data-face=offset] input').value === want[1]", arg=list(expected), timeout=LONG)
        assert number(page, "weight-BOLTS").input_value() == weight, (key, weight, number(page, "weight-BOLTS").input_value())
    # Nothing comes behind the last state, and the button that says so keeps the focus.
    on, back = page.get_by_role("button", name="Redo"), page.get_by_role("button", name="Undo")
    assert on.get_attribute("aria-disabled") == "true" and back.get_attribute("aria-disabled") is None
    back.click()
    assert on.get_attribute("aria-disabled") is None and number(page, "weight-BOLTS").input_value() == ""
    on.click()
    assert number(page, "weight-BOLTS").input_value() == "0" and on.evaluate("e => e === document.activeElement")
    # A change after an undo takes the place of what came behind.
    back.click()
    held = page.locator(".held")
    held.focus()
    before = drawn(page)
    held.press("ArrowLeft")
    settled(page, before)
    assert on.get_attribute("aria-disabled") == "true"
    clean(page, "undone")


# Where the part is drawn: the pivot and the radius of the cutter on the screen.
SEEN = "() => { const p = document.querySelectorAll('.held .grip')[1], c = document.querySelector('.held .cutter > circle'); return [p.cx.baseVal.value, p.cy.baseVal.value, c.r.baseVal.value]; }"


def views(page: Page) -> None:
    """The drawing is enlarged about the pointer and shifted, by wheel, buttons, keys, middle button, blank key and two fingers; no placement changes."""
    put(page, turn="10", offset="1")
    held = page.locator(".held")
    held.scroll_into_view_if_needed()
    box = held.bounding_box()
    count, whole = drawn(page), page.evaluate(SEEN)

    def seen(want, what: str) -> list[float]:
        """What is seen, once a condition of it holds."""
        page.wait_for_function(f"() => {{ const [x, y, r] = ({SEEN})(); return {want}; }}", timeout=LONG)
        now = page.evaluate(SEEN)
        assert (where(page), drawn(page)) == (("10", "1"), count), (what, where(page), drawn(page), count)
        return now

    at = (120, 90)
    page.mouse.move(box["x"] + at[0], box["y"] + at[1])
    page.mouse.wheel(0, -400)
    x, y, r = seen(f"r > {whole[2] * 1.5}", "wheel")
    by = r / whole[2]
    assert abs(x - (at[0] + (whole[0] - at[0]) * by)) < 1 and abs(y - (at[1] + (whole[1] - at[1]) * by)) < 1, (x, y, by, whole)
    # The ring stays within reach.
    ring = page.locator(".held .grip").first.evaluate("e => [e.cx.baseVal.value, e.cy.baseVal.value]")
    assert 0 < ring[0] < box["width"] and 0 < ring[1] < box["height"], ring
    stroke(page, (200, 150), (40, 24), "middle")
    x2, y2, _ = seen(f"Math.abs(x - {x + 40}) < 0.6 && Math.abs(y - {y + 24}) < 0.6", "middle button")
    page.keyboard.down("Space")
    stroke(page, (200, 150), (-30, 10))
    page.keyboard.up("Space")
    seen(f"Math.abs(x - {x2 - 30}) < 0.6 && Math.abs(y - {y2 + 10}) < 0.6", "blank key")
    shot(page, "face-zoomed")
    held.focus()
    x, _, r = page.evaluate(SEEN)
    held.press("Control+ArrowRight")
    seen(f"x < {x - 20}", "keys shift")
    held.press("+")
    seen(f"r > {r * 1.2}", "plus")
    held.press("-")
    held.press("-")
    seen(f"r < {r * 0.9}", "minus")
    held.press("0")
    seen(f"Math.abs(r - {whole[2]}) < 0.01 && Math.abs(x - {whole[0]}) < 0.5", "zero")
    page.get_by_role("button", name="Zoom in").click()
    seen(f"r > {whole[2] * 1.2}", "button")
    page.get_by_role("button", name="Zoom out").click()
    page.get_by_role("button", name="Zoom out").click()
    seen(f"r < {whole[2] * 0.9}", "button")
    page.locator('[data-do="fit"]').click()
    seen(f"Math.abs(r - {whole[2]}) < 0.01", "fit")
    pinch(page, box)
    page.wait_for_function(f"() => Math.abs(({SEEN})()[2] - {whole[2] * 2}) < 1", timeout=LONG)
    assert where(page) == ("10", "1"), where(page)
    page.locator('[data-do="fit"]').click()
    page.wait_for_function(f"() => Math.abs(({SEEN})()[2] - {whole[2]}) < 0.01", timeout=LONG)
    clean(page, "view")


def pinch(page: Page, box: dict) -> None:
    """Two fingers draw apart to twice their distance; the first was on the part alone for a moment, and moved it."""
    session = page.context.new_cdp_session(page)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def touch(kind: str, *points: tuple[float, float]) -> None:
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": a, "y": b, "id": i} for i, (a, b) in enumerate(points)]})

    session.send("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
    touch("touchStart", (x - 40, y))
    touch("touchMove", (x - 50, y))
    touch("touchStart", (x - 50, y), (x + 50, y))
    for d in (60, 80, 100):
        touch("touchMove", (x - d, y), (x + d, y))
    touch("touchEnd")
    session.send("Emulation.setTouchEmulationEnabled", {"enabled": False})
    session.detach()


def times(page: Page) -> tuple[list[float], list[float]]:
    """From a move of the part to its exits on the screen, and what of that is question and answer [ms]."""
    all_of_it, answers = [], []
    page.locator(".held").focus()
    put(page, turn="0", offset="0")
    page.locator(".held").focus()
    for i in range(MOVES):
        before = drawn(page)
        page.keyboard.press("ArrowLeft" if i % 4 else "ArrowDown")
        settled(page, before)
        data = page.evaluate("() => ({ ...document.documentElement.dataset })")
        all_of_it.append(float(data["faceMs"]))
        answers.append(float(data["faceAsked"]))
    return sorted(all_of_it), sorted(answers)


def late(page: Page) -> None:
    """An answer that does not come: what is shown says that it is older, and of where."""
    put(page, turn="0", offset="0")
    with kept_back(page, "**/api/verb/face"):
        page.locator(".held").focus()
        page.keyboard.press("Shift+ArrowLeft")
        page.locator('[data-fact="hand"][data-late]').wait_for()
        assert "older" in page.locator('[data-fact="hand"]').inner_text() and "turn 0.00°" in fact(page, "hand"), fact(page, "hand")
        assert page.locator(".exits.aged").count() == 1
    page.locator('[data-fact="hand"]:not([data-late])').wait_for(timeout=LONG)
    still(page)
    assert page.locator(".exits.aged").count() == 0 and "of tooth exits" in fact(page, "hand")


# The step of the scale that is drawn at places of the graph: turns [deg] and offsets beside the middle [mm].
DRAWN = """(places) => {
  const svg = document.querySelector('.graph svg');
  const frame = svg.querySelector('.frame');
  const at = (name) => Number(frame.getAttribute(name));
  const axis = [...svg.querySelectorAll('g[translate="no"] text')].map((t) => [t.textContent.replace('\u2212', '-'), t]);
  const begin = parseFloat(axis.find(([text]) => text.endsWith('°'))[0]);
  const sides = axis.filter(([, t]) => t.getAttribute('text-anchor') === 'end').map(([text, t]) => [Number(text), Number(t.getAttribute('y')) - 4]);
  const [low, high] = [sides.reduce((a, b) => (b[0] < a[0] ? b : a)), sides.reduce((a, b) => (b[0] > a[0] ? b : a))];
  return places.map(([turn, beside]) => {
    const p = svg.createSVGPoint();
    p.x = at('x') + ((((turn - begin) % 360) + 360) % 360) / 360 * at('width');
    p.y = low[1] + ((beside - low[0]) / (high[0] - low[0])) * (high[1] - low[1]);
    const cell = [...svg.querySelectorAll('.cell')].find((c) => c.isPointInFill(p));
    return cell ? Number(/--scale(\\d+)/.exec(cell.getAttribute('style'))[1]) : null;
  });
}"""


def graph(page: Page, verb: Verb) -> None:
    """The cells are the verb's numbers; under the pointer is its number of that placement; a click goes there."""
    compared(page)
    told = verb.face("--map")["map"]
    known = [v for column in told["values"] if column for v in column if v is not None]
    least, most = min(known), max(known)
    places, wanted = [], []
    for i in range(0, len(told["turns"]), 3):
        # Inside the cells, not at the middle of a row: there the next one begins half a row away.
        for j in range(2, told["rows"] - 2, 6):
            if not told["values"][i]:
                places.append([told["turns"][i], 0.0])
                wanted.append(None)
                continue
            low, high = told["beside"][i]
            if high - low < 1:
                continue
            places.append([told["turns"][i] + 0.2, low + j / (told["rows"] - 1) * (high - low)])
            v = told["values"][i][j]
            wanted.append(None if v is None else min(15, int(16 * (v - least) / (most - least))))
    shown = page.evaluate(DRAWN, places)
    off = [(p, s, w) for p, s, w in zip(places, shown, wanted) if s != w]
    assert len({w for w in wanted}) > 6 and len(off) <= 0.02 * len(places), off
    svg = page.locator(".graph svg")
    svg.scroll_into_view_if_needed()
    box = svg.bounding_box()
    star = page.locator(".graph .star").bounding_box()
    page.mouse.move(star["x"] + star["width"] / 2 + 6, star["y"] + star["height"] / 2)
    page.locator('.graph .told[data-known="yes"]').wait_for(timeout=LONG)
    where, what = page.locator(".graph .told text").all_text_contents()
    turn, mm = (float(n.replace("−", "-")) for n in re.search(r"turn ([\d.]+)°, offset (\S+) mm", where).groups())
    before = drawn(page)
    page.mouse.click(star["x"] + star["width"] / 2 + 6, star["y"] + star["height"] / 2)
    settled(page, before)
    gone = (float(number(page, "turn").input_value()), float(number(page, "offset").input_value()))
    assert gone == (turn, mm), (gone, turn, mm)
    assert fact(page, "hand").startswith(what), (what, fact(page, "hand"))
    assert 117.6 < float(what.split()[0]) < 140, what
    # A placement that is not possible says so.
    page.mouse.move(box["x"] + box["width"] * 0.48, box["y"] + 60)
    page.wait_for_function("() => document.querySelector('.graph .told text.b')?.textContent === 'not possible'", timeout=LONG)
    page.mouse.move(box["x"] + 2, box["y"] - 30)
    shot(page, "face-graph")


def finds(page: Page, verb: Verb) -> None:
    """The certificate comes sector by sector, can be stopped, and at its end is that of the whole."""
    told = verb.face()["optimum"]
    page.get_by_role("button", name="Find the least").click()
    page.locator('[data-sectors="searches"], [data-sectors="ended"]').wait_for(timeout=LONG)
    page.locator('[data-sectors="ended"]').wait_for(timeout=LONG)
    best, bound = (float(n) for n in re.search(r"leaves ([\d.]+) mm, and none leaves less than ([\d.]+) mm", page.locator("[data-sectors]").inner_text()).groups())
    assert abs(best - told["value"]) < 2e-4 and abs(bound - told["lower_bound"]) < 2e-3, (best, bound, told)
    assert page.locator(".sectors .value").count() >= 4 and page.locator('.sectors rect[fill^="url"]').count() >= 4
    shot(page, "face-certificate")
    # Stopped half-way, nothing is claimed of the rest.
    with kept_back(page, "**/api/verb/face", "face-sector", but=9):
        page.get_by_role("button", name="Find the least").click()
        page.wait_for_function("() => document.querySelectorAll('.sectors .value').length > 0", timeout=LONG)
        page.locator('[data-sectors="searches"]').wait_for(timeout=LONG)
        page.locator(".cert").get_by_role("button", name="Stop").click()
        page.get_by_role("button", name="Find the least").wait_for()
    assert page.locator('[data-sectors="ended"]').count() == 0
    # Of the whole turn the proof is there all the same.
    assert "nothing is proven" not in page.locator(".cert").inner_text() and page.locator(".cert .tag.safe").count() == 1
    before = drawn(page)
    page.get_by_role("button", name="Go to the least").click()
    settled(page, before)
    assert fact(page, "hand").startswith("117.7 mm bad"), fact(page, "hand")


def mistakes(page: Page, verb: Verb) -> None:
    """A wrong number is told at its field, by the verb's sentence; a placement beyond the margin says so."""
    number(page, "depth").fill("-1")
    still(page)
    page.locator('[data-face="depth"].wrong .told').wait_for(timeout=LONG)
    sentence = verb.of(verb.text.replace("depth = 0.5", "depth = -1"))["message"]
    assert page.locator('[data-face="depth"] .told').inner_text() == sentence
    # The last exits are shown as older ones, and nothing is proven.
    assert page.locator(".exits.aged").count() == 1 and page.locator('[data-fact="hand"][data-late]').count() == 1
    assert page.locator(".cert .tag.safe").count() == 0
    clean(page, "mistake")
    number(page, "depth").fill("0.5")
    still(page)
    page.locator('[data-fact="hand"]:not([data-late])').wait_for(timeout=LONG)
    put(page, turn="0", offset="9.5")
    assert "beyond the margin of 1.00 mm" in fact(page, "hand"), fact(page, "hand")
    put(page, turn="0", offset="9")
    assert "beyond" not in fact(page, "hand"), fact(page, "hand")


def ways(page: Page, verb: Verb) -> None:
    """Ways with their prices, those of `--compare`; a straight one is gone to."""
    told = verb.face("--compare")
    shown = page.locator("section[aria-label='Placements worth a look'] tbody tr")
    for all_of_them in (False, True):
        rows = [row.locator("td.n").all_inner_texts() for row in shown.all()]
        wanted = [[f"{w['bad']:.1f}", f"{w['time']:.1f}", f"{w['feed_length']:.1f}"] for w in told["ways"] if all_of_them or w["unbeaten"]]
        assert rows == wanted, (rows, wanted)
        if not all_of_them:
            page.get_by_role("button", name=f"Show all {len(told['ways'])}").click()
    go = shown.locator("button").first
    before = drawn(page)
    put(page, turn="5", offset="0")
    before = drawn(page)
    bad = go.locator("xpath=ancestor::tr").locator("td.n").first.inner_text()
    go.click()
    settled(page, before)
    assert fact(page, "hand").startswith(f"{bad} mm bad"), (bad, fact(page, "hand"))


def paper(page: Page, verb: Verb) -> None:
    """The paper's method: where it ends from many starts, and its way from one; from the part as drawn it ends as the verb's own run."""
    told = verb.face("--paper")["paper"]
    words = page.locator(".method").inner_text()
    assert f"best {told['statistics']['best']:.3f} mm" in words and f"worst {told['statistics']['worst']:.1f} mm" in words, words
    page.locator("[data-paper]").check()
    assert page.locator(".graph .paper .end").count() > 50
    put(page, turn="0", offset="0")
    # The paper's figure 5, read at this turn.
    first = told["survey"][0]
    assert first["covered"] and page.locator(".survey text.b").text_content() == f"{first['largest_exit_angle']:.1f}°", first
    page.get_by_role("button", name="Walk from here").click()
    page.locator('[data-walk="ended"]').wait_for(timeout=LONG)
    words = page.locator("[data-walk]").inner_text()
    own = told["descent_from_as_drawn"]
    value, count = re.search(r"ended at ([\d.]+) mm after (\d+) evaluations", words).groups()
    assert value == f"{own['value']:.3f}" and int(count) == own["evaluations"], (words, own)
    assert int(page.locator(".graph .walk").get_attribute("data-steps")) > 5
    shot(page, "face-walk")
    # From another placement, at once after it is put there: all turns that the text allows are open to it.
    held = page.locator(".held")
    held.focus()
    for key in ("Shift+ArrowLeft", "Shift+ArrowDown"):
        held.press(key)
    with page.expect_request(lambda r: r.url.endswith("/api/verb/face") and (r.post_data_json or {}).get("walk")) as asked:
        page.get_by_role("button", name="Walk from here").click()
    page.wait_for_function("() => document.querySelector('[data-walk]')?.textContent.startsWith('From turn 10.0°, offset 1.00 mm')", timeout=LONG)
    page.locator('[data-walk="ended"]').wait_for(timeout=LONG)
    value, count = re.search(r"ended at ([\d.]+) mm after (\d+) evaluations", page.locator("[data-walk]").inner_text()).groups()
    walk = verb.of(asked.value.post_data_json["text"], "--walk")["walk"]
    # Without an offset the verb puts the cutter over the middle of the turned part.
    over = verb.face("--walk", placement="{ angle = 10.0 }", passes='"one"')["walk"]["start"]
    assert walk["start"]["turn"] == 10 and abs(walk["start"]["offset"] - over["offset"] - 1) < 1e-6, (walk["start"], over)
    assert value == f"{walk['value']:.3f}" and int(count) == walk["evaluations"], (value, count, walk["value"], walk["evaluations"])
    assert abs(walk["end"]["turn"] - 10) > 1, walk["end"]
    page.locator("[data-paper]").uncheck()


def weights(page: Page, verb: Verb, served: Served) -> None:
    """An edge is clicked, its name weighted: the least placement is another one; used and saved it is in the file."""
    path = served.folder / COVER
    original = path.read_text()
    put(page, turn="0", offset="0")
    page.locator(".facing h1").scroll_into_view_if_needed()
    box = page.locator(".held").bounding_box()
    # On a bolt hole: the shortest of the strokes begin on those.
    spot = page.evaluate(
        """() => {
          const path = document.querySelector('.exits .ex-bad');
          const ends = path.getAttribute('d').split('M').slice(1).map(d => d.split(/[ALZ]/)[0].trim().split(' ').map(Number));
          return ends;
        }"""
    )
    chosen = set()
    for x, y in spot:
        page.mouse.click(box["x"] + x, box["y"] + y)
        chosen |= set(page.locator('.weights tr[aria-selected="true"]').evaluate_all("all => all.map(r => r.dataset.label)"))
    assert {"BOLTS"} <= chosen and chosen <= {"BOLTS", "GEAR_BORES", "OUTSIDE"}, chosen
    before = drawn(page)
    number(page, "weight-BOLTS").fill("0")
    settled(page, before)
    told = verb.face(weights="{ BOLTS = 0 }")
    page.wait_for_function("want => document.querySelector('[data-fact=least] b')?.textContent === want", arg=f"{told['optimum']['value']:.3f} mm", timeout=LONG)
    assert page.locator(".key").inner_text().count("bad exit of weight 0") == 1 and page.locator(".exits .ex-off").count() == 1
    assert path.read_text() == original, "nothing is saved before it is asked for"
    before = drawn(page)
    page.get_by_role("button", name="Go to the least").click()
    settled(page, before)
    page.get_by_role("button", name="Use this placement").click()
    page.locator(".tab.on .dot").wait_for()
    page.keyboard.press("Control+s")
    page.locator(".tab.on .dot").wait_for(state="detached")
    saved = path.read_text()
    assert "weights = { BOLTS = 0 }" in saved and re.search(r"placement = \{ angle = [\d.]+, offset = [-\d.]+ \}", saved), saved
    assert abs(printed(verb.of(saved)) - told["optimum"]["value"]) < 1e-3
    shot(page, "face-weights")
    clean(page, "weights")
    path.write_text(original)


def drops(page: Page, served: Served) -> None:
    """A drawing is dropped on the window: it is asked about at once, and saved with its question when one wants."""
    text = (EXAMPLES / "04_gear_pump_cover/cover.dxf").read_text()
    transfer = page.evaluate_handle("text => { const d = new DataTransfer(); d.items.add(new File([text], 'dropped.dxf')); return d; }", text)
    page.dispatch_event("main", "drop", {"dataTransfer": transfer})
    page.wait_for_function("() => document.title === 'Facing dropped-face.toml'", timeout=LONG)
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)
    assert fact(page, "least").startswith("117.690 mm"), fact(page, "least")
    assert (served.folder / "dropped.dxf").read_text() == text and not (served.folder / "dropped-face.toml").exists()
    page.keyboard.press("Control+s")
    page.locator(".tab.on .dot").wait_for(state="detached")
    assert 'outline = "dropped.dxf"' in (served.folder / "dropped-face.toml").read_text()
    # A cutter that is too small for one pass: no placement, and that is said; nothing is green.
    number(page, "diameter").fill("60")
    page.wait_for_function("() => document.querySelector('[data-fact=hand] b')?.textContent === 'Not possible here'", timeout=LONG)
    page.wait_for_function("() => document.querySelector('[data-fact=least] b')?.textContent === 'none in one pass'", timeout=LONG)
    assert page.locator(".exits").count() == 0 and page.locator(".ex-unknown").count() == 1 and page.locator(".cert .tag.safe").count() == 0
    shot(page, "face-too-wide")
    clean(page, "too wide")
    number(page, "diameter").fill("100")
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)


def looks(browser: Browser, served: Served) -> None:
    for theme in ("light", "dark"):
        for width, height in SIZES:
            watched = Watched(browser, (width, height), theme)
            page = opened(watched, served)
            cover(page)
            compared(page)
            put(page, turn="337", offset="2.4")
            shot(page, f"face-{theme}-{width}")
            clean(page, f"{theme} {width}")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways"
            small = page.locator(".facing svg text").evaluate_all("all => all.filter(e => parseFloat(getComputedStyle(e).fontSize) < 10).length")
            assert small == 0
            watched.close(served.address)


def changes(page: Page, served: Served) -> None:
    """Another program changes the drawing: what is shown is of the new one."""
    cover_file = served.folder / "dropped.dxf"
    text = cover_file.read_text()
    other = text.replace("BOLTS", "SCREWS")
    # The server looks at the folder from time to time: a file is another one only where it has been seen before. A new one is told.
    with page.expect_request("**/api/project", timeout=LONG):
        (served.folder / "seen.toml").write_text("# seen\n")
    cover_file.write_text(other)
    page.locator('.weights tr[data-label="SCREWS"]').wait_for(timeout=LONG)
    still(page)
    assert page.locator('.weights tr[data-label="BOLTS"]').count() == 0
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)


def pseudo(browser: Browser, served: Served) -> None:
    watched = Watched(browser, (1400, 900), "light")
    page = opened(watched, served, "lang=pseudo")
    page.locator(".files button").first.wait_for(timeout=LONG)
    found = page.evaluate(UNMARKED, MARK)
    page.locator(".files button", has_text=COVER).click()
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)
    compared(page)
    page.locator("[data-find]").click()
    page.locator('[data-sectors="ended"]').wait_for(timeout=LONG)
    page.locator(".numbers summary").click()
    page.locator("[data-paper]").check()
    page.locator(".method header button").click()
    page.locator('[data-walk="ended"]').wait_for(timeout=LONG)
    page.locator(".graph svg").scroll_into_view_if_needed()
    box = page.locator(".graph svg").bounding_box()
    page.mouse.move(box["x"] + 140, box["y"] + 80)
    page.locator('.graph .told[data-known="yes"]').wait_for(timeout=LONG)
    found += page.evaluate(UNMARKED, MARK)
    shot(page, "face-pseudo")
    assert not found, sorted(set(found))
    assert MARK in page.locator(".facing .head .acts").inner_text()
    watched.close(served.address)


def measured(stage: Stage) -> None:
    taken = times(stage.page)
    for what, all_of_it in zip(("from a move to its exits on the screen", "question and answer"), taken):
        print(f"  {what}: {shares(all_of_it)}")
    assert not WEEKLY or taken[1][int(0.95 * MOVES)] <= ANSWERED, taken[1]


SCRIPT = Script(
    "the window of face milling",
    ("04_gear_pump_cover",),
    {
        "reads": lambda s: reads(s.page, Verb(s.program)),
        "drags": lambda s: drags(s.page),
        "arrows": lambda s: arrows(s.page),
        "undoes": lambda s: undoes(s.page),
        "views": lambda s: views(s.page),
        "times": measured,
        "late": lambda s: late(s.page),
        "graph": lambda s: graph(s.page, Verb(s.program)),
        "finds": lambda s: finds(s.page, Verb(s.program)),
        "mistakes": lambda s: mistakes(s.page, Verb(s.program)),
        "ways": lambda s: ways(s.page, Verb(s.program)),
        "paper": lambda s: paper(s.page, Verb(s.program)),
        "weights": lambda s: weights(s.page, Verb(s.program), s.served),
        "drops": lambda s: drops(s.page, s.served),
        "changes": lambda s: changes(s.page, s.served),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    lambda s: opened(s.watched, s.served),
    always=("reads", "closes"),
)

if __name__ == "__main__":
    SCRIPT.main()
