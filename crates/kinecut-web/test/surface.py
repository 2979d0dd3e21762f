"""The window of surfaces and machines in a browser, as a person uses it: python3 surface.py KINECUT [STEP ...]. Its numbers are held against those
that the program itself prints with `kinecut surface`, `layouts`, `machine` and `ik`. Needs and settings: common.py."""

import math
import re

from common import EXAMPLES, LONG, MARK, SIZES, UNMARKED, WEEKLY, Script, Served, Stage, Watched, clean, kept_back, painted, shares, shell, shot, still
from playwright.sync_api import Browser, Page

FOLDER = "05_machine_from_code"
# The codes of table 5.T, from the point tool to the die.
CODES = ["6153", "615", "61", "6", ""]
# Places of the point whose times are measured, and the bound for nineteen of twenty answers [ms].
MOVES = 40
ANSWERED = 100


class Verb:
    """The program at the shell."""

    def __init__(self, program: str):
        self.program = program

    def __call__(self, *words: str):
        return shell(self.program, *words, folder=EXAMPLES / FOLDER)


def opened(watched: Watched, served: Served, query: str = "") -> Page:
    page = watched.opened(served.at(query) if query else served.address)
    page.locator('[data-open="surfaces"]').click()
    page.locator("[data-bar]").wait_for(timeout=LONG)
    return page


def asked(page: Page) -> int:
    return int(page.evaluate("() => document.documentElement.dataset.surface ?? '0'"))


def after(page: Page, before: int) -> None:
    page.wait_for_function(f"() => Number(document.documentElement.dataset.surface ?? 0) > {before}", timeout=LONG)


def fresh(page: Page) -> None:
    """Waits until what is shown is of the newest question."""
    page.locator('[data-panel="sketch"] .held[data-stale]').wait_for(state="detached", timeout=LONG)


def field(page: Page, name: str):
    return page.locator(f'[data-number="{name}"] input')


def put(page: Page, **values: str) -> None:
    for name, value in values.items():
        answered(page, name, value)
        still(page)


def answered(page: Page, name: str, value: str) -> None:
    """Types a number and waits for its answer; others may still be open."""
    if field(page, name).input_value() == value:
        return
    before = asked(page)
    field(page, name).fill(value)
    after(page, before)


def fact(page: Page, name: str) -> str:
    return page.locator(f'[data-fact="{name}"] dd').inner_text()


def point(page: Page) -> list[float]:
    return [float(n) for n in re.findall(r"-?[\d.]+", fact(page, "point").replace("−", "-").split(")")[0])]


def bar(page: Page):
    return page.locator("[data-bar]")


def part(code: str) -> str:
    return code or "–"


def numbers(page: Page, verb: Verb) -> None:
    """The cone of the paper: its point at phi 1, z 20, with the numbers that the program prints, and those of equation 4."""
    clean(page, "start")
    put(page, R="30", alpha="0.35", phi="1", z="20")
    told = verb("surface", "cone", "--set", "R=30", "--set", "alpha=0.35", "--at", "phi=1", "--at", "z=20")
    assert fact(page, "point").startswith("(12.504, 19.473, 18.787)"), fact(page, "point")
    assert all(abs(a - b) < 6e-4 for a, b in zip(point(page), told["place"]["point"])), (point(page), told["place"]["point"])
    chips = page.locator(".chain [data-chip]").evaluate_all("all => all.map(c => c.dataset.chip)")
    assert "".join(chips) == told["code"] == "6153", chips
    words = page.locator(".chain").inner_text()
    assert all(one in words for one in ("A⁶(φ)", "A¹(R)", "A⁵(−α)", "A³(z)")), words
    assert "code 6153, surface of revolution" in page.locator('[data-panel="chain"] header').inner_text()
    # The matrices are folded away; opened they hold the numbers of the place.
    assert not page.locator(".matrices").is_visible()
    page.locator('[data-panel="chain"] summary').click()
    filled = page.locator('[data-matrix="6"] .filled').inner_text().replace("−", "-").split()
    assert abs(float(filled[0]) - math.cos(1)) < 6e-5 and abs(float(filled[1]) + math.sin(1)) < 6e-5, filled
    assert "cos(φ)" in page.locator('[data-matrix="6"] pre').first.inner_text()
    page.locator('[data-panel="chain"] summary').click()
    # Another radius and angle, as a formula.
    put(page, R="40", alpha="20*pi/180")
    told = verb("surface", "cone", "--set", "R=40", "--set", "alpha=20*pi/180", "--at", "phi=1", "--at", "z=20")
    assert all(abs(a - b) < 6e-4 for a, b in zip(point(page), told["place"]["point"])), (point(page), told["place"]["point"])
    put(page, R="30", alpha="0.35")
    shot(page, "surface-cone")


