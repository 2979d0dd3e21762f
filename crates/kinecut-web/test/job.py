"""The window of a job, as a person uses it beyond browser.py: python3 job.py KINECUT [STEP...]. Times while one types, operations in program
and time, measuring, operations made of picked faces, findings in the picture, files from elsewhere. Needs and settings:
common.py."""

import base64
import math
import re
import struct
import tomllib

from browser import begin as bore
from browser import drawn, field, text_of, wait_drawn
from common import EXAMPLES, LONG, MARK, OUTCOME, SIZES, UNMARKED, Script, Served, Stage, Watched, clean, judged, kept_back, open_file, painted, shot, still
from playwright.sync_api import Browser, Page

BORE = "setup[0].operation[0]"
SMALL = """format = 1
stock = { box = { min = [0, 0, -10], max = [40, 30, 0] } }
post = { control = "linuxcnc" }
tool = [{ number = 1, name = "drill D8", type = "drill", diameter = 8, point_angle = 118, flute_length = 40, teeth = 2 }]
[[setup]]
offset = "G54"
[[setup.operation]]
type = "drill"
tool = 1
points = [[10, 10], [30, 10]]
top = 0
depth = 6
speed = 1000
feed_per_rev = { steady = 0.1 }
"""
SLOT = "(T1 D=6. CR=0. - FLAT END MILL)\nG21 G90 G54\nT1 M6\nG43\nS3000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nG0 Z5\nM2\n"
FEEDS = "at programmed feeds"


def number(text: str) -> float:
    return float(text.replace("\u2212", "-"))


def longest(page: Page) -> int:
    """End of the time line [s]."""
    return int(page.locator(".chart").get_attribute("aria-valuemax"))


def feeds(page: Page) -> None:
    """A plan while one types has the times of the programmed feeds, and says so; those of the machine come with the simulation."""
    judged(page)
    assert page.locator(".clock .feeds").count() == 0
    known = drawn(page)
    with page.expect_response("**/api/simulate", timeout=LONG) as simulated, page.expect_response("**/api/plan", timeout=LONG) as planned:
        with kept_back(page, "**/api/simulate"):
            field(page, f"{BORE}.diameter").fill("196")
            wait_drawn(page, known)
            assert page.locator(".clock .feeds").inner_text() == FEEDS
            quick = longest(page)
    assert planned.value.request.post_data_json["quick"] is True
    assert quick == round(planned.value.json()["plan"]["setups"][0]["time"])
    under_limits = simulated.value.json()["plan"]["setups"][0]["time"]
    page.locator(".clock .feeds").wait_for(state="detached", timeout=LONG)
    assert judged(page) == "SAFE"
    assert longest(page) == round(under_limits) > quick, (longest(page), under_limits, quick)
    # A machine without limits: the times stay those of the feeds, and that is said after the simulation too.
    page.locator(".cm-line", has_text="dynamics = ").click()
    page.keyboard.press("Home")
    page.keyboard.type("# ")
    page.wait_for_function("() => document.querySelector('.outcome').dataset.state !== 'safe'")
    judged(page)
    assert page.locator(".clock .feeds").inner_text() == FEEDS
    page.keyboard.press("Control+z")
    for _ in range(30):
        if not page.locator(".tab.on .dot").count():
            break
        page.keyboard.press("Control+z")
    judged(page)


