"""The window of a drilling in a browser, as a person uses it: python3 drill.py KINECUT [STEP ..]. It reads the printed example of Belyakov and
Seleznev 2023 back from the page, which is reached by clicks and keys alone. Needs and settings: common.py."""

from pathlib import Path

from common import LONG, MARK, OUTCOME, SIZES, UNMARKED, Script, Served, Stage, cells, clean, open_file, settled, shell, shot, visited
from playwright.sync_api import Browser, Page

DRILLING = "main.drilling"
KINDS = ["square", "falling", "rising", "shaft", "shaftBeside", "bore", "boreBeside"]
POINTS = [
    "twist", "double-ground", "cast-iron", "rounded-lips", "corner-radius", "thinned-web", "slotted-chisel", "annular", "flat", "cannon", "gun",
    "auger", "ejector", "cone", "centre", "stepped",
]  # fmt: skip
# Figure 7 of the paper: what its window shows.
PRINTED = {
    "L_vr1": "7.907", "L_vr": "9.907", "Z_nvr1": "2.000", "Z_nvr2": "−7.907", "L_vyh1": "7.907", "L_vyh2": "0.501", "Z_nvyh1": "−150.000",
    "Z_nvyh2": "−159.405", "Z_kvyh1": "−100.000", "Z_kvyh2": "−109.405", "T_entry": "1.485", "T_steady": "26.784", "T_exit": "7.091",
    "T_all": "35.360",
}  # fmt: skip
# The same hole, exactly: the point leaves a shaft with its corner where its rim crosses the lowest line, 0.501 later.
EXACT = {
    "L_vr1": "7.907", "L_vr": "9.907", "L_vyh2": "0.000", "L_rx": "161.907", "Z_nvr2": "−7.907", "Z_nvyh1": "−150.000", "Z_nvyh2": "−159.907",
    "Z_kvyh2": "−109.907", "T_entry": "2.490", "T_steady": "26.784", "T_exit": "7.469", "T_all": "36.743",
}  # fmt: skip
TYPED = {
    "tool.diameter": "20", "tool.point.double-ground.point_angle": "118", "tool.point.double-ground.second_angle": "70", "tool.flute_length": "180",
    "operation.exit.radius": "100", "operation.length": "50", "operation.approach": "2", "operation.overrun": "2", "operation.cutting_speed": "25",
    "operation.feed_per_rev.entry": "0.6", "operation.feed_per_rev.steady": "0.8", "operation.feed_per_rev.exit": "0.2",
}  # fmt: skip


def new_drilling(page: Page) -> None:
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name="New drilling").click()
    settled(page, DRILLING)


def field(page: Page, key: str):
    return page.locator(f'[data-key="{key}"] input').first


def pair(page: Page, entry: str, leave: str):
    return page.locator(f'[data-pair="{entry} {leave}"]')


def verb(program: str, text: str) -> dict:
    """The answer of the command line to the same text."""
    return shell(program, "drill", "-", "--paper", "--load", text=text)


def type_the_paper(page: Page) -> dict:
    """The paper's example by clicks and keys; the last answer of the server."""
    pair(page, "square", "shaft").click()
    page.locator('button[data-point="double-ground"]').click()
    asked: list = []

    def hear(response) -> None:
        if response.url.endswith("/api/verb/drill"):
            asked.append(response)

    page.on("response", hear)
    for key, value in TYPED.items():
        field(page, key).fill(value)
    assert settled(page, DRILLING) == "done"
    page.remove_listener("response", hear)
    return asked[-1].json()