def wrongs(page: Page, verb: Verb) -> None:
    """A wrong number is told at its field by the sentence of the program; what is shown is older."""
    before = asked(page)
    field(page, "R").fill("3+")
    after(page, before)
    sentence = verb("surface", "cone", "--set", "R=3+")["message"].replace("`", "")
    assert page.locator('[data-number="R"].wrong .told').inner_text() == sentence
    assert page.locator(".stack[data-aged]").count() == 2 and page.locator(".tag.np", has_text="older").count() >= 1
    clean(page, "mistake")
    put(page, R="30")
    before = asked(page)
    field(page, "z").fill("70")
    after(page, before)
    assert "0 to 50" in page.locator('[data-number="z"].wrong .told').inner_text()
    put(page, z="20")
    # An apex within the domain is a warning of the surface.
    put(page, R="10")
    assert "KC" not in page.locator(".across.np").inner_text() and page.locator(".across.np").count() == 1
    put(page, R="30")
    assert page.locator(".across.np").count() == 0


def drags(page: Page, verb: Verb) -> None:
    """The point is dragged on the surface, and by keys; where it is, is the program's number."""
    put(page, phi="1", z="20")
    held = page.locator('[data-panel="sketch"] .held')
    held.scroll_into_view_if_needed()
    box = held.bounding_box()
    x, y = (float(n) for n in page.locator("[data-point]").get_attribute("data-point").split(","))
    before = asked(page)
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    for i in range(1, 9):
        page.mouse.move(box["x"] + x - 4 * i, box["y"] + y - 3 * i)
    page.mouse.up()
    after(page, before)
    fresh(page)
    phi, z = field(page, "phi").input_value(), field(page, "z").input_value()
    assert (phi, z) != ("1", "20"), (phi, z)
    told = verb("surface", "cone", "--set", "R=30", "--set", "alpha=0.35", "--at", f"phi={phi}", "--at", f"z={z}")
    assert all(abs(a - b) < 6e-4 for a, b in zip(point(page), told["place"]["point"])), (point(page), told["place"]["point"])
    # It is drawn where the pointer left it.
    now = [float(n) for n in page.locator("[data-point]").get_attribute("data-point").split(",")]
    assert math.hypot(now[0] - x + 32, now[1] - y + 24) < 4, (now, x, y)
    put(page, phi="1", z="20")
    held.focus()
    for key, name, value in (("ArrowRight", "phi", 1.06), ("ArrowUp", "z", 20.5), ("Shift+ArrowDown", "z", 15.5), ("Alt+ArrowLeft", "phi", 1.054)):
        before = asked(page)
        held.press(key)
        after(page, before)
        assert abs(float(field(page, name).input_value()) - value) < 1e-9, (key, field(page, name).input_value())
    # Elsewhere a drag turns the view, and leaves the place.
    at = page.locator("[data-point]").get_attribute("data-point")
    page.mouse.move(box["x"] + 20, box["y"] + 30)
    page.mouse.down()
    page.mouse.move(box["x"] + 90, box["y"] + 60)
    page.mouse.up()
    assert page.locator("[data-point]").get_attribute("data-point") != at and field(page, "z").input_value() == "15.5"
    page.locator('[data-view="iso"]').click()
    put(page, phi="1", z="20")


