"""The languages of the workbench: python3 words.py KINECUT [STEP ...]. `catalogues` reads the sources alone (`words.py - catalogues`);
the other steps use the page as a person does. Needs and settings: common.py."""

import json
import re
from pathlib import Path

from common import LONG, MARK, OUTCOME, SIZES, UNMARKED, Script, Served, Watched, clean, open_file, shell, shot, still
from playwright.sync_api import Browser, Page

WORDS = Path(__file__).resolve().parents[1] / "ui/src/words"
ENTRY = re.compile(r'^\s+(?:"([^"]+)"|(\w+)): ("(?:[^"\\]|\\.)*"),', re.M)
# Numbers of forms that a language has.
FORMS = {"en": 2, "uk": 4, "ru": 4, "de": 2}
# Files that each language has as a whole; of others what is seen about these windows.
WHOLE = ("drill", "face")
PARTS = ("app", *WHOLE)
COVER = "04_gear_pump_cover/face.toml"
DRILLING = "03_drill_through_shaft/figure_7.toml"
# Words in Latin letters that are the same in all languages.
LATIN = {"kinecut", "toml", "nc", "stl", "dxf", "svg", "shift", "alt", "ctrl", "enter", "esc", "webgl", "id"}


def read(tag: str, name: str) -> dict[str, str]:
    path = WORDS / tag / f"{name}.ts"
    return {a or b: json.loads(text) for a, b, text in ENTRY.findall(path.read_text())} if path.exists() else {}


def arguments(text: str) -> set[str]:
    return set(re.findall(r"\{(\w+)", text))


def typography(tag: str, key: str, text: str) -> None:
    """Marks and letters as the language has them."""
    where = (tag, key, text)
    assert '"' not in text and "'" not in text and "..." not in text and " - " not in text and "  " not in text and ("\u00ad" not in text or key.startswith("drill.kind.")), where
    assert not re.search(r"\S%", text.replace("{percent}%", "")) or " %" in text, where
    if tag == "de":
        # No letter for an umlaut: ae, oe, and ue but in words as neu, Steuer, Dauer, aktuell, manuell, zuerst, kongruent.
        assert not re.search(r"(?i)ae|oe|(?<![aeq])ue(?!ll|rst|nt)", text), where
        assert not re.search(r"(?i)strasse|gross|schliess(?!\b)|\bmass\b|\bmasse\b|weiss", text), where
        assert "“" not in text or "„" in text, where
        return
    own = {"uk": "іїєґІЇЄҐ", "ru": "ыэъёЫЭЪЁ"}
    assert not set(text) & set(own["ru" if tag == "uk" else "uk"]), where
    # Letters of two scripts in one word look alike and are not.
    for word in re.findall(r"[^\W\d_]+", re.sub(r"\{[^}]*\}", " ", text.replace("\u00ad", ""))):
        assert not (re.search(r"[A-Za-z]", word) and re.search(r"[\u0400-\u04ff]", word)), where


def catalogues() -> None:
    """Translated files have the keys, arguments and forms that they need."""
    english = {name: read("en", name) for name in (p.stem for p in (WORDS / "en").glob("*.ts")) if name != "index"}
    known = {key: text for file in english.values() for key, text in file.items()}
    assert len(known) > 600
    keys: list[set[str]] = []
    for tag, forms in FORMS.items():
        own: dict[str, str] = {}
        for name in [*english, "keys"]:
            own |= {f"{name}/{key}": text for key, text in read(tag, name).items()}
        for name in WHOLE:
            missing = english[name].keys() - read(tag, name).keys()
            assert not missing, (tag, name, sorted(missing))
        keys.append(set(read(tag, "keys")))
        for place, text in own.items():
            name, key = place.split("/", 1)
            for all_forms in re.findall(r"\{\w+#([^}]*)\}", text):
                assert len(all_forms.split("|")) == forms and all(all_forms.split("|")), (tag, key, text)
            if tag == "en":
                continue
            # Symbols of the papers are no words.
            if not key.startswith("s."):
                typography(tag, key, text)
            if name == "keys":
                assert re.fullmatch(r"[a-z_-]+", key), key
                continue
            assert key in known, (tag, key)
            assert arguments(text) == arguments(known[key]), (tag, key, text)
            if key == "decimal":
                continue
            assert text[-1:] in ".:" or known[key][-1:] not in ".:", (tag, key, "a sentence ends with its mark")
            assert text[-1:] != "." or known[key][-1:] == ".", (tag, key, "a label has no mark at its end")
    assert keys[1] == keys[2] == keys[3] and len(keys[1]) > 80