def operations(page: Page) -> None:
    """Bands of operations in time, their lines in the program, and the form: one selection."""
    with page.expect_response("**/api/plan", timeout=LONG) as answer:
        open_file(page, "21_plate_by_sizes/job.toml")
    planned = answer.value.json()
    judged(page, "21_plate_by_sizes/job.toml")
    runs = planned["operations"]
    lines = planned["programs"][0]["text"].split("\n")
    asked = tomllib.loads(text_of(page))["setup"][0]["operation"]
    bands = page.locator("[data-band]")
    keys = bands.evaluate_all("all => all.map(b => b.dataset.band)")
    # Eleven operations of the job, seven of the text: the bands are those of the text.
    assert len(keys) == len(runs) > len(asked), (keys, runs)
    assert sorted(set(keys)) == [f"setup[0].operation[{i}]" for i in range(len(asked))], keys
    titles = bands.locator("title").evaluate_all("all => all.map(t => t.textContent)")
    for key, run, title in zip(keys, runs, titles):
        assert title == f"{int(re.findall(r'[0-9]+', key)[1]) + 1} {run['title']}, T{run['tool']}", (key, title)
    # The M8 is tapped in the last of its runs: a click on the line of the cycle shows the operation in the form.
    tap = max(i for i, key in enumerate(keys) if asked[int(re.findall(r"\d+", key)[1])].get("size") == "M8")
    line = runs[tap]["from"] + 2
    page.locator(".pprog .code").focus()
    page.keyboard.press("g")
    page.locator("dialog input").fill(str(line))
    page.keyboard.press("Enter")
    page.locator(f'.pprog .l.on[data-line="{line - 1}"]').wait_for()
    page.locator(f'.pprog .l[data-line="{line}"]').click()
    page.wait_for_function("key => document.querySelector('.ops li[aria-selected=true]')?.id === `item-${key}`", arg=keys[tap])
    marked = page.locator(".pprog .l.block").evaluate_all("all => all.map(l => Number(l.dataset.line))")
    shown = page.locator(".pprog .rows .l").evaluate_all("all => all.map(l => Number(l.dataset.line))")
    assert marked == [l for l in shown if runs[tap]["from"] <= l < runs[tap]["to"]] and len(marked) > 2, (marked, runs[tap])
    texts = page.locator(".pprog .l.block > span").all_inner_texts()
    assert [text.rstrip() for text in texts] == [lines[l].rstrip() for l in marked]
    assert page.locator(".band.on").evaluate_all("all => all.map(b => b.dataset.band)") == [keys[tap]]
    shot(page, "operations")
    # The form leads to the program: the first line of the pocket comes into sight, the cursor stays.
    before = page.locator(".pprog .l.on i").inner_text() if page.locator(".pprog .l.on").count() else ""
    pocket = next(i for i, o in enumerate(asked) if o["type"] == "pocket")
    page.locator(".ops li").nth(pocket).click()
    first = next(run["from"] for key, run in zip(keys, runs) if key == f"setup[0].operation[{pocket}]")
    page.locator(f'.pprog .l.in[data-line="{first}"]').wait_for()
    now = page.locator(".pprog .l.on i").all_inner_texts()
    assert now in ([], [before])
    # A band leads to both.
    bands.nth(0).click()
    page.wait_for_function("key => document.querySelector('.ops li[aria-selected=true]')?.id === `item-${key}`", arg=keys[0])
    open_file(page, "01_bore/job.toml")
    page.wait_for_function("() => document.title.includes('01_bore')")


def scale(page: Page) -> float:
    """Pixels for a millimetre, by the scale bar."""
    path = page.locator(".overlay .scale").get_attribute("d")
    length = page.locator(".overlay text").last.text_content()
    mm = float(length.split()[0]) * (0.001 if "µm" in length else 1)
    return float(re.search(r"h([\d.]+)", path).group(1)) / mm


def xyz(page: Page, which: int) -> list[float]:
    told = page.locator(".measured .xyz").nth(which).inner_text()
    return [number(n) for n in re.findall(r"[\u2212\d.]+", told)]


def rows(page: Page) -> dict[str, str]:
    return dict(page.locator(".measured dl div").evaluate_all("all => all.map(d => [d.querySelector('dt').textContent, d.querySelector('dd').textContent])"))