def codes(page: Page, verb: Verb) -> None:
    """Table 5.T: the bar is dragged along 6 1 5 3, and process, tool, infeed and verdict follow."""
    told = {s["machine_code"]: s for s in verb("surface", "cone")["splits"]}
    bar(page).scroll_into_view_if_needed()

    def shown(code: str) -> None:
        page.wait_for_function("code => document.querySelector('[data-fact=machineCode] dd').innerText.startsWith(code)", arg=f"{part(code)}:")
        split = told[code]
        assert page.locator(f'[data-split="{code}|{split["tool_code"]}"]').get_attribute("aria-pressed") == "true"
        assert fact(page, "process") == split["process"], (fact(page, "process"), split["process"])
        assert page.locator('[data-panel="chosen"] header').inner_text().endswith(split["tool_kind"])
        digits = lambda name: [int(n) for n in re.findall(r"\d", fact(page, name))]
        assert digits("forming") == split["forming"] and digits("setting") == split["setting"], code
        if split["setup"]:
            assert f"margin {split['setup']['margin']:.3f}" in fact(page, "setup") and split["setup"]["verdict"] in fact(page, "setup")
            assert split["setup"]["motion"] in fact(page, "setup"), fact(page, "setup")
        tool = page.locator('[data-panel="sketch"] svg .edge').count(), page.locator('[data-panel="sketch"] .die').count(), page.locator(".point.tool").count()
        wanted = {"point tool": (0, 0, 1), "straight edge": (1, 0, 0)}.get(split["tool_kind"], (0, 1, 0))
        # The key below the sketch has an edge of its own.
        assert (tool[0] - page.locator(".key .edge").count(), *tool[1:]) == wanted, (code, tool)
        roles = page.locator('[data-panel="sketch"] .held .motion').evaluate_all("all => all.map(m => m.dataset.role)")
        assert roles.count("forming") == len(split["forming"]) and roles.count("setting") == len(split["setting"]), (code, roles)
        assert roles.count("set-up") == (1 if split["setup"] else 0), (code, roles)

    def drag(to: float) -> None:
        grip = bar(page).bounding_box()
        page.mouse.move(grip["x"] + grip["width"] / 2, grip["y"] + grip["height"] / 2)
        page.mouse.down()
        page.mouse.move(to + 6, grip["y"] + 12, steps=4)
        page.mouse.move(to, grip["y"] + 12)
        page.mouse.up()

    page.locator(f'[data-split="6153|"]').click()
    shown("6153")
    for n, code in list(enumerate(reversed(CODES)))[::-1][1:]:
        chip = page.locator(".chain [data-chip]").nth(n).bounding_box()
        drag(chip["x"] + 4)
        shown(code)
        if code == "61":
            shot(page, "surface-61")
    assert "free, margin 0.343" in fact(page, "setup") and fact(page, "setup").startswith("+3") and "stamping" in fact(page, "process")
    shot(page, "surface-die")
    # Back by the keys.
    bar(page).focus()
    for code in CODES[::-1][1:]:
        page.keyboard.press("ArrowRight")
        shown(code)
    page.keyboard.press("Home")
    shown("")
    page.keyboard.press("End")
    shown("6153")
    page.keyboard.press("ArrowLeft")
    assert "free, margin 0.939" in fact(page, "setup") and bar(page).get_attribute("aria-valuetext") == "machine 615, tool 3"
    # All motions that were looked at.
    page.locator('[data-panel="chosen"] summary').click()
    rows = page.locator('[data-panel="chosen"] tbody tr').all_inner_texts()
    assert len(rows) == len(told["615"]["candidates"]), rows
    page.locator('[data-panel="chosen"] summary').click()
    clean(page, "split")


def lattice(page: Page, verb: Verb) -> None:
    """A cylinder has six redistributions where its chain has four; a screw has some with no rigid tool."""
    page.locator('[data-surface="cylinder"]').click()
    page.wait_for_function("() => document.querySelectorAll('.lattice .card').length === 6", timeout=LONG)
    told = [s["machine_code"] + "|" + s["tool_code"] for s in verb("surface", "cylinder")["splits"]]
    shown = page.locator(".lattice .card").evaluate_all("all => all.map(c => c.dataset.split)")
    assert sorted(shown) == sorted(told) and {"63|1", "3|61"} <= set(shown), (shown, told)
    # The chain takes the order of what is chosen; the bar goes on from there.
    page.locator('[data-split="63|1"]').click()
    assert page.locator(".chain [data-chip]").evaluate_all("all => all.map(c => c.dataset.chip).join('')") == "631"
    bar(page).focus()
    page.keyboard.press("ArrowRight")
    assert fact(page, "machineCode").startswith("613:"), fact(page, "machineCode")
    shot(page, "surface-lattice")
    page.locator('[data-surface="screw"]').click()
    page.wait_for_function("() => document.querySelector('[data-panel=chain] header').innerText.includes('6313')", timeout=LONG)
    splits = verb("surface", "screw")["splits"]
    assert page.locator(".lattice .card:disabled").count() == sum(not s["valid"] for s in splits) > 0
    links = page.locator('[data-fact="link"] dd').all_inner_texts()
    assert links[0].startswith("screw: 6(φ) 3(") and links[1].startswith("contour: "), links
    # Keys go through the pictures.
    page.locator('[data-surface="screw"]').press("Home")
    page.wait_for_function("() => document.querySelector('[data-panel=chain] header').innerText.includes('321')", timeout=LONG)
    page.locator('[data-surface="cone"]').click()
    page.wait_for_function("() => document.querySelector('[data-panel=chain] header').innerText.includes('6153')", timeout=LONG)


