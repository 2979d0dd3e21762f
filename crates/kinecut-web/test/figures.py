"""Figures of the papers as a script reads and sets them: their numbers, fields, papers; and the program at the shell beside them."""

import math
from pathlib import Path

from common import EXAMPLES, LONG, shell
from playwright.sync_api import Page


class Verb:
    """The program at the shell."""

    def __init__(self, program: str):
        self.program = program

    def __call__(self, *arguments: str, text: str, folder: Path = EXAMPLES) -> dict:
        return shell(self.program, *arguments, text=text, folder=folder)


def figure(page: Page, name: str):
    return page.locator(f'[data-figure="{name}"]')


def plain(text: str) -> float:
    """A number as the page shows it."""
    text = text.strip().replace("\u2212", "-").replace(",", ".")
    if "·10" in text:
        mantissa, power = text.split("·10")
        return float(mantissa) * 10 ** int(power.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")))
    return float(text)


def settled(page: Page, name: str | None = None) -> None:
    """Figures that ask kinecut have their answers: one, or all of the page."""
    page.wait_for_function(
        """name => [...document.querySelectorAll(name ? `[data-figure="${name}"]` : ".tg .figure")].every((f) => !["waits", "older"].includes(f.dataset.is) && !f.dataset.more)""", arg=name, timeout=LONG
    )


def told(page: Page, name: str, key: str) -> str:
    settled(page, name)
    return figure(page, name).locator(f'[data-number="{key}"]').inner_text()


def number(page: Page, name: str, key: str) -> float:
    return plain(told(page, name, key))


def put(page: Page, name: str, **values: float) -> None:
    for key, value in values.items():
        field = figure(page, name).locator(f'[data-field="{key}"]')
        if field.evaluate("e => e.tagName") == "SELECT":
            field.select_option(str(value))
        else:
            field.fill(str(value))


def same(page: Page, name: str, key: str, wanted: float) -> None:
    """The number of the page is the one that is wanted, rounded to the digits that are shown."""
    text = told(page, name, key)
    if "·10" in text:
        assert math.isclose(plain(text), wanted, rel_tol=1e-3), (name, key, text, wanted)
        return
    decimals = len(text.replace(",", ".").partition(".")[2])
    assert abs(plain(text) - wanted) <= 0.5001 * 10**-decimals, (name, key, text, wanted)


def reset(page: Page, name: str) -> None:
    figure(page, name).locator("[data-reset]").click()


def choose(page: Page, paper: int) -> None:
    page.locator('[data-choose="paper"]').select_option(str(paper))
    page.locator(f'.tg[data-paper="{paper}"]').wait_for()
    settled(page)