def dark(page: Page, x: float, y: float) -> float:
    """Share of dark pixels in a square of the picture: a hatch has some, a plain face none."""
    side = 24
    picture = page.screenshot(clip={"x": x - side / 2, "y": y - side / 2, "width": side, "height": side})
    return page.evaluate(
        """async packed => {
          const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0));
          const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
          const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
          const context = canvas.getContext("2d");
          context.drawImage(bitmap, 0, 0);
          const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
          const light = Array.from({ length: data.length / 4 }, (_, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2]);
          const usual = [...light].sort((a, b) => a - b)[light.length >> 1];
          return light.filter(n => n < 0.85 * usual).length / light.length;
        }""",
        base64.b64encode(picture).decode(),
    )


def measures(page: Page) -> None:
    """Two places on the plate: their distance by the scale bar; the wall of the bore by its diameter; a bore made of it."""
    assert judged(page) == "SAFE"
    page.locator(".time h2").evaluate("() => document.activeElement.blur()")
    page.keyboard.press("2")
    page.keyboard.press("m")
    page.locator('[data-measure="on"]').wait_for()
    box = page.locator(".stage canvas").bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    by = 115 * scale(page)
    page.mouse.click(middle[0] - by, middle[1] + by)
    assert "plane at Z 0.000" in page.locator(".measured").inner_text()
    a = xyz(page, 0)
    assert max(abs(a[0] + 115), abs(a[1] + 115), abs(a[2])) < 0.6, a
    page.mouse.click(middle[0] + by, middle[1] + by)
    page.locator(".measured dl").wait_for()
    b, told = xyz(page, 1), rows(page)
    distance = number(told["Distance"].split()[0])
    assert abs(distance - 230) < 1 and abs(distance - math.dist(a, b)) < 0.002, (told, a, b)
    assert abs(number(told["dX"].split()[0]) - (b[0] - a[0])) < 0.0011 and told["Between the planes"] == "0.000 mm", told
    # Along a face nothing is known of the material.
    assert "In material" not in told, told
    # The marks lie where the clicks were.
    for mark, way in zip(page.locator(".marks .pick").all(), (-1, 1)):
        x, y = map(float, re.findall(r"[\d.]+", mark.get_attribute("transform")))
        assert math.hypot(x - box["width"] / 2 - way * by, y - box["height"] / 2 - by) < 1.5, mark.get_attribute("transform")
    shot(page, "measure")
    clean(page, "measure")

    # Cut open, seen from the front, the wall of the bore is in the middle: Enter picks it.
    page.locator(".stage canvas").focus()
    page.keyboard.press("3")
    page.keyboard.press("x")
    page.locator(".tools .section").wait_for()
    page.locator(".stage canvas").focus()
    page.keyboard.press("Enter")
    said = page.locator(".measured").inner_text()
    wall = re.search(r"wall of a round hole, ⌀([\d.]+) at X (\S+) Y (\S+), from Z (\S+) to (\S+), corners within ([\d.]+) mm", said)
    assert wall, said
    diameter, x, y, bottom, top, off = map(number, wall.groups())
    assert abs(diameter - 200) < 0.2 and max(abs(x), abs(y)) < 0.1 and abs(bottom + 30) < 0.2 and abs(top) < 0.2 and off < 0.2, wall.groups()
    shot(page, "measure-wall")
    # The plate is cut at both sides of the bore, the wall between them is not.
    page.locator('[data-show="path"]').first.uncheck()
    page.locator(".stage canvas").hover(position={"x": 5, "y": 5})
    open_box = page.locator(".stage canvas").bounding_box()
    side, height = 115 * scale(page), open_box["y"] + open_box["height"] / 2
    centre = open_box["x"] + open_box["width"] / 2
    assert dark(page, centre - side, height) > 0.05 and dark(page, centre + side, height) > 0.05
    assert dark(page, centre + 0.4 * side, height) < 0.02, dark(page, centre + 0.4 * side, height)
    page.locator('[data-show="path"]').first.check()
    before = text_of(page)
    page.get_by_role("button", name="Make a bore operation of it").click()
    page.wait_for_function("() => document.querySelector('.ops li[aria-selected=true]')?.id === 'item-setup[0].operation[1]'")
    made = tomllib.loads(text_of(page))["setup"][0]["operation"][1]
    assert (made["type"], made["tool"], made["diameter"], made["depth"]) == ("bore", 1, diameter, round(top - bottom, 3)), made
    assert [round(n, 3) for n in made["at"]] == [x, y] and made["top"] == top, made
    assert text_of(page).startswith(before.rstrip("\n"))
    shot(page, "measure-made")
    page.get_by_role("button", name="Undo", exact=True).first.click()
    assert text_of(page) == before
    judged(page)

    # A level face becomes a face operation at its height.
    page.locator(".stage canvas").focus()
    page.keyboard.press("x")
    page.keyboard.press("2")
    page.mouse.click(middle[0] - by, middle[1] + by)
    page.get_by_role("button", name="Make a face operation of it").last.click()
    made = tomllib.loads(text_of(page))["setup"][0]["operation"][1]
    assert (made["type"], made["top"], made["outline"]) == ("face", 0, "top") and made["depth"] > 0, made
    page.get_by_role("button", name="Undo", exact=True).first.click()
    assert text_of(page) == before
    # A side of the plate is none for a tool along Z.
    judged(page)
    page.keyboard.press("3")
    page.locator(".stage canvas").focus()
    page.keyboard.press("Enter")
    assert "plane at Y \u2212130.000" in page.locator(".measured").inner_text()
    assert page.locator(".measured button:not(.icon)").count() == 0
    page.get_by_role("button", name="End measuring").click()
    assert page.locator(".measured, .marks .pick").count() == 0
    page.keyboard.press("1")