def machines(page: Page, verb: Verb) -> None:
    """A lathe says which redistributions it can make and the laws of its axes, a mill why not, and what could."""
    page.locator("#surface-machine").select_option("lathe_xzc")
    page.locator("[data-made]").wait_for(timeout=LONG)
    told = verb("surface", "cone", "--machine", "lathe_xzc")["on_machine"]
    cans = page.locator('[data-panel="onMachine"] tbody .tag').all_inner_texts()
    wanted = ["can" if one["possible"] else "cannot" for one in told["splits"] + told["envelopes"]]
    assert cans == wanted, (cans, wanted)
    page.locator('[data-split="6153|"]').click()
    assert "X follows Z, -0.365028 mm/mm" in page.locator("[data-made] .laws").inner_text(), page.locator("[data-made]").inner_text()
    shot(page, "surface-lathe")
    # Its tags are of these numbers alone: beside others nothing is said until it has answered again.
    tags = page.locator(".lattice .card .tag")
    assert tags.count() == len(told["splits"])
    with kept_back(page, "**/api/verb/surface", "lathe_xzc"):
        answered(page, "R", "31")
        page.locator('[data-panel="onMachine"] .tag.np').wait_for()
        painted(page)
        shown = (tags.count(), page.locator('[data-panel="onMachine"] [data-aged] [data-made]').count())
        assert shown == (0, 1), (shown, page.locator('[data-panel="onMachine"]').inner_text())
    page.wait_for_function("n => document.querySelectorAll('.lattice .card .tag').length === n", arg=len(told["splits"]), timeout=LONG)
    clean(page, "lathe")
    put(page, R="30")
    page.locator('[data-panel="onMachine"] [data-aged]').first.wait_for(state="detached", timeout=LONG)
    clean(page, "lathe")
    page.locator("#surface-machine").select_option("mill3_xyz")
    page.locator('[data-made="no"]').wait_for(timeout=LONG)
    why = next(s for s in verb("surface", "cone", "--machine", "mill3_xyz")["on_machine"]["splits"] if s["machine_code"] == "6153")["obstacle"]["message"]
    assert why in page.locator("[data-made]").inner_text(), (why, page.locator("[data-made]").inner_text())
    page.locator("[data-alternatives]").check()
    page.locator("[data-nearest]").first.wait_for(timeout=LONG)
    first = page.locator("[data-nearest]").first.get_attribute("data-nearest")
    told = verb("surface", "cone", "--machine", "mill3_xyz", "--alternatives")["on_machine"]["splits"]
    assert first == next(s for s in told if s["machine_code"] == "6153")["nearest"]["machines"][0]["code"], first
    page.locator("[data-alternatives]").uncheck()
    page.locator("#surface-machine").select_option("")
    assert page.locator("[data-made]").count() == 0


