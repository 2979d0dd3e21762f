"""The window of a milled hole in a browser, as a person uses it: python3 hole.py KINECUT [STEP ..]. It reads the worked example of Sorokin, But and
Kombarov 2013 back from the page. Needs and settings: common.py."""

import math
import re

from common import LONG, MARK, MINUS, OUTCOME, SIZES, UNMARKED, Script, Served, Stage, cells, clean, frame, kept_back, open_file, settled, shell, shot, visited
from drill import field
from playwright.sync_api import Browser, Page

HOLE = "main.hole"
# What the paper prints of its finishing, and what of its roughing.
FINISHING = {
    "roll": "9.04481", "psi": "0.946567", "touchX": "64.913", "touchY": "−46.758", "length": "242.250", "startRadius": "57.581",
    "circle": "502.655", "visible": "0.5605", "base": "6.366198", "radius": "80.000",
}  # fmt: skip
ROUGHING = {"radius": "79.000", "turns": "20", "step": "3.950", "base": "0.628662", "length": "4963.716", "circle": "496.372"}
TYPED = {
    "operation.diameter": "200", "tool.diameter": "40", "operation.rough.stepover": "4", "operation.rough.allowance": "1",
    "operation.finish.turns": "2",
}  # fmt: skip
OTHERWISE = {
    "operation.diameter": "160", "tool.diameter": "32", "operation.rough.stepover": "3", "operation.rough.allowance": "0.5",
    "operation.finish.turns": "3",
}  # fmt: skip
STRATEGIES = ["involute", "lens-1", "lens-2", "archimedean", "arcs-2", "arcs-4", "rings", "rings-tangent", "trochoidal"]
# Notes when the pointer moves and when another length is on the page.
WATCH = """() => {
  window.dragged = { moves: [], drawn: [] };
  document.addEventListener("pointermove", () => dragged.moves.push(performance.now()), true);
  new MutationObserver(() => dragged.drawn.push(performance.now())).observe(document.querySelector('[data-table="paper"] [data-row="length"]'), { subtree: true, characterData: true, childList: true });
}"""


def new_hole(page: Page) -> None:
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name="New hole").click()
    page.locator("main.hole").wait_for(timeout=LONG)
    settled(page, HOLE)


def choose(page: Page, name: str) -> None:
    page.locator(f'[data-choose="{name}"]').click()
    page.locator(f'main.hole[data-pass="{name}"]').wait_for(timeout=LONG)
    settled(page, HOLE)


def start(page: Page, x: str, y: str) -> None:
    page.locator('[id="f-operation.finish.start"]').fill(x)
    page.locator('[id="f-operation.finish.start-1"]').fill(y)


def start_of(page: Page) -> tuple[float, float]:
    inputs = page.locator('[data-key="operation.finish.start"] input')
    return float(inputs.nth(0).input_value()), float(inputs.nth(1).input_value())


def numbers(page: Page) -> dict[str, str]:
    return cells(page, "paper", 2)


def number(text: str) -> float:
    return float(re.match(r"[-\d.]+", text.replace(MINUS, "-")).group())


def verb(program: str, text: str, samples: str) -> dict:
    """The answer of the command line to the same text."""
    return shell(program, "hole", "-", "--samples", samples, text=text)


def saved(page: Page, served: Served) -> str:
    """The text of the window, saved."""
    if page.locator(".tab.on .dot").count():
        page.keyboard.press("Control+s")
        page.locator(".tab.on .dot").wait_for(state="detached")
        settled(page, HOLE)
    return (served.folder / page.title().split()[-1]).read_text()


def run_of(answer: dict, name: str) -> dict:
    return next(p for p in answer["passes"] if p["pass"] == name)


def between(along: list, column: list, value: float) -> float | None:
    """A column at a place, in proportion between two samples."""
    i = max(0, min(len(along) - 2, next((k for k, v in enumerate(along) if v > value), len(along)) - 1))
    a, b = column[i], column[i + 1]
    share = (value - along[i]) / (along[i + 1] - along[i]) if along[i + 1] > along[i] else 0
    return None if a is None or b is None else a + (b - a) * share


