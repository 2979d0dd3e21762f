"""The workbench in a browser, as a person uses it: python3 browser.py KINECUT [STEP ...]. It serves copies of examples; needs and settings: common.py."""

import hashlib
import json
import re
from pathlib import Path

from common import LONG, MARK, OUTCOME, SIZES, UNMARKED, WEEKLY, Script, Served, Stage, Watched, clean, judged, kept_back, open_file, shares, shot, still
from playwright.sync_api import Browser, Page

# Changes of a diameter whose times are measured, and the bound for nineteen of twenty of them [ms].
CHANGES = 100
DRAWN = 100
BORE = "setup[0].operation[0]"


def text_of(page: Page) -> str:
    """The text as the editor has it; long ones are not in the page as a whole."""
    return page.locator(".cm-content").evaluate("e => e.cmTile?.view?.state.doc.toString() ?? e.cmView?.view?.state.doc.toString() ?? e.innerText")


def field(page: Page, key: str):
    return page.locator(f'[data-key="{key}"] input, [data-key="{key}"] select').first


def rows(page: Page) -> dict[int, str]:
    """The lines of the program that are in the page, by their numbers."""
    told = page.locator(".pprog .rows .l").evaluate_all("all => all.map(l => [l.querySelector('i').textContent, l.querySelector('span').textContent])")
    return {int(number): text for number, text in told}


def drawn(page: Page) -> int:
    return int(page.evaluate("() => document.documentElement.dataset.drawn ?? '0'"))


def wait_drawn(page: Page, after: int) -> None:
    page.wait_for_function(f"() => Number(document.documentElement.dataset.drawn ?? 0) > {after}", timeout=LONG)


def edits(page: Page, served: Served) -> None:
    """A change in the form is a change of that number in the text; the plan, the program and the part follow."""
    assert judged(page) == "SAFE"
    before = text_of(page)
    assert before == (served.folder / "01_bore/job.toml").read_text()
    program = rows(page)
    known = drawn(page)
    # Until the simulation has come the outcome is that of the text before, and says so.
    with kept_back(page, "**/api/simulate"):
        with page.expect_response("**/api/plan") as answer:
            field(page, f"{BORE}.diameter").fill("180")
        wait_drawn(page, known)
        assert text_of(page) == before.replace("diameter = 200\n", "diameter = 180\n"), "more than the number was changed"
        assert page.locator('.outcome[data-state="stale"]').count() or page.locator('.outcome[data-state="wait"]').count()
        assert "180" in page.locator(".outcome .what").inner_text()
    lines = answer.value.json()["programs"][0]["text"].split("\n")
    shown = rows(page)
    assert all(lines[number - 1] == text for number, text in shown.items()), "the list is not the program of the plan"
    assert shown != program, "the program did not follow"
    assert page.locator(".tab.on .dot").count() == 1 and page.locator(f'[data-key="{BORE}.diameter"] .dot').count() == 1
    assert judged(page) == "SAFE"
    assert page.title() == "SAFE 01_bore/job.toml"

    # Arrows step; a sum is worked out; a key that is not given is written where its table is, and taken away again.
    field(page, f"{BORE}.diameter").press("Shift+ArrowUp")
    assert "diameter = 190\n" in text_of(page)
    field(page, f"{BORE}.diameter").fill("25.4*7")
    field(page, f"{BORE}.diameter").press("Enter")
    assert "diameter = 177.8\n" in text_of(page)
    field(page, f"{BORE}.rough.allowance").fill("0.75")
    assert "rough = { stepover = 4, allowance = 0.75, feed = 6000, plunge_feed = 300, stepdown = 16 }" in text_of(page)
    without = text_of(page)
    field(page, f"{BORE}.tolerance").fill("0.01")
    assert "tolerance = 0.01" in text_of(page)
    field(page, f"{BORE}.tolerance").fill("")
    assert text_of(page) == without
    field(page, f"{BORE}.strategy").select_option("lens-1")
    assert 'strategy = "lens-1"' in text_of(page) and "# the paper starts in the centre" in text_of(page)

    # The text is the form too.
    page.locator(".cm-line", has_text="diameter = 177.8").click()
    page.keyboard.press("End")
    for _ in range(5):
        page.keyboard.press("Backspace")
    page.keyboard.type("150")
    assert field(page, f"{BORE}.diameter").input_value() == "150"
    # All of it can be undone.
    for _ in range(60):
        if text_of(page) == before:
            break
        page.keyboard.press("Control+z")
    assert text_of(page) == before