def files(page: Page, served: Served, verb: Verb) -> None:
    """Surfaces of the folder: one is chosen here, one is opened; what another program writes is shown."""
    page.locator(f'[data-file="{FOLDER}/cone.toml"]').click()
    page.wait_for_function("() => document.querySelector('[data-number=alpha] input')?.placeholder.startsWith('0.349')", timeout=LONG)
    put(page, phi="1", z="20")
    told = verb("surface", "cone.toml", "--at", "phi=1", "--at", "z=20")
    assert all(abs(a - b) < 6e-4 for a, b in zip(point(page), told["place"]["point"])), (point(page), told["place"]["point"])
    path = served.folder / FOLDER / "cone.toml"
    text = path.read_text()
    path.write_text(text.replace("R = 30", "R = 33"))
    page.wait_for_function("() => document.querySelector('[data-number=R] input')?.placeholder === '33'", timeout=LONG)
    path.write_text(text)
    page.wait_for_function("() => document.querySelector('[data-number=R] input')?.placeholder === '30'", timeout=LONG)
    # The address keeps the question: it is there again after the page was loaded anew.
    page.locator('[data-split="61|53"]').click()
    assert "split=61%7C53" in page.url and "at=phi%3D1" in page.url, page.url
    page.reload()
    page.locator('[data-split="61|53"][aria-pressed="true"]').wait_for(timeout=LONG)
    assert field(page, "z").input_value() == "20" and page.title() == "Surfaces cone"
    # Opened as any file.
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name=f"{FOLDER}/thread.toml", exact=True).click()
    code = verb("surface", "thread.toml")["code"]
    page.wait_for_function("code => document.querySelector('[data-panel=chain] header')?.innerText.includes(`code ${code}`)", arg=code, timeout=LONG)
    page.locator('[data-surface="cone"]').click()
    page.wait_for_function("() => document.querySelector('[data-panel=chain] header').innerText.includes('6153')", timeout=LONG)


def gallery(page: Page, verb: Verb) -> None:
    """Layouts in the order of the program, filtered and weighted."""
    page.locator('[data-tab="layouts"]').click()
    page.locator(".layout img").first.wait_for(timeout=LONG)

    def same(*flags: str) -> dict:
        told = verb("layouts", *flags)
        codes = [layout["code"] for layout in told["layouts"]]
        page.wait_for_function("codes => JSON.stringify([...document.querySelectorAll('.layout')].map(l => l.dataset.layout)) === JSON.stringify(codes)", arg=codes, timeout=LONG)
        assert page.locator("[data-left]").get_attribute("data-left") == str(told["left"])
        costs = [float(c) for c in page.locator(".layout").evaluate_all("all => all.map(l => l.dataset.cost)")]
        assert costs == sorted(costs) == [layout["cost"] for layout in told["layouts"]]
        return told

    told = same("XYZAC", "--full")
    assert (told["enumerated"], told["left"]) == (720, 360)
    page.wait_for_function("() => document.querySelectorAll('.layout img').length === 24", timeout=LONG)
    assert page.locator(".layout img").evaluate_all("all => all.every(i => i.complete && i.naturalWidth === 300)")
    shot(page, "layouts")
    clean(page, "layouts")
    # Other layouts do not have the pictures of these, in their places.
    with kept_back(page, "**/api/drawing/layouts"):
        page.locator('[data-kind="head-table"]').check()
        same("XYZAC", "--full", "--kind", "head-table")
        assert page.locator(".layout img").count() == 0
    page.locator(".layout img").first.wait_for(timeout=LONG)
    page.locator('[data-layouts="work-links"]').fill("1")
    same("XYZAC", "--full", "--kind", "head-table", "--work-links", "1")
    page.locator('[data-layouts="stroke"]').fill("600, 500, 400")
    page.locator('[data-layouts="part"]').fill("200, 200, 100")
    same("XYZAC", "--full", "--kind", "head-table", "--work-links", "1", "--stroke", "600,500,400", "--part", "200,200,100")
    # A text that is no number is told at its field, and what is shown is older.
    page.locator('[data-layouts="tilt"]').fill("thirty")
    assert page.locator(".field.wrong .told").inner_text().startswith("Write numbers") and page.locator('[data-panel="gallery"][data-aged]').count() == 1
    page.locator('[data-panel="filters"] header button').click()
    same("XYZAC", "--full")
    # Weights: what weighs nothing orders nothing.
    slider = page.locator('[data-weight="overhang"]')
    slider.focus()
    slider.press("End")
    usual = {name: value for name, value in told["weights"]}
    same("XYZAC", "--full", *[word for name, value in (usual | {"overhang": 3}).items() for word in ("--weight", f"{name}={value}")])
    page.locator("[data-usual]").click()
    same("XYZAC", "--full")
    page.locator('[data-layouts="of"]').fill("QQ")
    page.locator('[data-wrong]').wait_for(timeout=LONG)
    assert verb("layouts", "QQ")["message"].replace("`", "") in page.locator("[data-wrong]").inner_text()
    page.locator('[data-layouts="of"]').fill("641203")
    same("641203", "--full")
    page.locator('[data-layouts="of"]').fill("XYZAC")
    same("XYZAC", "--full")