def paper(page: Page, served: Served, program: str) -> None:
    """The paper's case is typed, and its numbers are read back; each is the verb's."""
    page.locator('[data-open="new"]').focus()
    page.keyboard.press("Enter")
    page.locator('[data-new="hole"]').focus()
    page.keyboard.press("Enter")
    page.locator("main.hole").wait_for(timeout=LONG)
    settled(page, HOLE)
    for key, value in OTHERWISE.items():
        field(page, key).fill(value)
    start(page, "-20", "12")
    assert settled(page, HOLE) == "done", page.locator(".across.wrong").all_inner_texts()
    other = numbers(page)
    assert all(other[key] != value for key, value in FINISHING.items()), other
    for key, value in TYPED.items():
        field(page, key).fill(value)
    start(page, "-40", "40")
    assert settled(page, HOLE) == "done"
    assert page.locator("h1").inner_text() == "Milled hole ⌀200"
    told = numbers(page)
    assert {key: told[key] for key in FINISHING} == FINISHING, told
    assert "0.5858" in page.locator('[data-table="paper"] tr[data-row="visible"] small').inner_text()
    page.locator(".records summary").click()
    assert cells(page, "records", 1) == {"0": "242.250", "1": "502.655"}
    # The columns that the paper lost or confused: the tangent angle, the start of the circle, both radii.
    assert cells(page, "records", 4) == {"0": "9.99138", "1": "0.94657"}
    assert cells(page, "records", 2) == {"0": "−40.000", "1": "64.913"}
    assert cells(page, "records", 6) == {"0": "80.000", "1": "80.000"}
    shot(page, "hole-paper")
    choose(page, "rough")
    told = numbers(page)
    assert {key: told[key] for key in ROUGHING} == ROUGHING, told
    text = saved(page, served)
    rough = run_of(verb(program, text, "rough"), "rough")
    assert page.locator('[data-fact="time"] dd').inner_text().startswith(f"{rough['run']['time']:.3f} s")
    degrees = math.degrees(rough["run"]["peaks"]["engagement"])
    assert page.locator('[data-fact="engagement"] dd').inner_text().startswith(f"{degrees:.2f}°")
    shot(page, "hole-rough")