def completes(page: Page) -> None:
    """Keys and values are proposed, with their unit."""
    page.locator(".cm-line", has_text="breakthrough = 1").click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type("coo")
    page.locator(".cm-tooltip-autocomplete li", has_text="coolant").first.wait_for()
    # The editor takes no key for a proposal that it has shown for less than 75 ms: by its own clock.
    page.wait_for_function("shown => performance.now() > shown + 80", arg=page.evaluate("() => performance.now()"))
    page.keyboard.press("Enter")
    assert 'coolant = "' in text_of(page)
    for _ in range(30):
        if "coo" not in text_of(page):
            break
        page.keyboard.press("Control+z")
    assert "coo" not in text_of(page)


def mistakes(page: Page) -> None:
    """A wrong value has no outcome: its place is told, in text and form, by one sentence."""
    judged(page)
    page.locator(".cm-line", has_text="diameter = 200").click()
    page.keyboard.press("End")
    for _ in range(3):
        page.keyboard.press("Backspace")
    page.keyboard.type('"20o"')
    # Each key is a text of its own, and the first ones are wrong as well: the outcome is that of the last one.
    still(page)
    page.locator('.outcome[data-state="none"]').wait_for(timeout=LONG)
    assert page.locator(".outcome .word").inner_text() == "NO OUTCOME"
    told = page.locator(".outcome .what").inner_text()
    assert "line 46" in told and "20o" in told, told
    assert page.locator(".cm-editor .wave").count() >= 1
    sentence = page.locator(".cm-editor .lens").inner_text()
    assert page.locator(f'[data-key="{BORE}.diameter"] .told').inner_text().replace("`", "") in sentence
    assert page.locator(".stage.dim").count() == 1, "the last plan is not dimmed"
    shot(page, "no-outcome")
    page.locator(".pform .ops").focus()
    page.locator(".outcome .acts button").click()
    page.wait_for_function("() => document.activeElement.closest('.cm-editor') !== null", timeout=LONG)
    for _ in range(20):
        if "diameter = 200\n" in text_of(page):
            break
        page.keyboard.press("Control+z")
    assert judged(page) == "SAFE"


def plays(page: Page) -> None:
    """Play, step and scrub: material disappears, program and time follow the one cursor."""
    judged(page)
    clock = page.locator(".time .clock b")
    line = page.locator(".pprog .l.on i")
    box = page.locator(".chart").bounding_box()
    page.mouse.click(box["x"] + box["width"] * 0.4, box["y"] + box["height"] * 0.6)
    page.locator(".stage.now").wait_for()
    first = (clock.inner_text(), line.inner_text())
    page.locator("[data-play]").click()
    page.wait_for_function("was => document.querySelector('.time .clock b').textContent !== was", arg=first[0], timeout=LONG)
    page.locator("[data-play]").click()
    page.locator('[data-play="off"]').wait_for()
    # Wherever a slow machine has come to by now.
    page.mouse.click(box["x"] + box["width"] * 0.3, box["y"] + box["height"] * 0.6)
    page.wait_for_function("() => Number(document.querySelector('.chart').ariaValueNow) < 50")
    seen = []
    page.locator(".time h2").evaluate("() => document.activeElement.blur()")
    for _ in range(3):
        before = line.inner_text()
        page.keyboard.press(".")
        page.wait_for_function("was => document.querySelector('.pprog .l.on i')?.textContent !== was", arg=before)
        seen.append(line.inner_text())
    assert len(set(seen)) == 3, seen
    page.keyboard.press(",")
    page.wait_for_function("was => document.querySelector('.pprog .l.on i')?.textContent === was", arg=seen[1])
    # A click on a line moves time; Space plays.
    was = clock.inner_text()
    page.locator(".pprog .code").focus()
    page.keyboard.press("End")
    page.wait_for_function("was => document.querySelector('.time .clock b').textContent !== was", arg=was)
    page.keyboard.press(" ")
    page.locator('[data-play="on"]').wait_for()
    # Past the lines before the first place that is known.
    page.locator(".read").wait_for()
    page.keyboard.press(" ")
    page.locator('[data-play="off"]').wait_for()
    assert re.match(r"X", page.locator(".read").inner_text())