def paper(page: Page, served: Served, program: str) -> None:
    """The printed example, number by number; and each number that is shown is the verb's."""
    page.locator('[data-open="new"]').focus()
    page.keyboard.press("Enter")
    page.locator('[data-new="drilling"]').focus()
    page.keyboard.press("Enter")
    settled(page, DRILLING)
    answer = type_the_paper(page)
    assert page.locator("h1").inner_text() == "Hole ⌀20, into a square face, out of a shaft"
    # The curve is read at some places: what it says is between the library's numbers.
    load = answer["holes"][0]["load"]
    whole = load["way"][-1]
    for share in (0.01, 0.03, 0.05, 0.5, 0.96, 0.98):
        page.locator(".travel input").evaluate("(e, v) => { e.value = v; e.dispatchEvent(new Event('input', { bubbles: true })); }", str(round(1000 * share)))
        at = whole * share
        i = next(k for k, x in enumerate(load["way"]) if x >= at)
        (a, b), (u, v) = load["way"][i - 1 : i + 1], load["share"][i - 1 : i + 1]
        wanted = u + (v - u) * (at - a) / (b - a) if b > a else v
        page.wait_for_function("want => document.querySelector('svg.load')?.textContent.includes(want)", arg=f"{wanted:.2f} in material", timeout=5000)
    page.get_by_role("button", name="All places").click()
    printed = cells(page, "paper", 3)
    assert {key: printed[key] for key in PRINTED} == PRINTED, printed
    exact = cells(page, "paper", 1)
    assert {key: exact[key] for key in EXACT} == EXACT, exact
    differs = page.locator('[data-table="paper"] td.differs').count()
    assert differs == 7 + 6, differs

    zones = {c: cells(page, "zones", c) for c in range(1, 6)}
    assert zones[1] == {"entry": "2.000", "steady": "−7.907", "exit": "−150.000", "all": "2.000"}, zones[1]
    assert zones[2] == {"entry": "−7.907", "steady": "−150.000", "exit": "−159.907", "all": "−159.907"}, zones[2]
    assert zones[5] == {"entry": "2.490", "steady": "26.784", "exit": "7.469", "all": "36.743"}, zones[5]
    assert cells(page, "zeros", 2) == {"start": "52.000", "full": "42.093", "through": "−100.000", "end": "−109.907"}
    assert page.locator('[data-fact="time"] dd').inner_text().startswith("36.74 s")
    assert page.locator('[data-fact="saved"] dd').inner_text().startswith("85.33 s")
    blocks = page.locator(".nc").inner_text()
    for block in ("N120 G95 G1 Z-7.9067 F0.6", "N130 Z-150 F0.8", "N140 Z-159.9067 F0.2"):
        assert block in blocks, blocks
    assert "SAFE HEIGHT" in blocks and page.locator(".blocks .small-print").count() == 1
    assert page.locator("svg.cut").get_attribute("data-point") == "7.907"
    shot(page, "drill-paper")

    # The file that is saved holds these numbers, and the command line answers to it what the page has shown.
    page.keyboard.press("Control+s")
    page.locator(".tab.on .dot").wait_for(state="detached")
    text = (served.folder / "drilling.toml").read_text()
    assert settled(page, DRILLING) == "done" and page.title() == "drilling.toml"
    assert verb(program, text) == answer, "the page shows another plan than the verb's"
    assert cells(page, "paper", 3)["T_all"] == "35.360"


def pairs(page: Page, program: str) -> None:
    """All surfaces into all, and blind: each is planned and drawn, and is what the command line answers."""
    new_drilling(page)
    answers: dict = {}
    compared: set[str] = set()
    page.on("response", hear := lambda r: r.url.endswith("/api/verb/drill") and answers.update({r.request.post_data_json["text"]: r}))
    for entry in KINDS:
        for leave in [*KINDS, "blind"]:
            pair(page, entry, leave).click()
            assert settled(page, DRILLING) == "done", (entry, leave, page.locator(".across.wrong").all_inner_texts())
            # The first pair is what the window begins with.
            for text in answers.keys() - compared:
                assert answers[text].json() == verb(program, text), (entry, leave)
                compared.add(text)
            assert pair(page, entry, leave).get_attribute("aria-checked") == "true", (entry, leave)
            assert page.locator('.matrix [role="radio"][aria-checked="true"]').count() == 1
            assert page.locator("svg.cut").count() == 1, (entry, leave)
            labels = page.locator(".strip label").all_inner_texts()
            cylinder = any(kind.startswith(("shaft", "bore")) for kind in (entry, leave))
            assert any("radius" in name for name in labels) == cylinder, (entry, leave, labels)
            assert ("Depth, full diameter" in " ".join(labels)) == (leave == "blind"), labels
    page.remove_listener("response", hear)
    assert len(compared) >= len(KINDS) * (len(KINDS) + 1) - 1, len(compared)
    shot(page, "drill-blind")