def handles(page: Page, served: Served, program: str) -> None:
    """The start is dragged by mouse, finger and keys; the point of tangency turns the curve as a rigid body."""
    new_hole(page)
    handle = page.locator('[data-handle="start"]')
    svg = page.locator("svg.involute")

    def places() -> tuple[dict, dict]:
        return handle.locator(".grip").bounding_box(), svg.bounding_box()

    grip, area = places()
    x, y = grip["x"] + grip["width"] / 2, grip["y"] + grip["height"] / 2
    middle = (area["x"] + area["width"] / 2, area["y"] + area["height"] / 2)
    scale = (middle[0] - x) / 40
    assert abs((middle[1] - y) / 40 - scale) < 0.05, "the plan is not to scale"
    before = numbers(page)
    page.evaluate(WATCH)
    page.mouse.move(x, y)
    page.mouse.down()
    for i in range(1, 41):
        page.mouse.move(x + i * scale / 2, y + i * scale * 0.75)
        frame(page)
    page.mouse.up()
    assert settled(page, HOLE) == "done"
    moves, drawn = page.evaluate("() => [dragged.moves, dragged.drawn]")
    late = sorted(min((d for d in drawn if d >= m), default=math.inf) - m for m in moves)
    print(f"  {len(moves)} moves of T0, {len(drawn)} answers on the page; a move is drawn after {late[len(late) // 2]:.0f} ms, {late[-1]:.0f} ms at most")
    # The curve follows the hand: it does not wait for its rest.
    assert len(drawn) > 5, (len(moves), len(drawn))
    now = start_of(page)
    assert abs(now[0] + 20) < 0.6 and abs(now[1] - 10) < 0.6, now
    told = numbers(page)
    assert all(told[key] != before[key] for key in ("roll", "psi", "length", "startRadius", "visible")), told
    assert told["circle"] == before["circle"]
    known = run_of(verb(program, saved(page, served), "finish"), "finish")
    assert told["roll"] == f"{known['roll']:.5f}" and told["length"] == f"{known['length']:.3f}", (told, known["roll"], known["length"])
    shot(page, "hole-dragged")

    handle.focus()
    for key in ("ArrowLeft", "Shift+ArrowUp", "Alt+ArrowRight"):
        page.keyboard.press(key)
        settled(page, HOLE)
    moved = start_of(page)
    assert abs(moved[0] - (now[0] - 0.9)) < 1e-6 and abs(moved[1] - (now[1] + 10)) < 1e-6, (now, moved)
    assert handle.get_attribute("aria-valuetext") == f"X {moved[0]:.3f}, Y {moved[1]:.3f} from the centre".replace("-", MINUS)

    # Through a point off the centre there is one lead-in only: the point is turned with it.
    was = numbers(page)
    touch = page.locator('[data-handle="touch"]')
    touch.focus()
    page.keyboard.press("Shift+ArrowRight")
    settled(page, HOLE)
    turned = start_of(page)
    assert abs(math.hypot(*turned) - math.hypot(*moved)) < 2e-3, (turned, moved)
    by = math.degrees(math.atan2(turned[1], turned[0]) - math.atan2(moved[1], moved[0]))
    assert abs((by + 360) % 360 - 350) < 0.01, by
    told = numbers(page)
    assert abs(number(told["length"]) - number(was["length"])) < 3e-3 and told["psi"] != was["psi"]
    svg.evaluate("e => e.scrollIntoView({ block: 'center' })")
    grip, area = touch.locator(".grip").bounding_box(), svg.bounding_box()
    middle = (area["x"] + area["width"] / 2, area["y"] + area["height"] / 2)
    page.mouse.move(grip["x"] + 7, grip["y"] + 7)
    page.mouse.down()
    page.mouse.move(middle[0] + 60, middle[1] - 90, steps=8)
    page.mouse.up()
    settled(page, HOLE)
    told = numbers(page)
    angle = math.degrees(math.atan2(number(told["touchY"]), number(told["touchX"])))
    assert abs(angle - math.degrees(math.atan2(90, 60))) < 1.2, angle

    # By a finger.
    grip, _ = places()
    spot = (grip["x"] + 7, grip["y"] + 7)
    session = page.context.new_cdp_session(page)
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": spot[0], "y": spot[1]}]})
    for i in range(1, 6):
        session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [{"x": spot[0] + 4 * i, "y": spot[1] + 3 * i}]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    settled(page, HOLE)
    fingered = start_of(page)
    assert abs(fingered[0] - turned[0]) > 1, (fingered, turned)

    # Undo goes back over all of it, to what was saved.
    for _ in range(40):
        page.keyboard.press("Control+z")
    settled(page, HOLE)
    assert start_of(page) == now, (start_of(page), now)
    page.keyboard.press("Control+y")
    settled(page, HOLE)
    assert start_of(page) != now