def keys(page: Page) -> None:
    page.locator(".time h2").evaluate("() => document.activeElement.blur()")
    panels = []
    for _ in range(6):
        page.keyboard.press("F6")
        panels.append(page.evaluate("() => document.activeElement.dataset.panel"))
    assert panels == ["form", "text", "part", "program", "findings", "time"], panels
    for key, name in (("2", "top"), ("3", "front"), ("4", "right"), ("1", "iso")):
        page.keyboard.press(key)
        page.locator(f'[data-view="{name}"][aria-checked="true"]').wait_for()
    page.keyboard.press("x")
    page.locator(".tools .section").wait_for()
    page.keyboard.press("x")
    for key, name in (("p", "path"), ("t", "tool"), ("h", "holder")):
        page.keyboard.press(key)
        assert not page.locator(f'[data-show="{name}"]').is_checked(), name
        page.keyboard.press(key)
        assert page.locator(f'[data-show="{name}"]').is_checked(), name
    page.keyboard.press("?")
    page.locator("dialog[open]").wait_for()
    clean(page, "keys")
    page.keyboard.press("Escape")
    page.locator("dialog").wait_for(state="detached")
    page.keyboard.press("Control+k")
    page.get_by_role("combobox", name="Find a command").fill("top")
    page.keyboard.press("Enter")
    page.locator('[data-view="top"][aria-checked="true"]').wait_for()
    # Keys go to the page once the dialog has left it.
    page.locator("dialog").wait_for(state="detached")
    page.keyboard.press("1")
    page.locator('[data-view="iso"][aria-checked="true"]').wait_for()
    page.keyboard.press("g")
    page.locator("dialog input").fill("20")
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('.pprog .l.on i')?.textContent === '20'")
    # Letters typed into a field are text.
    field(page, f"{BORE}.diameter").focus()
    page.keyboard.press("2")
    assert page.locator('[data-view="iso"][aria-checked="true"]').count() == 1
    page.keyboard.press("Backspace")


def saves(page: Page, served: Served) -> None:
    """Saving is explicit; a file that another program changed is not lost, neither is the text."""
    path = served.folder / "01_bore/job.toml"
    original = path.read_text()
    field(page, f"{BORE}.diameter").fill("190")
    assert path.read_text() == original
    page.keyboard.press("Control+s")
    page.locator(".tab.on .dot").wait_for(state="detached")
    still(page)
    assert path.read_text() == original.replace("diameter = 200\n", "diameter = 190\n")

    theirs = original.replace("diameter = 200\n", "diameter = 160\n")
    field(page, f"{BORE}.diameter").fill("195")
    path.write_text(theirs)
    page.keyboard.press("Control+s")
    page.get_by_role("button", name="Keep mine").wait_for(timeout=LONG)
    shot(page, "conflict")
    clean(page, "conflict")
    page.get_by_role("button", name="Show both").click()
    differ = page.locator("dialog .differs")
    assert differ.all_inner_texts() == ["diameter = 195", "diameter = 160"], differ.all_inner_texts()
    clean(page, "both")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Keep mine").click()
    page.get_by_role("button", name="Keep mine").wait_for(state="detached")
    still(page)
    assert "diameter = 195\n" in path.read_text()

    path.write_text(theirs)
    page.get_by_role("button", name="Take theirs").click(timeout=LONG)
    page.get_by_role("button", name="Take theirs").wait_for(state="detached")
    still(page)
    assert text_of(page) == theirs and page.locator(".tab.on .dot").count() == 0
    field(page, f"{BORE}.diameter").fill("200")
    page.keyboard.press("Control+s")
    page.locator(".tab.on .dot").wait_for(state="detached")
    still(page)
    assert path.read_text() == original


