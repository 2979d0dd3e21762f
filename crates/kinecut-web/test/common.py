"""Parts that the scripts of this folder share: the program that serves a folder, pages that are watched, and a script as a list of steps.
Needs playwright and axe-playwright-python, and Debian's Chromium (CHROMIUM: its path). With KINECUT_SHOTS set, pictures go into that folder;
with KINECUT_WEEKLY set, the bounds of time count, on a machine that does nothing else; with KINECUT_DIST set, the page's files come from that
folder (../dist after a build of the pages) in place of the program."""

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Error, Page, sync_playwright

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
# So long may an answer take on a busy machine [ms].
LONG = 240_000
# Widths of the window, and heights [px].
SIZES = [(1400, 900), (800, 900), (390, 844)]
# Put behind each letter by the pseudo-language.
MARK = "\u0323"
MINUS = "\u2212"
OUTCOME = '.outcome[data-state="safe"], .outcome[data-state="np"], .outcome[data-state="bad"]'
# A name that leads to this machine, for pages of others.
EVIL = "evil.example"
WEEKLY = "KINECUT_WEEKLY" in os.environ

# Text of the page with letters that the pseudo-language did not mark: none but names, program text and sentences of the library.
UNMARKED = """mark => {
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const isolated = /\\u2068[^\\u2069]*\\u2069/g;
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (parent.closest('[translate="no"], [lang="en"], script, style, noscript, svg title')) continue;
    const text = node.textContent.replace(isolated, "");
    const letters = [...text];
    if (letters.some((c, i) => /\\p{L}/u.test(c) && letters[i + 1] !== mark)) found.push(text);
  }
  for (const element of document.querySelectorAll("[aria-label], [title], [placeholder]")) {
    if (element.closest('[translate="no"], [lang="en"], .cm-panels')) continue;
    for (const name of ["aria-label"]) {
      const text = (element.getAttribute(name) ?? "").replace(isolated, "");
      const letters = [...text];
      if (letters.some((c, i) => /\\p{L}/u.test(c) && letters[i + 1] !== mark)) found.push(`${name}: ${text}`);
    }
  }
  return found;
}"""