def points(page: Page, program: str) -> None:
    """All points: each is planned, and drawn with the length that the library gives."""
    new_drilling(page)
    for kind in POINTS:
        with page.expect_response("**/api/verb/drill") as response:
            page.locator(f'button[data-point="{kind}"]').click() if kind != "twist" else field(page, "tool.diameter").fill("12")
        assert settled(page, DRILLING) == "done", (kind, page.locator(".across.wrong").all_inner_texts())
        assert page.locator(f'button[data-point="{kind}"]').get_attribute("aria-checked") == "true"
        length = response.value.json()["holes"][0]["lengths"]["L_vr1"]
        drawn = float(page.locator("svg.cut").get_attribute("data-point"))
        assert abs(drawn - length) < 1e-3, (kind, drawn, length)
    # A number of the second stage of a list has a field of its own.
    field(page, "tool.point.stepped.stages[0].length").fill("11")
    assert settled(page, DRILLING) == "done"
    shot(page, "drill-stepped")


def mistakes(page: Page) -> None:
    """A mistake is shown at its field; numbers that are older are marked; the plan is back with the right number."""
    new_drilling(page)
    type_the_paper(page)
    before = cells(page, "zones", 5)
    field(page, "operation.exit.radius").fill("5")
    assert settled(page, DRILLING) == "wrong"
    # The library counts the distance from the axis as wrong, which has no field before.
    told = page.locator(".strip .told")
    assert told.count() == 1 and told.inner_text() in page.locator(".across.wrong").inner_text()
    assert "opens sideways" in told.inner_text()
    assert field(page, "operation.exit.offset").get_attribute("aria-invalid") == "true"
    assert page.locator(".oldness").count() == 1 and cells(page, "zones", 5) == before
    assert page.locator('[data-act="job"]').is_disabled()
    clean(page, "mistake")
    shot(page, "drill-mistake")
    page.locator(".across.wrong button").click()
    assert page.evaluate("() => document.activeElement.id") == "f-operation.exit.offset"
    field(page, "operation.exit.radius").fill("100")
    assert settled(page, DRILLING) == "done" and page.locator(".oldness, .across.wrong, .told").count() == 0
    # Also where the field is there already.
    field(page, "operation.length").focus()
    page.keyboard.press("Control+a")
    page.keyboard.type("-200")
    assert settled(page, DRILLING) == "wrong" and page.locator('[data-key="operation.length"] .told').count() == 1
    page.keyboard.press("Control+a")
    page.keyboard.type("50")
    assert settled(page, DRILLING) == "done"
    field(page, "operation.exit.radius").fill("wide")
    page.keyboard.press("Enter")
    assert page.locator('[data-key="operation.exit.radius"] .told').count() == 1
    field(page, "operation.exit.radius").fill("25*4")
    page.keyboard.press("Enter")
    assert settled(page, DRILLING) == "done" and cells(page, "zones", 5) == before
    # The newest of many changes counts.
    for n in range(30):
        field(page, "tool.diameter").fill(f"{15 + n / 10}")
    assert settled(page, DRILLING) == "done"
    assert page.locator("svg.cut .size text").first.text_content() == "⌀ 17.9"
    assert page.locator("h1").inner_text().startswith("Hole ⌀17.9")


