"""The report in a browser: python3 browser.py FOLDER, with the report.html of a run in FOLDER/clamp, of a coarse one in
FOLDER/small, and of one on a machine with bodies in FOLDER/machine. Needs playwright and axe-playwright-python, and Debian's Chromium."""

import os
import shutil
import sys
from pathlib import Path

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, sync_playwright

# Least frames a second of a page with few triangles, drawn by the processor: asked for in the weekly run, on a machine that does nothing
# else.
LEAST_RATE = 10
# Most calls and triangles that a frame of that page sends to the graphics processor while it plays; and bytes for each triangle: an index.
MOST_CALLS = 20
MOST_TRIANGLES = 30_000
MOST_BYTES = 12
# Most triangles of that page.
FEW = 50_000
# Part of the picture that may differ between the last moment of the stock and the part: edges a step of the display apart.
MAY_DIFFER = 0.02

SCRUB = """place => {
  const slider = document.getElementById("kc-time");
  slider.value = String(place * Number(slider.max));
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""

# The picture as the page gives it to paper, as bits: what is not background.
PICTURE = """async () => {
  dispatchEvent(new Event("beforeprint"));
  const image = new Image();
  image.src = document.getElementById("kc-still").src;
  await image.decode();
  dispatchEvent(new Event("afterprint"));
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: image.width, height: image.height });
  const pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0);
  const { data } = pen.getImageData(0, 0, image.width, image.height);
  return Array.from({ length: data.length / 4 }, (_, i) => (data[4 * i + 3] > 0 ? "1" : "0")).join("");
}"""


# Counts what is sent to the graphics processor.
COUNTED = """() => {
  const counts = { calls: 0, triangles: 0, bytes: 0 };
  window.counts = counts;
  const on = WebGL2RenderingContext.prototype;
  const wrap = (name, add) => {
    const before = on[name];
    on[name] = function (...given) {
      add(...given);
      return before.apply(this, given);
    };
  };
  const drawn = (mode, count) => {
    counts.calls += 1;
    if (mode === on.TRIANGLES) counts.triangles += count / 3;
  };
  wrap("drawArrays", (mode, _, count) => drawn(mode, count));
  wrap("drawElements", (mode, count) => drawn(mode, count));
  wrap("drawArraysInstanced", (mode, _, count, instances) => drawn(mode, count * instances));
  wrap("drawElementsInstanced", (mode, count, _, __, instances) => drawn(mode, count * instances));
  const sized = data => (typeof data === "number" ? 0 : (data?.byteLength ?? 0));
  wrap("bufferData", (_, data) => (counts.bytes += sized(data)));
  wrap("bufferSubData", (_, __, data) => (counts.bytes += sized(data)));
  for (const name of ["texImage2D", "texSubImage2D"]) wrap(name, (...given) => (counts.bytes += sized(given.at(-1))));
}"""

# The counts of ten frames, from here on.
SENT = """() => new Promise(done => {
  Object.assign(window.counts, { calls: 0, triangles: 0, bytes: 0 });
  const slider = document.getElementById("kc-time");
  const frames = new Set([slider.value]);
  const look = () => {
    frames.add(slider.value);
    if (frames.size > 10) done({ ...window.counts, frames: frames.size });
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
})"""

# Frames a second over two seconds.
RATE = """() => new Promise(done => {
  const frames = new Set();
  const slider = document.getElementById("kc-time");
  const start = performance.now();
  const look = now => {
    frames.add(slider.value);
    if (now - start > 2000) done(frames.size / 2);
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
})"""


def switch(page: Page, name: str, on: bool) -> None:
    page.locator(f'[data-show="{name}"]').set_checked(on)


def settled(page: Page) -> None:
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def opened(page: Page, file: Path) -> None:
    page.goto(file.resolve().as_uri())
    page.locator("#kc-line").wait_for()
    page.locator("html.scripted").wait_for()
    settled(page)


def is_now(page: Page) -> bool:
    return page.locator(".stage.now").count() == 1


def differing(a: str, b: str) -> float:
    assert len(a) == len(b)
    return sum(x != y for x, y in zip(a, b)) / max(a.count("1"), 1)


def looks(page: Page, file: Path) -> None:
    opened(page, file)
    violations = Axe().run(page).response["violations"]
    assert not violations, [(v["id"], [n["html"] for n in v["nodes"]][:3]) for v in violations]

    # Scrubbing shows the stock as it is then; at the end it is the part.
    for place in (0.2, 0.7, 0.4):
        page.evaluate(SCRUB, place)
        settled(page)
        assert is_now(page), place
    page.evaluate(SCRUB, 1.0)
    settled(page)
    assert not is_now(page), "at the end the part is finished"

    # The last moment is the part; nothing of the raw stock is missing at the first one.
    for name in ("path", "rapids", "tool", "fixtures"):
        switch(page, name, False)
    part = page.evaluate(PICTURE)
    page.evaluate(SCRUB, 0.9999)
    settled(page)
    assert is_now(page)
    last = page.evaluate(PICTURE)
    page.evaluate(SCRUB, 0.0)
    settled(page)
    first = page.evaluate(PICTURE)
    assert part.count("1") > 10_000
    assert differing(last, part) < MAY_DIFFER, differing(last, part)
    assert first.count("1") > (1 - MAY_DIFFER) * part.count("1")

    # Step by line.
    page.locator("#kc-list").focus()
    said = []
    for _ in range(6):
        page.keyboard.press("ArrowRight")
        settled(page)
        said.append(page.locator("#kc-line").inner_text())
    assert len(set(said)) == 6, said

    # Play stops at the next tool change.
    page.locator("#kc-stops").select_option("tools")
    page.locator("#kc-speed").select_option("60")
    page.evaluate(SCRUB, 0.0)
    before = page.locator("#kc-line").inner_text()
    page.locator("#kc-play").click()
    page.locator('#kc-play[aria-label="Play"]').wait_for()
    assert page.locator("#kc-line").inner_text() != before


def plays(page: Page, file: Path) -> float:
    """Frames a second while a page with few triangles plays; a frame sends no more than it must."""
    opened(page, file)
    faces = page.evaluate("() => JSON.parse(document.getElementById('kc-head').textContent).playback.faces")
    assert 0 < 2 * faces <= FEW, faces
    page.locator("#kc-play").click()
    settled(page)
    sent = page.evaluate(SENT)
    for what, most in (("calls", MOST_CALLS), ("triangles", MOST_TRIANGLES)):
        assert 0 < sent[what] <= most * sent["frames"], sent
    assert sent["bytes"] <= MOST_BYTES * sent["triangles"], sent
    return page.evaluate(RATE)


def moves(page: Page, file: Path) -> None:
    """The machine, and the path in the colours of engagement."""
    opened(page, file)
    for quantity in ("arc", "chip", ""):
        page.locator("#kc-colour").select_option(quantity)
        settled(page)
        assert page.locator("#kc-scale").is_visible() == (quantity != "")
    without = page.evaluate(PICTURE)
    switch(page, "machine", True)
    pictures = []
    for place in (0.1, 0.5):
        page.evaluate(SCRUB, place)
        settled(page)
        pictures.append(page.evaluate(PICTURE))
    assert differing(pictures[0], without) > 0.1 and differing(*pictures) > 0.01


def main() -> None:
    folder = Path(sys.argv[1])
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 950})
        page.add_init_script(f"({COUNTED})()")
        said: list[str] = []
        # That pictures are read is of the test, not of the page.
        page.on("console", lambda message: "ReadPixels" in message.text or said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        looks(page, folder / "clamp" / "report.html")
        rate = plays(page, folder / "small" / "report.html")
        assert "KINECUT_WEEKLY" not in os.environ or rate >= LEAST_RATE, f"{rate:.1f} frames a second"
        moves(page, folder / "machine" / "report.html")
        assert not said, said
        browser.close()
    print(f"the report in a browser: as it should be, {rate:.0f} frames a second")


main()