def cursor(page: Page, served: Served, program: str) -> None:
    """The cutter on its path, the cursor of the charts and what they read are one place; the readings are the verb's."""
    new_hole(page)
    run = run_of(verb(program, saved(page, served), "finish"), "finish")["run"]
    samples = run["samples"]
    slide = page.locator(".charts [role=slider]")

    def reads(s: float) -> None:
        for name, column, factor, decimals in (
            ("speed", "speed", 0.06, 3), ("acceleration", "acceleration", 1e-3, 4), ("jerk", "jerk", 1e-3, 4),
            ("engagement", "engagement", 180 / math.pi, 2), ("curvature", "curvature", 1e3, 3),
        ):  # fmt: skip
            shown = page.locator(f'[data-now="{name}"]').text_content()
            value = between(samples["s"], samples[column], s)
            if value is None:
                assert shown == "–", (name, shown)
            else:
                assert abs(number(shown) - value * factor) <= 0.6 * 10**-decimals + 1e-3 * abs(value * factor), (name, shown, value * factor)
        i = next((k for k, v in enumerate(run["way"]["s"]) if v >= s), len(run["way"]["s"]) - 1)
        centre = page.locator("svg.involute .centre")
        place = float(centre.get_attribute("data-x")), float(centre.get_attribute("data-y"))
        near = min(math.hypot(run["way"]["x"][k] - place[0], run["way"]["y"][k] - place[1]) for k in range(max(0, i - 1), min(len(run["way"]["s"]), i + 2)))
        assert near < 9, (place, near)

    scrub = page.locator("#hole-scrub")
    for share in (0.1, 0.2, 0.35, 0.6, 0.95):
        scrub.fill(str(share * run["length"]))
        s = float(scrub.input_value())
        reads(s)
        angle = between(samples["s"], samples["engagement"], s)
        lit = float(page.locator("svg.involute .engaged").get_attribute("data-deg"))
        assert abs(lit - math.degrees(angle or 0)) < 0.02, (lit, angle)
    # On the circle it is where the circle is.
    scrub.fill(str(run_length := 0.5 * run["length"]))
    centre = page.locator("svg.involute .centre")
    assert abs(math.hypot(float(centre.get_attribute("data-x")), float(centre.get_attribute("data-y"))) - 80) < 0.11, run_length

    page.locator("svg.runs").evaluate("e => e.scrollIntoView({ block: 'center' })")
    chart = page.locator("svg.runs").bounding_box()
    page.mouse.click(chart["x"] + 54 + 0.25 * (chart["width"] - 66), chart["y"] + 90)
    s = float(slide.get_attribute("aria-valuenow"))
    assert abs(s - 0.25 * run["length"]) < 3, s
    assert abs(float(scrub.input_value()) - s) < 1
    reads(s)
    slide.focus()
    page.keyboard.press("Home")
    assert float(slide.get_attribute("aria-valuenow")) == 0
    page.keyboard.press("Shift+ArrowRight")
    assert abs(float(slide.get_attribute("aria-valuenow")) - 0.1 * run["length"]) < 1e-2
    # Closer about the cursor; over time.
    page.locator('[data-zoom="in"]').click()
    shot(page, "hole-closer")
    page.locator('[data-axis="time"]').click()
    page.keyboard.press("Escape")
    slide.focus()
    page.keyboard.press("End")
    assert abs(float(slide.get_attribute("aria-valuenow")) - run["time"]) < 1e-3 * run["time"]
    assert "time [s]" in page.locator("svg.runs").text_content()
    page.locator('[data-axis="way"]').click()

    # The cutter is dragged along its path in the plan.
    page.locator("svg.involute").evaluate("e => e.scrollIntoView({ block: 'center' })")
    box = page.locator("svg.involute").bounding_box()
    spot = page.locator("svg.involute .centre circle").bounding_box()
    page.mouse.move(spot["x"] + 4, spot["y"] + 4)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.86, steps=12)
    page.mouse.up()
    place = float(centre.get_attribute("data-x")), float(centre.get_attribute("data-y"))
    assert abs(math.hypot(*place) - 80) < 2 and place[1] < -60, place