def hands(page: Page) -> None:
    """By keys alone; by dragging; with undo."""
    new_drilling(page)
    pair(page, "square", "square").focus()
    page.keyboard.press("ArrowDown")
    page.wait_for_function("() => document.activeElement.dataset.pair === 'falling square'")
    page.keyboard.press("ArrowRight")
    page.wait_for_function("() => document.activeElement.dataset.pair === 'falling falling'")
    assert settled(page, DRILLING) == "done" and field(page, "operation.entry.inclination").input_value() == "-10"
    page.locator('button[data-point="twist"]').focus()
    for name in ("double-ground", "corner-radius"):
        page.keyboard.press("ArrowRight" if name == "double-ground" else "ArrowDown")
        # One row down is four pictures on.
        wanted = "double-ground" if name == "double-ground" else "thinned-web"
        page.wait_for_function("wanted => document.activeElement.dataset.point === wanted", arg=wanted)
    assert settled(page, DRILLING) == "done"
    for _ in range(12):
        page.keyboard.press("Control+z")
    assert settled(page, DRILLING) == "done"
    assert pair(page, "square", "square").get_attribute("aria-checked") == "true"
    assert page.locator('button[data-point="twist"]').get_attribute("aria-checked") == "true"
    page.keyboard.press("Control+y")
    assert settled(page, DRILLING) == "done"
    assert pair(page, "square", "square").get_attribute("aria-checked") == "false"
    page.keyboard.press("Control+z")
    settled(page, DRILLING)

    # The drill is drawn where one drags it; the slider does the same by keys; both mark the zone.
    box = page.locator("svg.cut").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 80)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] - 60, steps=4)
    page.mouse.up()
    low = float(page.locator("output.at").get_attribute("data-at"))
    assert low < -30 and page.locator("svg.cut .drill.now").get_attribute("data-z") == f"{low:.3f}"
    assert page.locator('[data-table="zones"] tr.on').get_attribute("data-row") == "exit"
    page.locator(".travel input").focus()
    page.keyboard.press("Home")
    assert page.locator("output.at").get_attribute("data-at") == "2.000"
    assert page.locator('[data-table="zones"] tr.on').get_attribute("data-row") == "entry"
    page.locator(".travel [data-play]").click()
    page.wait_for_function("() => Number(document.querySelector('output.at').dataset.at) < 1", timeout=LONG)
    page.locator(".travel [data-play]").click()
    shot(page, "drill-at")
    page.get_by_role("button", name="All places").click()
    assert page.locator("svg.cut .drill.now").count() == 0

    # The share of the point in material, and the library's own drawings.
    page.locator("[data-drawings]").wait_for(timeout=LONG)
    load = page.locator("svg.load")
    area = load.bounding_box()
    page.mouse.click(area["x"] + area["width"] / 2, area["y"] + 60)
    assert "1.00 in material" in load.text_content()
    count = int(page.locator("[data-drawings]").get_attribute("data-drawings"))
    assert count == 4, count
    for i in range(count):
        page.locator("[data-drawings]").select_option(str(i))
        image = page.locator(".figures img.wide")
        page.wait_for_function("() => document.querySelector('.figures img.wide').complete")
        assert image.evaluate("i => i.naturalWidth") > 100 and len(image.get_attribute("alt")) > 5
    shot(page, "drill-library")
    page.locator("[data-drawings]").select_option("-1")


def leaves(page: Page, served: Served) -> None:
    """The numbers go into a job: as an operation by copying, as a file of a job, as a sheet."""
    new_drilling(page)
    type_the_paper(page)
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.locator('[data-act="copy"]').click()
    page.locator('[data-act="copy"]', has_text="Copied.").wait_for()
    copied = page.evaluate("() => navigator.clipboard.readText()")
    assert copied.startswith("[[tool]]\n") and "[[setup.operation]]\ntype = \"drill\"\n" in copied and "points = [[0, 0]]" in copied, copied
    assert 'exit = { surface = "outer-cylinder", radius = 100 }' in copied
    page.locator('[data-act="sheet"]:enabled').wait_for(timeout=LONG)
    with page.expect_download() as download:
        page.locator('[data-act="sheet"]').click()
    assert "<!DOCTYPE html>" in Path(download.value.path()).read_text()[:20]
    known = {f.name for f in served.folder.glob("*.toml")}
    page.locator('[data-act="job"]').click()
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    made = {f.name for f in served.folder.glob("*.toml")} - known
    assert len(made) == 1 and made.pop().endswith("-job.toml")
    # It is a job that plans: its drill, its stock which the text calls a guess.
    assert page.locator(".pprog .l").count() > 5
    assert page.locator(".cm-content").inner_text().startswith("# From a drilling")
    shot(page, "drill-job")


def opens(page: Page) -> None:
    """Questions of the folder open in the window: with a mesh, and with comments that stay."""
    open_file(page, "03_drill_through_shaft/figure_7.toml")
    assert settled(page, DRILLING) == "done" and cells(page, "paper", 3)["T_all"] == "35.360"
    assert page.locator(".tab.on .dot").count() == 0
    open_file(page, "03_drill_through_shaft/housing.toml")
    page.wait_for_function("() => document.title.includes('housing')")
    assert settled(page, DRILLING) == "done", page.locator(".across.wrong").all_inner_texts()
    assert "mesh" in page.locator(".matrix .chosen").inner_text()
    shot(page, "drill-mesh")