def operations(page: Page) -> None:
    """An operation is added, named in the list, deleted, and comes back by undo."""
    count = page.locator(".ops li").count()
    before = text_of(page)
    page.get_by_role("button", name="+ Operation").click()
    page.get_by_role("menuitem", name="Drill", exact=True).click()
    page.wait_for_function("n => document.querySelectorAll('.ops li').length === n + 1", arg=count)
    assert text_of(page).count("[[setup.operation]]") == before.count("[[setup.operation]]") + 1
    page.locator(".form .remove").click()
    assert text_of(page) == before
    page.get_by_role("button", name="Undo", exact=True).first.click()
    assert text_of(page).count("[[setup.operation]]") == before.count("[[setup.operation]]") + 1
    page.locator(".cm-content").focus()
    for _ in range(10):
        if text_of(page) == before:
            break
        page.keyboard.press("Control+z")
    assert text_of(page) == before


def findings(page: Page) -> None:
    """A job that meets a clamp: each finding leads to its line and place."""
    open_file(page, "17_vise_and_clamp/job.toml")
    assert judged(page, "17_vise_and_clamp/job.toml") == "NOT SAFE"
    items = page.locator(".findings > li.bad, .findings > li.np")
    assert items.count() >= 1
    go = items.first.locator(".go")
    number = re.search(r"\d+", go.inner_text()).group()
    go.click()
    page.wait_for_function("n => document.querySelector('.pprog .l.on i')?.textContent === n", arg=number)
    assert page.locator('.rings g[visibility="visible"]').count() == 1
    page.locator(".outcome .acts button").click()
    shot(page, "finding")


def others(page: Page) -> None:
    """A program that others wrote: shown, simulated, its findings told."""
    open_file(page, "07_external_program/O1007.nc")
    judged(page, "07_external_program/O1007.nc")
    assert page.locator(".pprog .l").count() > 5
    assert page.locator(".stage canvas").is_visible()
    assert page.locator(".pform h2").inner_text() == "Program of others"
    shot(page, "program-of-others")
    # Without a job beside it, tools and stock are guessed, and that is said.
    open_file(page, "haas_bracket.nc")
    judged(page, "haas_bracket.nc")
    assert page.locator(".guessed li").count() >= 1 and page.locator(".findings > li").count() >= 1
    shot(page, "program-guessed")


def times(page: Page) -> list[tuple[float, float]]:
    """From the change of a diameter to its path on the screen, and what of that the server took [ms]."""
    taken = []
    for i in range(CHANGES):
        known = drawn(page)
        with page.expect_response("**/api/plan", timeout=LONG) as answer:
            field(page, f"{BORE}.diameter").fill(str(180 + (i * 7) % 45 + i / 1000))
        wait_drawn(page, known)
        planned = answer.value.json()
        assert planned["state"] == "done", planned
        taken.append((float(page.evaluate("() => document.documentElement.dataset.drawnMs")), 1000 * planned["seconds"]))
    return sorted(taken)


def looks(browser: Browser, served: Served) -> None:
    """Both themes at three widths: nothing that axe objects to, nothing that scrolls sideways."""
    for theme in ("light", "dark"):
        for width, height in SIZES:
            watched = Watched(browser, (width, height), theme)
            page = watched.opened(served.address)
            open_file(page, "01_bore/job.toml")
            judged(page)
            page.locator(".chart").click(position={"x": width * 0.5, "y": 70})
            page.locator(".stage.now").wait_for()
            shot(page, f"{theme}-{width}")
            clean(page, f"{theme} {width}")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways"
            if width < 1280:
                for name in ("Text", "Program", "Findings", "Form"):
                    page.get_by_role("tab", name=name).click()
                    clean(page, f"{theme} {width} {name}")
            watched.close(served.address)