def ways(page: Page, served: Served, program: str) -> None:
    """Strategies and contacts: the figures of each are those of the verb, each is laid over plan and charts."""
    new_hole(page)
    table = page.locator('[data-table="ways"]')
    page.wait_for_function("() => document.querySelectorAll('[data-table=ways] input:enabled').length === 3", timeout=LONG)
    contacts = cells(page, "ways", 6)
    assert contacts == {"g2": "G2", "g4": "G4", "g6": "G6"}, contacts
    # The row of the hole's own contact is marked, whichever it is.
    own = page.locator('[data-table="ways"] tr.on')
    for contact in ("g6", "g2"):
        page.locator('[data-key="operation.finish.contact"] select').select_option(contact)
        settled(page, HOLE)
        page.locator(f'[data-table="ways"] tr.on[data-row="{contact}"]').wait_for()
        assert own.count() == 1
    page.wait_for_function("() => !document.querySelector('[data-table=ways] tr[data-old]') && document.querySelectorAll('[data-table=ways] input:enabled').length === 3", timeout=LONG)
    # A higher contact touches the allowance earlier; the jerk steps in the first alone.
    steps = cells(page, "ways", 8)
    assert steps["g2"] == "0.00155" and (steps["g4"], steps["g6"]) == ("0", "0"), steps
    table.locator('tr[data-row="g6"] input').check()
    assert page.locator('svg.involute [data-ghost="g6"]').count() == 1
    assert page.locator('svg.runs [data-of="g6"]').count() == 5
    shot(page, "hole-contacts")
    choose(page, "rough")
    text = saved(page, served)
    assert page.locator("main.hole").get_attribute("data-pass") == "rough"
    page.wait_for_function("n => document.querySelectorAll('[data-table=ways] input:enabled').length === n", arg=len(STRATEGIES), timeout=LONG)
    known = {c: cells(page, "ways", c) for c in range(1, 10)}
    for name in STRATEGIES:
        run = run_of(verb(program, text.replace('strategy = "involute"', f'strategy = "{name}"'), "rough"), "rough")["run"]
        wanted = [f"{run['length']:.1f}", f"{run['time']:.2f}", f"{math.degrees(run['peaks']['engagement']):.1f}"]
        assert [known[c][name] for c in (1, 2, 3)] == wanted, (name, wanted, [known[c][name] for c in (1, 2, 3)])
        assert known[6][name] == run["closing"]["contact"] and known[9][name] == str(run["stops"]), name
        table.locator(f'tr[data-row="{name}"] input').check()
    assert known[6]["archimedean"] == "G0" and known[7]["archimedean"] == "impulse" and known[6]["arcs-2"] == "G1"
    assert number(known[7]["arcs-2"]) > 0 and known[7]["involute"] == "0"
    assert page.locator("svg.involute [data-ghost]").count() == len(STRATEGIES)
    # A path of constant engagement needs a circle to start on.
    assert "centre" in table.locator('tr[data-row="constant-engagement"]').inner_text()
    shot(page, "hole-strategies")
    for name in STRATEGIES[3:]:
        table.locator(f'tr[data-row="{name}"] input').uncheck()
    # They follow the numbers; until its answer has come, a run that is laid over is marked as older.
    before = known[1]["lens-1"]
    ghost = page.locator('svg.involute [data-ghost="lens-1"]')
    assert "aged" not in ghost.get_attribute("class")
    with kept_back(page, "**/api/verb/hole", "-lens-1.toml"):
        field(page, "operation.rough.stepover").fill("8")
        settled(page, HOLE)
        page.locator('[data-row="lens-1"][data-old]').wait_for()
        assert "aged" in ghost.get_attribute("class") and "(older)" in page.locator(".charts .key").inner_text()
    page.wait_for_function("was => { const r = document.querySelector('[data-row=lens-1]'); return !r.dataset.old && r.cells[1].textContent !== was }", arg=before, timeout=LONG)
    assert number(cells(page, "ways", 1)["lens-1"]) < 0.6 * number(before)