def verb(program: str, name: str, text: str, folder: Path) -> dict:
    return shell(program, name, "-", text=text, folder=folder)


def choose(page: Page, tag: str) -> None:
    page.locator('[data-open="languages"]').click()
    page.locator(f'[data-language="{tag}"]').click()
    page.wait_for_function(f"() => document.documentElement.lang === '{tag}'", timeout=LONG)


def drilled(page: Page) -> None:
    page.wait_for_function("() => document.querySelector('main.drilling')?.dataset.state === 'done'", timeout=LONG)
    page.locator("svg.load").wait_for(timeout=LONG)
    still(page)


def faced(page: Page) -> None:
    page.locator('[data-open="facing"]').click()
    page.locator(".files button", has_text=COVER).click()
    page.locator('[data-fact="hand"] b.bad').wait_for(timeout=LONG)
    page.locator(".graph .cell").first.wait_for(timeout=LONG)
    page.locator(".method").wait_for(timeout=LONG)
    still(page)


def chooses(browser: Browser, served: Served, program: str) -> None:
    """A language is chosen in the bar, live: what was typed stays, numbers take its form, comma and point are typed alike."""
    watched = Watched(browser, SIZES[0], "light")
    loaded: list[str] = []
    watched.page.on("request", lambda r: loaded.append(r.url) if "/words/" in r.url else None)
    page = watched.opened(served.address)
    open_file(page, DRILLING)
    drilled(page)
    assert not loaded, "a language was loaded before it was chosen"
    page.evaluate("() => (window.same = true)")
    diameter = page.locator('[data-key="tool.diameter"] input')
    diameter.fill("8.5")
    page.wait_for_function("() => document.documentElement.dataset.drawn > 1")
    drilled(page)
    exact = page.locator('[data-fact="time"] dd').inner_text()
    assert re.match(r"[\d.]+ s\b", exact), exact
    for tag, unit, heading in (("uk", "с", "Отвір ⌀8,5"), ("ru", "с", "Отверстие ⌀8,5"), ("de", "s", "Bohrung ⌀8,5")):
        choose(page, tag)
        assert page.evaluate("() => window.same"), "the page was loaded again"
        assert sum(f"/words/{tag}.js" in url for url in loaded) == 1, loaded
        assert page.locator("h1").inner_text().startswith(heading), page.locator("h1").inner_text()
        assert page.locator('[data-fact="time"] dd').inner_text().startswith(exact.split(" ")[0].replace(".", ",") + f" {unit}"), page.locator('[data-fact="time"] dd').inner_text()
        assert diameter.input_value() == "8,5"
        for typed, value in (("9,25", 9.25), ("9.5", 9.5), ("17/2", 8.5)):
            known = page.evaluate("() => document.documentElement.dataset.drawn")
            with page.expect_request("**/api/verb/drill") as asked:
                diameter.fill(typed)
                diameter.press("Enter")
            text = asked.value.post_data_json["text"]
            assert re.search(rf"^diameter = {value}$", text, re.M), (typed, text)
            page.wait_for_function(f"() => document.documentElement.dataset.drawn > {known}")
            drilled(page)
            hole = verb(program, "drill", text, served.folder / DRILLING.split("/")[0])["holes"][0]
            shown = page.locator('[data-fact="way"] dd').inner_text().split(" ")[0]
            assert shown == f"{hole['lengths']['L_rx']:.3f}".replace(".", ","), (shown, hole["lengths"])
    # The choice is kept; one in the address comes before it, until another is chosen.
    page.reload()
    page.locator("main.drilling, main.empty").first.wait_for(timeout=LONG)
    assert page.evaluate("() => document.documentElement.lang") == "de"
    page.goto("about:blank")
    page.goto(served.at("lang=ru"))
    page.wait_for_function("() => document.documentElement.lang === 'ru'", timeout=LONG)
    choose(page, "en")
    assert "lang=" not in page.url, page.url
    watched.close(served.address)