class Served:
    """A folder with copies of examples, and the program that serves it."""

    def __init__(self, program: str, *examples: str):
        self.program = program
        self.folder = Path(tempfile.mkdtemp(prefix="kinecut-workbench-"))
        for name in examples:
            shutil.copytree(EXAMPLES / name, self.folder / name)
        for name in EXAMPLES.glob("*.toml"):
            shutil.copy(name, self.folder)
        bore = self.folder / "01_bore/job.toml"
        if bore.exists():
            # Of its simulation the pages need the outcome: on lines twice as far apart, and without engagement, a sixth of the time.
            bore.write_text(bore.read_text().replace("simulate = { step = 0.2 }", "simulate = { step = 0.4, engagement = false }"))
        if "07_external_program" in examples:
            shutil.move(self.folder / "07_external_program/haas_bracket.nc", self.folder)
        arguments = [program, "open", str(self.folder), "--no-browser", "--port", "0"]
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.address = ""
        for line in self.process.stdout:
            found = re.search(r"http://\S+#token=[0-9a-f]+", line)
            if found:
                self.address = found.group()
                break
        assert self.address, "the server told no address"

    def at(self, query: str) -> str:
        origin, fragment = self.address.split("#")
        return f"{origin}?{query}#{fragment}"

    def end(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(timeout=20)

    def gone(self) -> None:
        self.end()
        shutil.rmtree(self.folder, ignore_errors=True)


class Watched:
    """A page whose console must stay silent, and which asks nobody but its own server."""

    def __init__(self, browser: Browser, size: tuple[int, int], theme: str):
        self.page = browser.new_page(viewport={"width": size[0], "height": size[1]}, color_scheme=theme)
        self.page.set_default_timeout(LONG / 2)
        self.said: list[str] = []
        self.asked: set[str] = set()
        # That pictures are read is of the test, not of the page; a refused save is told by the browser itself.
        self.page.on("console", lambda m: any(t in m.text for t in ("ReadPixels", "409 (Conflict)")) or self.said.append(m.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("request", lambda r: self.asked.add(re.sub(r"^(\w+://[^/]*).*", r"\1", r.url)))
        self.page.on("dialog", lambda dialog: dialog.accept())

    def opened(self, address: str) -> Page:
        if built := os.environ.get("KINECUT_DIST"):
            self.page.route("**/assets/**", lambda route: route.fulfill(path=built + re.sub(r"^\w+://[^/]*", "", route.request.url)))
        self.page.goto(address)
        return self.page

    def close(self, address: str) -> None:
        assert not self.said, self.said
        own = re.sub(r"^(\w+://[^/]*).*", r"\1", address)
        assert {a for a in self.asked if not a.startswith(("blob:", "data:"))} == {own}, self.asked
        self.page.close()


def visited(browser: Browser, size: tuple[int, int], theme: str, address: str) -> tuple[Watched, Page]:
    one = Watched(browser, size, theme)
    return one, one.opened(address)


def open_file(page: Page, name: str) -> None:
    page.locator('[data-open="files"]').click()
    page.get_by_role("menuitem", name=name, exact=True).click()


# Nothing is asked or about to be asked, on some pictures in a row: what an answer brings may ask again.
STILL = """() => {
  const asks = document.documentElement.dataset.open !== "0" || document.querySelector('main[data-state="planning"]');
  window.stillFor = asks ? 0 : window.stillFor + 1;
  return window.stillFor > 3;
}"""


def still(page: Page) -> None:
    """Waits until the page has no question open and none to come: all that it shows is of what was done so far."""
    page.evaluate("() => (window.stillFor = 0)")
    page.wait_for_function(STILL, polling="raf", timeout=LONG)


def judged(page: Page, name: str = "") -> str:
    """Waits for the outcome, of the file of a name where one was opened: the one before is still there for a moment."""
    still(page)
    page.wait_for_function("name => /^(SAFE|NOT PROVEN|NOT SAFE) /.test(document.title) && document.title.endsWith(name)", arg=name, timeout=LONG)
    page.locator(OUTCOME).first.wait_for(timeout=LONG)
    return page.locator(".outcome .word").inner_text()


def painted(page: Page) -> None:
    """Waits until a change that was made is on the page: it is there after a frame."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def frame(page: Page) -> None:
    """Waits for the next picture: a hand moves on from one to the next."""
    page.evaluate("() => new Promise(requestAnimationFrame)")


def settled(page: Page, main: str) -> str:
    """Waits until what a window shows is of its text; tells whether it is done or wrong."""
    painted(page)
    state = "main => ['done', 'wrong'].find(state => state === document.querySelector(main)?.dataset.state)"
    return page.wait_for_function(state, arg=main, timeout=LONG).json_value()


def cells(page: Page, table: str, column: int) -> dict[str, str]:
    """A column of a table by the names of its rows; nothing in rows that have a sentence in its place."""
    rows = page.locator(f'[data-table="{table}"] tr[data-row]')
    told = rows.evaluate_all("(all, k) => all.map(r => [r.dataset.row, r.cells[k]?.firstChild?.textContent ?? ''])", column)
    return {key: value.strip() for key, value in told}


def shell(program: str, *words: str, text: str | None = None, folder: Path | str = EXAMPLES):
    """The answer of the program at the shell with --json: about a text, or about files of a folder."""
    run = subprocess.run([program, *words, "--json"], input=text, capture_output=True, text=True, cwd=folder)
    return json.loads(run.stdout)


@contextlib.contextmanager
def kept_back(page: Page, path: str, which: str = "", but: int = 0):
    """Keeps back requests of a path whose question has a word in it, but so many, until the block ends: what is shown then is older, and has to say so."""
    kept: list = []
    passed = 0

    def keep(route) -> None:
        nonlocal passed
        if which in (route.request.post_data or "") and passed == but:
            kept.append(route)
        else:
            passed += which in (route.request.post_data or "")
            route.fallback()

    page.route(path, keep)
    try:
        yield
    finally:
        page.unroute(path, keep)
        for route in kept:
            # One that the page has given up by now is gone.
            with contextlib.suppress(Error):
                route.continue_()


def shares(taken: list[float]) -> str:
    """Half of some times, and nineteen of twenty."""
    return f"half within {taken[len(taken) // 2]:.0f} ms, nineteen of twenty within {taken[int(0.95 * len(taken))]:.0f} ms"


def shot(page: Page, name: str) -> None:
    folder = os.environ.get("KINECUT_SHOTS")
    if folder:
        Path(folder).mkdir(parents=True, exist_ok=True)
        painted(page)
        page.screenshot(path=f"{folder}/{name}.png", full_page=page.viewport_size["width"] < 700)


def clean(page: Page, what: str) -> None:
    violations = Axe().run(page).response["violations"]
    assert not violations, (what, [(v["id"], [n["html"][:160] for n in v["nodes"]][:4]) for v in violations])


@dataclass
class Stage:
    """The things that the steps of a script have: the browser, a served folder, and a page of it that goes from step to step."""

    browser: Browser
    program: str
    served: Served
    watched: Watched | None = None
    page: Page | None = None

    def closes(self) -> None:
        """The console has stayed silent, and nobody else was asked."""
        assert self.watched
        self.watched.close(self.served.address)


Step = Callable[[Stage], object]


@dataclass
class Script:
    """One script: what it is about, the examples that it serves, how its page begins, and its steps in their order."""

    what: str
    examples: tuple[str, ...]
    steps: dict[str, Step]
    begin: Callable[[Stage], Page] | None = None
    # Steps that others need.
    always: tuple[str, ...] = ()
    # Steps that need no browser.
    plain: dict[str, Callable[[], object]] = field(default_factory=dict)

    def run(self, browser: Callable[[], Browser], program: str, only: list[str]) -> None:
        unknown = set(only) - {*self.plain, *self.steps}
        assert not unknown, f"no such step: {', '.join(sorted(unknown))}; there are {', '.join([*self.plain, *self.steps])}"
        for name, plain in self.plain.items():
            if not only or name in only:
                timed(name, plain)
        wanted = [name for name in self.steps if not only or name in only or name in self.always]
        if not wanted:
            return
        stage = Stage(browser(), program, Served(program, *self.examples))
        try:
            if self.begin:
                stage.watched = Watched(stage.browser, SIZES[0], "light")
                stage.page = self.begin(stage)
            for name in wanted:
                timed(name, lambda name=name: self.steps[name](stage))
        finally:
            stage.served.gone()
            for context in stage.browser.contexts:
                context.close()
        print(f"{self.what}: as it should be", flush=True)

    def main(self) -> None:
        """Runs it by itself: `python3 SCRIPT.py KINECUT [STEP ...]`."""
        with Chromium() as chromium:
            self.run(chromium.browser, str(Path(sys.argv[1]).resolve()) if Path(sys.argv[1]).exists() else sys.argv[1], sys.argv[2:])


def timed(name: str, step: Callable[[], object]) -> None:
    begun = time.monotonic()
    step()
    print(f"{name}: as it should be, {time.monotonic() - begun:.1f} s", flush=True)


class Chromium:
    """One browser for all that is run, started when it is asked for."""

    # Guards of the browser for the local network are off: those of the server are looked at. A name of others leads to this machine.
    ARGUMENTS = [
        "--no-sandbox",
        f"--host-resolver-rules=MAP {EVIL} 127.0.0.1",
        "--disable-features=LocalNetworkAccessChecks,BlockInsecurePrivateNetworkRequests,PrivateNetworkAccessChecks",
    ]

    def __enter__(self) -> "Chromium":
        self.playwright = None
        self.one: Browser | None = None
        return self

    def browser(self) -> Browser:
        if self.one is None:
            self.playwright = sync_playwright().start()
            path = os.environ.get("CHROMIUM") or shutil.which("chromium")
            self.one = self.playwright.chromium.launch(executable_path=path, args=self.ARGUMENTS)
        return self.one

    def __exit__(self, *_: object) -> None:
        if self.one:
            self.one.close()
        if self.playwright:
            self.playwright.stop()