def mistakes(page: Page) -> None:
    """A mistake is shown at its field, what is older is marked; with the right number all is back."""
    new_hole(page)
    before = numbers(page)
    start(page, "-80", "40")
    assert settled(page, HOLE) == "wrong"
    told = page.locator('[data-key="operation.finish.start"] .told')
    assert told.count() == 1 and told.inner_text() in page.locator(".across.wrong").inner_text()
    assert page.locator(".oldness").count() == 1 and numbers(page) == before
    assert page.locator('[data-act="job"]').is_disabled()
    clean(page, "mistake")
    shot(page, "hole-mistake")
    page.locator(".across.wrong button").click()
    assert page.evaluate("() => document.activeElement.id") == "f-operation.finish.start"
    start(page, "-40", "40")
    assert settled(page, HOLE) == "done" and page.locator(".oldness, .across.wrong, .told").count() == 0
    for key, value in (("operation.diameter", "30"), ("tool.diameter", "0"), ("operation.rough.stepover", "-1"), ("operation.rough.allowance", "90"), ("dynamics.jerk", "-5")):
        known = field(page, key).input_value()
        field(page, key).fill(value)
        assert settled(page, HOLE) == "wrong", key
        assert page.locator(".across.wrong").count() == 1
        field(page, key).fill(known)
        assert settled(page, HOLE) == "done", key
    assert numbers(page) == before
    # The newest of many changes counts.
    for n in range(30):
        field(page, "operation.diameter").fill(f"{150 + n}")
    assert settled(page, HOLE) == "done" and page.locator("h1").inner_text() == "Milled hole ⌀179"
    assert numbers(page)["radius"] == "69.500"


def leaves(page: Page, served: Served) -> None:
    """The hole goes into a job: as an operation by copying, as a file of a job."""
    new_hole(page)
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.locator('[data-act="copy"]').click()
    page.locator('[data-act="copy"]', has_text="Copied.").wait_for()
    copied = page.evaluate("() => navigator.clipboard.readText()")
    assert copied.startswith("[[tool]]\n") and '[[setup.operation]]\ntype = "bore"\n' in copied, copied
    assert "start = [-40, 40]" in copied
    known = {f.name for f in served.folder.glob("*.toml")}
    page.locator('[data-act="job"]').click()
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    made = {f.name for f in served.folder.glob("*.toml")} - known
    assert len(made) == 1 and made.pop().endswith("-job.toml")
    assert page.locator(".pprog .l").count() > 5
    assert page.locator(".cm-content").inner_text().startswith("# From a hole")
    shot(page, "hole-job")


def opens(page: Page) -> None:
    """A question of the folder opens in the window: a helix, a control with involutes of its own."""
    open_file(page, "12_compare/hole.toml")
    page.wait_for_function("() => document.title.includes('12_compare')")
    assert settled(page, HOLE) == "done" and page.locator(".tab.on .dot").count() == 0
    # Its base radius is one that the control can print.
    assert numbers(page)["base"] == "6.366200"
    choose(page, "rough")
    assert numbers(page)["base"] == "0.610100"
    assert page.locator(".entries [data-chosen]").inner_text().startswith("helix")
    page.wait_for_function("() => document.querySelectorAll('[data-table=ways] input:enabled').length === 11", timeout=LONG)
    # Within the same engagement the path of free steps is shorter by far.
    lengths = cells(page, "ways", 1)
    assert number(lengths["constant-engagement-free"]) < 0.7 * number(lengths["involute"]), lengths
    page.locator('[data-key="operation.strategy"] select').select_option("constant-engagement")
    assert settled(page, HOLE) == "done"
    assert page.locator('[data-chart="engagement"] .limit').count() == 1
    shot(page, "hole-engagement")