def inspects(page: Page) -> None:
    """Through a plate from side to side: the server tells the material between, the planes their distance."""
    open_file(page, "small.toml")
    judged(page, "small.toml")
    page.locator('[data-measure="off"]').click()
    page.locator(".stage canvas").focus()
    page.keyboard.press("3")
    page.keyboard.press("Enter")
    assert "plane at Y 0.000" in page.locator(".measured").inner_text()
    # Half a turn.
    for _ in range(24):
        page.keyboard.press("ArrowRight")
    with page.expect_response("**/api/inspect") as answer:
        page.keyboard.press("Enter")
    found = answer.value.json()["measures"][0]
    page.locator(".measured dl div", has_text="In material").wait_for()
    told = rows(page)
    assert "plane at Y 30.000" in page.locator(".measured").inner_text()
    assert told["Distance"] == told["Between the planes"] == "30.000 mm", told
    material = [s for s in found["stretches"] if s["material"]]
    told_material = re.fullmatch(r"([\d.]+) mm, within ([\d.]+) mm", told["In material"])
    assert abs(number(told_material.group(1)) - sum(s["length"] for s in material)) < 0.0006, (told, found)
    assert abs(number(told_material.group(1)) - 30) <= number(told_material.group(2)), told
    page.keyboard.press("m")
    page.keyboard.press("1")


def drop(page: Page, name: str, content: bytes) -> None:
    """Drags a file over the page and drops it."""
    page.evaluate(
        """([name, packed]) => {
          const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0));
          const data = window.dropped = new DataTransfer();
          data.items.add(new File([bytes], name));
          document.body.dispatchEvent(new DragEvent("dragenter", { dataTransfer: data, bubbles: true }));
        }""",
        [name, base64.b64encode(content).decode()],
    )
    page.locator(".dropzone").wait_for()
    page.evaluate("() => document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: window.dropped, bubbles: true, cancelable: true }))")
    page.locator(".dropzone").wait_for(state="detached")