def pseudo(browser: Browser, served: Served) -> None:
    """No text but names, numbers, units, program text and sentences of the library is outside the catalogue."""
    watched = Watched(browser, (1400, 900), "light")
    page = watched.opened(served.at("lang=pseudo"))
    found = page.evaluate(UNMARKED, MARK)
    page.locator('[data-open="files"]').click()
    found += page.evaluate(UNMARKED, MARK)
    page.get_by_role("menuitem", name="01_bore/job.toml").click()
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    found += page.evaluate(UNMARKED, MARK)
    for section in ("job", "tools", "fixtures", "setup0"):
        page.locator("select.section").select_option(section)
        for i in range(page.locator(".ops li").count()):
            page.locator(".ops li").nth(i).click()
            page.locator("details.more").evaluate_all("all => all.forEach(d => (d.open = true))")
            found += page.evaluate(UNMARKED, MARK)
    box = page.locator(".chart").bounding_box()
    page.mouse.click(box["x"] + box["width"] * 0.5, box["y"] + box["height"] * 0.6)
    page.keyboard.press("F6")
    for key in ("?", "Control+k", "g"):
        page.keyboard.press(key)
        page.locator("dialog[open]").wait_for()
        found += page.evaluate(UNMARKED, MARK)
        page.keyboard.press("Escape")
        page.locator("dialog[open]").wait_for(state="detached")
    shot(page, "pseudo")
    assert not found, sorted(set(found))
    # The text of the catalogue is there at all, and longer.
    assert MARK in page.locator(".bar, .outcome").first.inner_text()
    watched.close(served.address)


def starts(browser: Browser, program: str) -> None:
    """A folder without a job: one sentence and what can be done; the example that it makes is planned."""
    served = Served(program)
    try:
        for name in served.folder.glob("*.toml"):
            name.unlink()
        watched = Watched(browser, (1400, 900), "light")
        page = watched.opened(served.address)
        page.get_by_role("button", name="Open an example").wait_for()
        clean(page, "empty")
        shot(page, "empty")
        page.get_by_role("button", name="Open an example").click()
        assert judged(page) == "SAFE"
        assert (served.folder / "example.toml").exists()
        # The server goes: the text stays.
        known, watched.said = watched.said, []
        assert not known, known
        served.end()
        page.locator(".across.gone").wait_for(timeout=30_000)
        assert "diameter = 40" in text_of(page)
        clean(page, "gone")
        shot(page, "gone")
        page.close()
    finally:
        served.gone()


def files() -> None:
    """The files of the pages are those of their list."""
    assets = Path(__file__).resolve().parents[1] / "dist"
    manifest = json.loads((assets / "manifest.json").read_text())
    for name, digest in manifest["files"].items():
        assert hashlib.sha256((assets / name).read_bytes()).hexdigest() == digest, name


def measured(stage: Stage) -> None:
    taken = times(stage.page)
    own = sorted(all_of_it - server for all_of_it, server in taken)
    print(f"  from a change to the drawn path: {shares([one for one, _ in taken])}; without the server's part: {shares(own)}")
    assert not WEEKLY or taken[int(0.95 * len(taken))][0] <= DRAWN, taken[int(0.95 * len(taken))]


def begin(stage: Stage) -> Page:
    page = stage.watched.opened(stage.served.address)
    open_file(page, "01_bore/job.toml")
    judged(page)
    return page


SCRIPT = Script(
    "the workbench in a browser",
    ("01_bore", "07_external_program", "17_vise_and_clamp"),
    {
        "edits": lambda s: edits(s.page, s.served),
        "completes": lambda s: completes(s.page),
        "mistakes": lambda s: mistakes(s.page),
        "plays": lambda s: plays(s.page),
        "keys": lambda s: keys(s.page),
        "operations": lambda s: operations(s.page),
        "saves": lambda s: saves(s.page, s.served),
        "times": measured,
        "findings": lambda s: findings(s.page),
        "others": lambda s: others(s.page),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
        "starts": lambda s: starts(s.browser, s.program),
    },
    begin,
    always=("closes",),
    plain={"files": files},
)

if __name__ == "__main__":
    SCRIPT.main()