# Texts in which a word is left in English, and sentences that equal the English ones; marked sentences and names are no matter.
FOREIGN = """([latin, allowed, english]) => {
  const found = [];
  const texts = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (!node.parentElement.closest('[translate="no"], [lang="en"], code, script, style, noscript, svg title')) texts.push(node.textContent);
  }
  for (const e of document.querySelectorAll("[aria-label]")) {
    if (!e.closest('[translate="no"], [lang="en"]') && !e.querySelector('[lang="en"]')) texts.push(e.getAttribute("aria-label"));
  }
  for (const text of texts) {
    if (latin) {
      // Words in capitals alone are names of layers and axes.
      const words = (text.match(/[A-Za-z_]{3,}/g) ?? []).filter((w) => w !== w.toUpperCase());
      if (words.some((w) => !allowed.includes(w.toLowerCase())) && !/\\.(toml|dxf|nc|stl)\\b|kinecut-workbench/.test(text)) found.push(text);
    } else if (english.includes(text.trim())) found.push(text);
  }
  return found;
}"""

# What does not fit: pages that scroll sideways, texts that are cut, words of a drawing beyond its border.
CUT = """() => {
  const found = [];
  if (document.documentElement.scrollWidth > innerWidth + 1) found.push(`the page is ${document.documentElement.scrollWidth} wide`);
  for (const e of document.querySelectorAll("button, h1, h2, h3, dt, dd, label, th, td, .tag, .head, header, summary, .facts > div, .f > u, p")) {
    if (e.offsetParent === null || e.closest(".cm-editor, .tabs, .sr") || e.classList.contains("sr") || e.clientWidth <= 1) continue;
    const style = getComputedStyle(e);
    if (e.scrollWidth > e.clientWidth + 1 && style.display !== "inline" && !/auto|scroll/.test(style.overflowX)) found.push(`${e.tagName} ${e.textContent.trim().slice(0, 60)}: ${e.scrollWidth} in ${e.clientWidth}`);
    if (/clip|hidden/.test(style.overflowY) && e.scrollHeight > e.clientHeight + 2 && e.clientHeight > 0) found.push(`${e.tagName} ${e.textContent.trim().slice(0, 60)}: ${e.scrollHeight} high in ${e.clientHeight}`);
  }
  for (const svg of document.querySelectorAll("svg")) {
    const box = svg.getBoundingClientRect();
    if (box.width === 0) continue;
    const words = [...svg.querySelectorAll("text")].filter((t) => t.textContent.trim() !== "").map((t) => [t, t.getBoundingClientRect()]);
    for (const [t, own] of words) {
      if (own.left < box.left - 2 || own.right > box.right + 2 || own.top < box.top - 3 || own.bottom > box.bottom + 4) found.push(`svg ${t.textContent}: beyond the drawing`);
    }
    words.forEach(([t, a], i) => words.slice(i + 1).forEach(([u, b]) => {
      const over = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (over > 3 && down > 6) found.push(`svg ${t.textContent} lies over ${u.textContent}`);
    }));
  }
  const bar = document.querySelector("header.top");
  for (const e of bar.querySelectorAll("button")) {
    const own = e.getBoundingClientRect();
    if (own.width > 0 && (own.right > innerWidth || own.left < 0)) found.push(`bar: ${e.textContent}`);
  }
  return [...new Set(found)];
}"""


def foreign(page: Page, tag: str) -> list[str]:
    english = {name: read("en", name) for name in PARTS}
    own = {key: text for name in PARTS for key, text in read(tag, name).items()}
    same = [text for name in PARTS for key, text in english[name].items() if own.get(key) != text and text not in own.values()]
    return page.evaluate(FOREIGN, [tag != "de", sorted(LATIN), same])