def block(low: list[float], high: list[float]) -> bytes:
    """A block as a binary STL, which is no text."""
    corners = [[(high if i >> k & 1 else low)[k] for k in range(3)] for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    packed = b"".join(struct.pack("<12fH", 0, 0, 0, *(v for i in t for v in corners[i]), 0) for t in triangles)
    return b"\xff" + bytes(79) + struct.pack("<I", len(triangles)) + packed


def rod(axis: tuple[float, float, float], radius: float, length: float, sides: int = 120) -> bytes:
    """A round rod about zero as a binary STL."""
    u = (axis[2], 0, -axis[0]) if axis[1] == 0 else (axis[1], -axis[0], 0)
    u = tuple(n / math.hypot(*u) for n in u)
    v = tuple(axis[(k + 1) % 3] * u[(k + 2) % 3] - axis[(k + 2) % 3] * u[(k + 1) % 3] for k in range(3))

    def at(side: int, end: float, r: float) -> tuple[float, ...]:
        a = 2 * math.pi * (side % sides) / sides
        return tuple(axis[k] * end * length / 2 + r * (u[k] * math.cos(a) + v[k] * math.sin(a)) for k in range(3))

    triangles = []
    for i in range(sides):
        a, b, c, d = at(i, -1, radius), at(i + 1, -1, radius), at(i + 1, 1, radius), at(i, 1, radius)
        triangles += [(a, b, c), (a, c, d), (at(0, -1, 0), b, a), (at(0, 1, 0), d, c)]
    packed = b"".join(struct.pack("<12fH", 0, 0, 0, *(n for corner in t for n in corner), 0) for t in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + packed


def rounds(page: Page, served: Served) -> None:
    """Round walls of simulated rods that lie along X, and askew: axis and diameter; no bore is made of them."""
    for name, axis in (("lying", (1, 0, 0)), ("askew", (0.6, 0, 0.8))):
        (served.folder / f"{name}.stl").write_bytes(rod(axis, 12, 60))
        drilled = SMALL.replace("[[10, 10], [30, 10]]", "[[0, 0]]").replace("top = 0", "top = 12").replace("depth = 6", "depth = 2")
        text = drilled.replace(re.search(r"stock = .*", drilled).group(), f'simulate = {{ step = 0.3 }}\nstock = {{ mesh = "{name}.stl" }}')
        (served.folder / f"{name}.toml").write_text(text)
    # The folder is read again: these files are new.
    page.reload()
    for name, axis in (("lying", (1, 0, 0)), ("askew", (0.6, 0, 0.8))):
        open_file(page, f"{name}.toml")
        judged(page, f"{name}.toml")
        page.locator("[data-measure]").click()
        page.locator(".measured").wait_for()
        page.locator(".stage canvas").focus()
        page.keyboard.press("3")
        painted(page)
        page.keyboard.press("Enter")
        page.locator(".measured .xyz").wait_for()
        still(page)
        said = page.locator(".measured").inner_text()
        wall = re.search(r"round wall, ⌀([\d.]+) along (X|\(.*?\)) about X (\S+) Y (\S+) Z (\S+), ([\d.]+) mm long, corners within ([\d.]+) mm", said)
        assert wall, said
        diameter, x, y, z, long, off = map(number, (wall.group(1), *wall.groups()[2:]))
        # The sides of the mesh lie within its circle by 0.004 mm.
        assert abs(diameter - 24) < 0.02 and max(abs(x), abs(y), abs(z)) < 0.02 and abs(long - 60) < 0.1 and off < 0.05, wall.groups()
        told = [number(n) for n in re.findall(r"[\u2212\d.]+", wall.group(2))] if wall.group(2) != "X" else [1, 0, 0]
        assert math.dist(told, axis) < 1e-3, wall.group(2)
        assert page.get_by_role("button", name="Make a bore").count() == 0
        shot(page, f"measure-{name}")
        page.keyboard.press("m")


def drops(page: Page, served: Served) -> None:
    """Files from elsewhere: a job and a program are opened, a mesh and a drawing go to the open job, others are told."""
    drop(page, "mine.toml", SMALL.encode())
    assert judged(page, "mine.toml") == "SAFE" and (served.folder / "mine.toml").read_text() == SMALL

    mesh = block([0, 0, -10], [40, 30, 0])
    drop(page, "wanted.stl", mesh)
    page.get_by_role("button", name="The wanted part").wait_for()
    shot(page, "drop-offered")
    clean(page, "offered")
    assert (served.folder / "wanted.stl").read_bytes() == mesh
    page.get_by_role("button", name="The wanted part").click()
    assert tomllib.loads(text_of(page))["design"]["mesh"] == "wanted.stl"
    # The two holes are no part of it.
    assert judged(page) == "NOT SAFE"
    page.keyboard.press("Control+z")
    drop(page, "wanted.stl", mesh)
    page.get_by_role("button", name="The raw stock").click()
    assert tomllib.loads(text_of(page))["stock"] == {"mesh": "wanted.stl"}
    assert judged(page) == "SAFE"
    assert [f.name for f in served.folder.glob("wanted*")] == ["wanted.stl"]
    drop(page, "wanted.stl", block([0, 0, -10], [40, 31, 0]))
    page.get_by_role("button", name="The raw stock").wait_for()
    assert sorted(f.name for f in served.folder.glob("wanted*")) == ["wanted-2.stl", "wanted.stl"]
    page.locator(".across").get_by_role("button", name="Close the message").click()

    drawing = next((EXAMPLES / "04_gear_pump_cover").glob("*.dxf"))
    drop(page, drawing.name, drawing.read_bytes())
    page.get_by_role("button", name="Contour: an operation").click()
    made = tomllib.loads(text_of(page))["setup"][0]["operation"][-1]
    assert (made["type"], made["outline"]) == ("contour", drawing.name)

    # A program whose name does not tell it; the guess is in the form as values, and becomes a job.
    drop(page, "SLOT.PRG", SLOT.encode())
    page.wait_for_function("() => document.title.includes('SLOT.PRG.nc')")
    # Nothing tells its control: it is said, then the rest is guessed.
    page.locator('.outcome[data-state="none"]').wait_for(timeout=LONG)
    assert page.locator('[data-guess="tools"]').count() == 0
    page.locator("#g-control").select_option("linuxcnc")
    page.locator('[data-guess="tools"]').wait_for(timeout=LONG)
    assert re.sub(r"\s+", " ", page.locator('[data-guess="tools"] li').inner_text()) == "T1 End-mill ⌀6 mm"
    corners = [page.locator(f"#stock-{i}").get_attribute("placeholder") for i in range(6)]
    assert corners == ["-3", "-3", "-1", "33", "3", "0"], corners
    judged(page)
    shot(page, "drop-program")
    clean(page, "program")
    with page.expect_request("**/api/plan") as asked:
        page.locator("#stock-2").fill("-8")
    assert asked.value.post_data_json["stock"] == [-3, -3, -8, 33, 3, 0]
    page.get_by_role("button", name="Correct the guess in a job").click()
    judged(page, "SLOT.PRG.toml")
    job = tomllib.loads(text_of(page))
    assert job["setup"][0]["program"]["file"] == "SLOT.PRG.nc" and job["tool"][0]["diameter"] == 6

    drop(page, "holiday.jpg", b"\xff\xd8\xff\xe0 no program")
    page.locator(".across", has_text="holiday.jpg is nothing that kinecut reads").wait_for()
    assert not list(served.folder.glob("holiday*"))
    # The same by a button, for who does not drag.
    page.locator('[data-open="files"]').click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem", name="Add files from elsewhere").click()
    chooser.value.set_files([{"name": "again.toml", "mimeType": "text/plain", "buffer": SMALL.encode()}])
    page.wait_for_function("() => document.title.includes('again.toml')")


def marks(page: Page) -> None:
    """Findings have the numbers of their list in the picture; one chooses the other."""
    open_file(page, "17_vise_and_clamp/job.toml")
    assert judged(page, "17_vise_and_clamp/job.toml") == "NOT SAFE"
    numbers = page.locator(".findings .no").all_inner_texts()
    assert numbers == [str(i + 1) for i in range(len(numbers))] and numbers
    labels = page.locator(".marks .mark text").all_text_contents()
    assert labels and all(label.rstrip("+") in numbers for label in labels), labels
    last = page.locator(".marks .mark").last
    last.click()
    chosen = page.locator(".findings > li[aria-current] .no").inner_text()
    assert chosen == last.locator("text").text_content().rstrip("+")
    assert "on" in last.get_attribute("class").split()
    # From below the part hides the place above it, and its mark is faint; it is still there to be clicked. From the top it is seen.
    canvas = page.locator(".stage canvas")
    canvas.focus()
    page.keyboard.press("3")
    for _ in range(9):
        page.keyboard.press("ArrowDown")
    page.locator(".marks .mark.behind").first.wait_for()
    assert float(last.evaluate("e => getComputedStyle(e).opacity")) < 0.6
    page.locator(".rings .behind").wait_for(state="attached")
    shot(page, "marks-behind")
    last.click()
    page.mouse.move(5, 5)
    canvas.focus()
    page.keyboard.press("2")
    page.locator(".marks .mark:not(.behind)").first.wait_for()
    assert float(last.evaluate("e => getComputedStyle(e).opacity")) == 1
    page.locator(".rings .behind").wait_for(state="detached")
    page.keyboard.press("1")
    shot(page, "marks")
    clean(page, "marks")


# How colourful the most colourful pixel of a picture is.
COLOURFUL = """async packed => {
  const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  let most = 0;
  for (let i = 0; i < data.length; i += 4) most = Math.max(most, Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]));
  return most;
}"""


def colourful(page: Page, x: float, y: float, wide: float, high: float) -> int:
    """Greatest difference of red, green and blue in a stretch of the picture."""
    painted(page)
    picture = page.screenshot(clip={"x": x, "y": y, "width": wide, "height": high})
    return page.evaluate(COLOURFUL, base64.b64encode(picture).decode())


def sections(page: Page) -> None:
    """The face of a section hides what lies behind it, and is none of the part's own faces: it has a place, and nothing is picked on it."""
    open_file(page, "holes.toml")
    judged(page, "holes.toml")
    canvas = page.locator(".stage canvas")
    canvas.focus()
    page.keyboard.press("3")
    page.keyboard.press("x")
    # In front of both holes.
    page.locator(".section input").fill("0.1")
    page.wait_for_function("() => document.querySelector('.section output').textContent === '3.00 mm'")
    painted(page)
    box, px = canvas.bounding_box(), scale(page)
    # The first hole, seen from the front.
    x, y = box["x"] + box["width"] / 2 - 10 * px, box["y"] + box["height"] / 2
    hole = (x - 12, y - 4 * px, 24, 6 * px)
    # Beside the path, which a click would take.
    page.mouse.click(x + 3 * px, y)
    page.wait_for_function("() => / Y 3\\.000 /.test(document.querySelector('.under').textContent)", timeout=LONG)
    # The raw block as it is before the first hole, whose path goes through it behind the face.
    page.locator(".pprog .l", has_text="G0 Z2").first.click()
    page.locator(".stage.now").wait_for()
    raw = colourful(page, *hole)
    page.locator('[data-show="path"]').first.uncheck()
    plain = colourful(page, *hole)
    page.locator('[data-show="path"]').first.check()
    shot(page, "section-closed")
    assert plain < 40 and raw <= plain + 15, (raw, plain)
    # Through the middle of the holes: nothing is picked on the face beside them, the wall of the hole is.
    page.locator(".section input").fill("0.334")
    page.wait_for_function("() => document.querySelector('.section output').textContent === '10.02 mm'")
    page.locator("[data-measure]").click()
    page.locator(".measured").wait_for()
    painted(page)
    box, px = canvas.bounding_box(), scale(page)
    x, y = box["x"] + box["width"] / 2 - 10 * px, box["y"] + box["height"] / 2
    page.mouse.click(x - 7 * px, y)
    page.mouse.click(x + px, y - 3 * px)
    page.locator(".measured .xyz").wait_for()
    assert page.locator(".measured .xyz").count() == 1 and "wall of a round hole, ⌀8.0" in page.locator(".measured").inner_text(), page.locator(".measured").inner_text()
    page.keyboard.press("m")
    page.keyboard.press("x")
    page.keyboard.press("1")


def looks(browser: Browser, served: Served) -> None:
    """Measuring in both themes at three widths, and in the pseudo-language."""
    for theme in ("light", "dark"):
        for width, height in SIZES:
            watched = Watched(browser, (width, height), theme)
            page = watched.opened(served.address)
            open_file(page, "01_bore/job.toml")
            judged(page)
            page.get_by_role("button", name="Measure").click()
            page.locator(".stage canvas").scroll_into_view_if_needed()
            page.locator('[data-view="top"]').click()
            box = page.locator(".stage canvas").bounding_box()
            by = 115 * scale(page)
            for way in (-1, 1):
                page.mouse.click(box["x"] + box["width"] / 2 + way * by, box["y"] + box["height"] / 2 + by)
            page.locator(".measured dl").wait_for()
            shot(page, f"measure-{theme}-{width}")
            clean(page, f"measure {theme} {width}")
            assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth"), f"{width} scrolls sideways"
            watched.close(served.address)
    watched = Watched(browser, SIZES[0], "light")
    page = watched.opened(served.at("lang=pseudo"))
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name="01_bore/job.toml").click()
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    field(page, f"{BORE}.diameter").fill("198")
    page.locator(".clock .feeds").wait_for()
    found = page.evaluate(UNMARKED, MARK)
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    page.locator("[data-measure]").click()
    found += page.evaluate(UNMARKED, MARK)
    page.locator('[data-view="top"]').click()
    box = page.locator(".stage canvas").bounding_box()
    by = 115 * scale(page)
    for way in (-1, 1):
        page.mouse.click(box["x"] + box["width"] / 2 + way * by, box["y"] + box["height"] / 2 + by)
        page.locator(".measured .xyz").nth((way + 1) // 2).wait_for()
        found += page.evaluate(UNMARKED, MARK)
    drop(page, "wanted.stl", block([0, 0, -10], [40, 30, 0]))
    page.locator(".across .acts button").first.wait_for()
    found += page.evaluate(UNMARKED, MARK)
    shot(page, "measure-pseudo")
    drop(page, "slot.ngc", SLOT.encode())
    # A job that lies beside it is no guess.
    page.locator("#g-job").select_option("")
    page.locator('[data-guess="tools"]').wait_for(timeout=LONG)
    found += page.evaluate(UNMARKED, MARK)
    assert not found, sorted(set(found))
    assert MARK in page.locator(".pform").inner_text()
    watched.close(served.address)


def begin(stage: Stage) -> Page:
    (stage.served.folder / "small.toml").write_text(SMALL)
    (stage.served.folder / "holes.toml").write_text(SMALL.replace("format = 1\n", "format = 1\nsimulate = { step = 0.2 }\n"))
    return bore(stage)


SCRIPT = Script(
    "the window of a job in a browser",
    ("01_bore", "17_vise_and_clamp", "21_plate_by_sizes"),
    {
        "feeds": lambda s: feeds(s.page),
        "operations": lambda s: operations(s.page),
        "measures": lambda s: measures(s.page),
        "sections": lambda s: sections(s.page),
        "marks": lambda s: marks(s.page),
        "inspects": lambda s: inspects(s.page),
        "rounds": lambda s: rounds(s.page, s.served),
        "drops": lambda s: drops(s.page, s.served),
        "closes": Stage.closes,
        "looks": lambda s: looks(s.browser, s.served),
    },
    begin,
    always=("closes",),
)

if __name__ == "__main__":
    SCRIPT.main()