def equal(page: Page, served: Served, program: str) -> None:
    """The comparison on equal terms, with the paper's claims, is that of the command line."""
    new_hole(page)
    page.locator('[data-act="compare"]').click()
    page.locator('[data-act="stop"]').click()
    page.locator('[data-act="compare"]').click()
    page.locator('[data-table="equal"]').wait_for(timeout=LONG)
    told = shell(program, "hole", "-", "--compare", text=saved(page, served))["comparison"]
    # A file that was new is another text: it is asked for again.
    page.locator('[data-act="compare"]').click()
    page.locator('[data-table="equal"]').wait_for(timeout=LONG)
    for row in told["rows"]:
        figures = row["figures"]
        if figures:
            shown = [cells(page, "equal", c)[row["strategy"]] for c in (1, 2, 5)]
            assert shown == [f"{figures['length']:.1f}", str(figures["blocks"]), f"{figures['runs'][0]['time']:.2f}"], (row["strategy"], shown)
    assert page.locator("[data-claims]").get_attribute("data-claims") == str(len(told["claims"]))
    field(page, "operation.diameter").fill("190")
    settled(page, HOLE)
    assert page.locator(".equal .tag.np").count() == 1


def looks(browser: Browser, served: Served) -> None:
    """Both themes at three widths: nothing that axe objects to, nothing that scrolls sideways."""
    for theme in ("light", "dark"):
        for width, height in SIZES:
            one, page = visited(browser, (width, height), theme, served.address)
            new_hole(page)
            for name in ("finish", "rough"):
                choose(page, name)
                page.locator(".ways .waits").wait_for(state="detached", timeout=LONG)
                if name == "rough":
                    for row in ("lens-1", "arcs-2"):
                        page.locator(f'[data-table="ways"] tr[data-row="{row}"] input').check()
                shot(page, f"hole-{theme}-{width}-{name}")
                clean(page, f"{theme} {width} {name}")
                assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways"
            page.locator("details.rest").evaluate("e => (e.open = true)")
            page.locator("details.records").evaluate("e => (e.open = true)")
            clean(page, f"{theme} {width}, all open")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways, all open"
            one.close(served.address)


def pseudo(browser: Browser, served: Served) -> None:
    """No text but names, numbers, units, program text and sentences of the library is outside the catalogue."""
    one, page = visited(browser, (1400, 900), "light", served.at("lang=pseudo"))
    page.locator('[data-open="new"]').click()
    page.locator('[data-new="hole"]').click()
    page.locator("main.hole").wait_for(timeout=LONG)
    settled(page, HOLE)
    found = page.evaluate(UNMARKED, MARK)
    page.locator("details.rest").evaluate("e => (e.open = true)")
    page.locator("details.records").evaluate("e => (e.open = true)")
    page.locator("details.more").evaluate_all("all => all.forEach(d => (d.open = true))")
    found += page.evaluate(UNMARKED, MARK)
    choose(page, "rough")
    page.locator(".ways .waits").wait_for(state="detached", timeout=LONG)
    for row in ("lens-1", "arcs-2", "trochoidal"):
        page.locator(f'[data-table="ways"] tr[data-row="{row}"] input').check()
    page.locator('[data-axis="time"]').click()
    found += page.evaluate(UNMARKED, MARK)
    page.locator('[data-key="operation.strategy"] select').select_option("ramping")
    settled(page, HOLE)
    found += page.evaluate(UNMARKED, MARK)
    field(page, "tool.diameter").fill("0")
    assert settled(page, HOLE) == "wrong"
    found += page.evaluate(UNMARKED, MARK)
    shot(page, "hole-pseudo")
    assert not found, sorted(set(found))
    assert MARK in page.locator(".picture h2").inner_text()
    one.close(served.address)


SCRIPT = Script(
    "the window of a milled hole",
    ("12_compare",),
    {
        "paper": lambda s: paper(s.page, s.served, s.program),
        "handles": lambda s: handles(s.page, s.served, s.program),
        "cursor": lambda s: cursor(s.page, s.served, s.program),
        "ways": lambda s: ways(s.page, s.served, s.program),
        "mistakes": lambda s: mistakes(s.page),
        "leaves": lambda s: leaves(s.page, s.served),
        "opens": lambda s: opens(s.page),
        "equal": lambda s: equal(s.page, s.served, s.program),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    lambda s: s.watched.opened(s.served.address),
    always=("closes",),
)

if __name__ == "__main__":
    SCRIPT.main()