def looks(browser: Browser, served: Served) -> None:
    """Both windows in each language: all of it in that language, nothing cut at three widths, axe without a violation."""
    wrong: dict[str, list[str]] = {}
    for tag in ("uk", "ru", "de"):
        for size in SIZES:
            theme = "dark" if size[0] == 800 else "light"
            watched = Watched(browser, size, theme)
            page = watched.opened(served.at(f"lang={tag}"))
            page.locator("main.empty").wait_for(timeout=LONG)
            page.locator('[data-open="files"]').click()
            told = page.evaluate(CUT) + foreign(page, tag)
            page.get_by_role("menuitem", name=DRILLING, exact=True).click()
            drilled(page)
            shot(page, f"{tag}-drill-{size[0]}")
            told += page.evaluate(CUT) + foreign(page, tag)
            clean(page, f"{tag} {size[0]} drill")
            page.locator("details").evaluate_all("all => all.forEach(d => (d.open = true))")
            page.locator(".travel input").focus()
            page.keyboard.press("End")
            for pair in ("falling shaftBeside", "boreBeside blind"):
                page.locator(f'[data-pair="{pair}"]').click()
                page.wait_for_function("() => ['done', 'wrong'].includes(document.querySelector('main.drilling')?.dataset.state)")
                told += page.evaluate(CUT) + foreign(page, tag)
            for kind in ("gun", "stepped", "cast-iron"):
                page.locator(f'button[data-point="{kind}"]').click()
                page.wait_for_function("() => ['done', 'wrong'].includes(document.querySelector('main.drilling')?.dataset.state)")
                told += page.evaluate(CUT) + foreign(page, tag)
            shot(page, f"{tag}-drill-open-{size[0]}")
            faced(page)
            shot(page, f"{tag}-face-{size[0]}")
            told += page.evaluate(CUT) + foreign(page, tag)
            clean(page, f"{tag} {size[0]} face")
            page.locator("details").evaluate_all("all => all.forEach(d => (d.open = true))")
            page.locator("[data-find]").click()
            page.locator('[data-sectors="ended"]').wait_for(timeout=LONG)
            page.locator("[data-paper]").check()
            page.locator(".method header button").click()
            page.locator('[data-walk="ended"]').wait_for(timeout=LONG)
            page.locator(".ways-all, .panel button[aria-pressed]").first.click()
            told += page.evaluate(CUT) + foreign(page, tag)
            shot(page, f"{tag}-face-open-{size[0]}")
            if size[0] > 700:
                page.keyboard.press("Control+k")
                page.locator("dialog[open]").wait_for()
                told += page.evaluate(CUT) + foreign(page, tag)
                page.keyboard.press("Escape")
            if told:
                wrong[f"{tag} {size[0]}"] = sorted(set(told))
            watched.close(served.address)
    assert not wrong, json.dumps(wrong, ensure_ascii=False, indent=1)


def pseudo(browser: Browser, served: Served) -> None:
    """No text outside the catalogue in any window: a file of the catalogue without a window here is a mistake."""

    def job(page: Page) -> None:
        open_file(page, "01_bore/job.toml")
        page.locator(OUTCOME).first.wait_for(timeout=LONG)

    def drill(page: Page) -> None:
        open_file(page, DRILLING)
        drilled(page)

    windows = {"app": lambda page: page.locator('[data-open="languages"]').click(), "job": job, "drill": drill, "face": faced}
    # The other windows are looked at by scripts of their own.
    own = {p.stem for p in Path(__file__).parent.glob("*.py") if "def pseudo(" in p.read_text()}
    # Figures that ask are on the pages of the others, which teaching.py goes through.
    own |= {"asked"} if "teaching" in own else set()
    assert {p.stem for p in (WORDS / "en").glob("*.ts")} - {"index"} <= set(windows) | own, "a window without its check"
    found: list[str] = []
    for name, opened in windows.items():
        watched = Watched(browser, SIZES[0], "light")
        page = watched.opened(served.at("lang=pseudo"))
        page.locator("main.empty").wait_for(timeout=LONG)
        opened(page)
        found += [f"{name}: {text}" for text in page.evaluate(UNMARKED, MARK)]
        assert MARK in page.locator("body").inner_text()
        watched.close(served.address)
    assert not found, sorted(set(found))


SCRIPT = Script(
    "the languages of the workbench",
    ("01_bore", "03_drill_through_shaft", "04_gear_pump_cover"),
    {
        "chooses": lambda s: chooses(s.browser, s.served, s.program),
        "looks": lambda s: looks(s.browser, s.served),
        "pseudo": lambda s: pseudo(s.browser, s.served),
    },
    plain={"catalogues": catalogues},
)

if __name__ == "__main__":
    SCRIPT.main()