def several(page: Page, served: Served) -> None:
    """Several holes with one drill: each by itself; one that cannot be drilled says so, the others stay."""
    text = (served.folder / "03_drill_through_shaft/figure_7.toml").read_text()
    places = text.replace("tool = 1\n", "tool = 1\npoints = [[0, 0], [0, 30], [0, 95]]\n").replace("overrun = 2\n", "overrun = 2\ncross_bore = [{ diameter = 12, z = -60 }]\n")
    assert places.count("\n") == text.count("\n") + 2
    path = served.folder / "several.toml"
    path.write_text(places)
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name="several.toml").wait_for(timeout=LONG)
    page.get_by_role("menuitem", name="several.toml").click()
    page.wait_for_function("() => document.title.includes('several')")
    assert settled(page, DRILLING) == "done"
    # The bore on the way has a zone of its own, in which the drill goes in and out at once.
    assert "mixed" in cells(page, "zones", 5) and page.locator(".drawing .small-print").count() == 1
    which = page.locator(".drilling .head select")
    assert which.locator("option").count() == 2
    first = cells(page, "zones", 2)["exit"]
    which.select_option("1")
    page.wait_for_function("was => document.querySelector('[data-table=zones] [data-row=exit]').cells[2].textContent !== was", arg=first)
    told = page.locator(".findings .bad").inner_text()
    assert told.startswith("Hole 3 of 3:") and "opens sideways" in told, told
    shot(page, "drill-several")


def looks(browser: Browser, served: Served) -> None:
    """Both themes at three widths: nothing that axe objects to, nothing that scrolls sideways."""
    for theme in ("light", "dark"):
        for width, height in SIZES:
            one, page = visited(browser, (width, height), theme, served.address)
            open_file(page, "03_drill_through_shaft/figure_7.toml")
            settled(page, DRILLING)
            page.locator("[data-drawings]").wait_for(timeout=LONG)
            shot(page, f"drill-{theme}-{width}")
            clean(page, f"{theme} {width}")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways"
            page.locator("details.rest").evaluate("e => (e.open = true)")
            page.locator(".travel input").focus()
            page.keyboard.press("End")
            page.locator("[data-drawings]").select_option("1")
            clean(page, f"{theme} {width}, all open")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways, all open"
            one.close(served.address)


def pseudo(browser: Browser, served: Served) -> None:
    """No text but names, numbers, units, program text and sentences of the library is outside the catalogue."""
    one, page = visited(browser, (1400, 900), "light", served.at("lang=pseudo"))
    page.locator('[data-open="new"]').click()
    page.locator('[data-new="drilling"]').click()
    settled(page, DRILLING)
    found = page.evaluate(UNMARKED, MARK)
    page.locator("details.rest").evaluate("e => (e.open = true)")
    page.locator("details.more").evaluate_all("all => all.forEach(d => (d.open = true))")
    for entry, leave in (("falling", "shaftBeside"), ("boreBeside", "blind"), ("shaft", "bore")):
        pair(page, entry, leave).click()
        settled(page, DRILLING)
        found += page.evaluate(UNMARKED, MARK)
    for kind in POINTS:
        page.locator(f'button[data-point="{kind}"]').click()
        settled(page, DRILLING)
        found += page.evaluate(UNMARKED, MARK)
    page.locator(".travel input").focus()
    page.keyboard.press("End")
    found += page.evaluate(UNMARKED, MARK)
    field(page, "tool.diameter").fill("0")
    assert settled(page, DRILLING) == "wrong"
    found += page.evaluate(UNMARKED, MARK)
    shot(page, "drill-pseudo")
    assert not found, sorted(set(found))
    assert MARK in page.locator(".matrix h2").inner_text()
    one.close(served.address)


SCRIPT = Script(
    "the window of a drilling",
    ("03_drill_through_shaft",),
    {
        "paper": lambda s: paper(s.page, s.served, s.program),
        "pairs": lambda s: pairs(s.page, s.program),
        "points": lambda s: points(s.page, s.program),
        "mistakes": lambda s: mistakes(s.page),
        "hands": lambda s: hands(s.page),
        "leaves": lambda s: leaves(s.page, s.served),
        "opens": lambda s: opens(s.page),
        "several": lambda s: several(s.page, s.served),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    lambda s: s.watched.opened(s.served.address),
    always=("closes",),
)

if __name__ == "__main__":
    SCRIPT.main()