def pose(page: Page) -> int:
    return int(page.evaluate("() => document.documentElement.dataset.pose ?? '0'"))


def moved(page: Page, before: int) -> None:
    page.wait_for_function(f"() => Number(document.documentElement.dataset.pose ?? 0) > {before}", timeout=LONG)
    page.locator('[aria-live][data-late]').wait_for(state="detached", timeout=LONG)


def pixels(page: Page) -> str:
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return page.locator('[data-panel="machine"] .held').screenshot().hex()


def moves(page: Page, verb: Verb, served: Served) -> None:
    """A layout is opened as a machine, its sliders move it, tip and direction are those of `kinecut machine`; it becomes a file of the folder."""
    page.locator('[data-layout]').first.click()
    page.locator('[data-fact="tip"]').wait_for(timeout=LONG)
    code = page.locator('[data-panel="machine"] h2').inner_text().split()[0]
    home = pixels(page)
    before = pose(page)
    slider = page.locator('[data-axis="A"] input[type="range"]')
    slider.focus()
    for _ in range(30):
        slider.press("ArrowRight")
    moved(page, before)
    assert pixels(page) != home, "the picture has not moved"
    value = slider.input_value()
    assert value == "15"
    told = verb("machine", "--layout", code, "--at", f"A{value}")["pose"]
    tip = [float(n.replace("−", "-")) for n in page.locator('[data-fact="tip"] dd b').inner_text().split()]
    assert all(abs(a - b) < 6e-4 for a, b in zip(tip, told["tip"])), (tip, told["tip"])
    shot(page, "machine-layout")
    page.locator("[data-file-name]").fill("own.toml")
    page.locator("[data-save-machine]").click()
    page.wait_for_function("() => document.querySelector('#axes-machine').selectedOptions[0].text === 'own.toml'", timeout=LONG)
    assert f'code = "{code}"' in (served.folder / "own.toml").read_text() and "[[body]]" in (served.folder / "own.toml").read_text()
    # One that is known, beyond its travel; and back from a pose.
    page.locator("#axes-machine").select_option("trt_xyzac")
    page.wait_for_function("() => document.querySelector('[data-panel=machine] h2').innerText.includes('trt_xyzac')", timeout=LONG)
    before = pose(page)
    page.locator('[data-axis="A"] .num input').fill("80")
    moved(page, before)
    page.locator('[data-axis="A"].wrong .told').wait_for(timeout=LONG)
    assert page.locator('[data-axis="A"] .told').inner_text() == verb("machine", "trt_xyzac", "--at", "A80")["pose"]["findings"][0]["message"]
    clean(page, "machine")
    page.locator("[data-home]").click()
    page.locator("input[data-pose]").fill("X10 Z5 J-0.7 K0.7")
    page.locator("[data-inverse]").click()
    page.locator("[data-solution]").first.wait_for(timeout=LONG)
    solutions = verb("ik", "trt_xyzac", "--at", "X10 Z5 J-0.7 K0.7")["solutions"]
    assert page.locator("[data-solution]").count() == len(solutions) == 2
    before = pose(page)
    page.locator("[data-solution]").nth(1).click()
    moved(page, before)
    tip = [float(n.replace("−", "-")) for n in page.locator('[data-fact="tip"] dd b').inner_text().split()]
    assert all(abs(a - b) < 6e-4 for a, b in zip(tip, [10, 0, 5])), tip
    shot(page, "machine-known")
    # Positions for another pose, or of another machine, are none of this one.
    page.locator("input[data-pose]").fill("X10 Z6 J-0.7 K0.7")
    assert page.locator("[data-solution]").count() == 0
    # A machine of the folder.
    page.locator("#axes-machine").select_option(label=f"{FOLDER}/trunnion.toml")
    page.wait_for_function("() => !document.querySelector('[data-panel=machine] h2').innerText.includes('trt_xyzac')", timeout=LONG)
    page.locator('[data-tab="surface"]').click()
    bar(page).wait_for(timeout=LONG)


def times(page: Page) -> list[float]:
    """From a move of the point to its answer [ms]."""
    page.locator('[data-panel="sketch"] .held').focus()
    taken = []
    for i in range(MOVES):
        before = asked(page)
        page.keyboard.press("ArrowRight" if i % 2 else "ArrowUp")
        after(page, before)
        taken.append(float(page.evaluate("() => document.documentElement.dataset.surfaceMs")))
    return sorted(taken)


def looks(browser: Browser, served: Served) -> None:
    for theme in ("light", "dark"):
        for width, height in SIZES:
            watched = Watched(browser, (width, height), theme)
            page = opened(watched, served)
            page.wait_for_function("() => document.querySelectorAll('.pictures svg path').length > 300", timeout=LONG)
            put(page, phi="1", z="20")
            page.locator('[data-split="61|53"]').click()
            for name in ("surface", "layouts", "machine"):
                page.locator(f'[data-tab="{name}"]').click()
                page.locator({"surface": "[data-bar]", "layouts": ".layout img", "machine": '[data-fact="tip"]'}[name]).first.wait_for(timeout=LONG)
                painted(page)
                shot(page, f"{name}-{theme}-{width}")
                clean(page, f"{name} {theme} {width}")
                assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{name} {width} scrolls sideways"
            page.locator('[data-tab="surface"]').click()
            small = page.locator(".surfaces svg text").evaluate_all("all => all.filter(e => parseFloat(getComputedStyle(e).fontSize) < 10).length")
            assert small == 0
            watched.close(served.address)


def beside(browser: Browser, served: Served) -> None:
    """A text that is no file yet lies open in another tab."""
    watched = Watched(browser, (1400, 900), "light")
    page = watched.opened(served.address)
    page.locator('[data-open="new"]').click()
    page.locator('[data-new="drilling"]').click()
    page.locator('main.drilling[data-state="done"]').wait_for(timeout=LONG)
    page.locator('[data-open="surfaces"]').click()
    page.locator('[data-split="61|53"]').wait_for(timeout=30_000)
    assert page.locator(".across").count() == 0, page.locator(".across").first.inner_text()
    watched.close(served.address)


def pseudo(browser: Browser, served: Served) -> None:
    watched = Watched(browser, (1400, 900), "light")
    page = opened(watched, served, "lang=pseudo")
    page.locator("#surface-machine").select_option("mill3_xyz")
    page.locator("[data-made]").wait_for(timeout=LONG)
    page.locator('[data-panel="chain"] summary').click()
    found = page.evaluate(UNMARKED, MARK)
    page.locator('[data-tab="layouts"]').click()
    page.locator(".layout img").first.wait_for(timeout=LONG)
    found += page.evaluate(UNMARKED, MARK)
    page.locator('[data-tab="machine"]').click()
    page.locator('[data-fact="tip"]').wait_for(timeout=LONG)
    found += page.evaluate(UNMARKED, MARK)
    assert not found, sorted(set(found))
    watched.close(served.address)


def measured(stage: Stage) -> None:
    taken = times(stage.page)
    print(f"  from a move of the point to its answer: {shares(taken)}")
    assert not WEEKLY or taken[int(0.95 * MOVES)] <= ANSWERED, taken


SCRIPT = Script(
    "the window of surfaces and machines",
    (FOLDER,),
    {
        "numbers": lambda s: numbers(s.page, Verb(s.program)),
        "wrongs": lambda s: wrongs(s.page, Verb(s.program)),
        "drags": lambda s: drags(s.page, Verb(s.program)),
        "codes": lambda s: codes(s.page, Verb(s.program)),
        "times": measured,
        "lattice": lambda s: lattice(s.page, Verb(s.program)),
        "machines": lambda s: machines(s.page, Verb(s.program)),
        "files": lambda s: files(s.page, s.served, Verb(s.program)),
        "gallery": lambda s: gallery(s.page, Verb(s.program)),
        "moves": lambda s: moves(s.page, Verb(s.program), s.served),
        "closes": Stage.closes,
        "beside": lambda s: beside(s.browser, s.served),
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    lambda s: opened(s.watched, s.served),
    always=("numbers", "closes"),
)

if __name__ == "__main__":
    SCRIPT.main()
