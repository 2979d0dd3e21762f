"""All scripts of this folder, one after another in one browser: python3 all.py KINECUT [SCRIPT ...]. One line for each, with its time; it fails where
one of them fails. Nothing is tried again. Needs and settings: common.py."""

import contextlib
import io
import os
import sys
import time
import traceback
from pathlib import Path

import browser
import drill
import face
import grazing
import hole
import job
import security
import surface
import teaching
import words
from common import Chromium

SCRIPTS = {"words": words, "security": security, "drill": drill, "hole": hole, "face": face, "surface": surface, "grazing": grazing, "teaching": teaching, "browser": browser, "job": job}


def cpu() -> float:
    """Time of processors that this process and those that have ended in it have taken [s]."""
    return sum(os.times()[:4])


def main() -> int:
    program = str(Path(sys.argv[1]).resolve())
    wanted = sys.argv[2:] or list(SCRIPTS)
    unknown = set(wanted) - set(SCRIPTS)
    assert not unknown, f"no script of these names: {', '.join(sorted(unknown))}; there are {', '.join(SCRIPTS)}"
    failed = []
    begun = time.monotonic()
    with Chromium() as chromium:
        for name in wanted:
            said = io.StringIO()
            from_time, from_cpu = time.monotonic(), cpu()
            try:
                with contextlib.redirect_stdout(said):
                    SCRIPTS[name].SCRIPT.run(chromium.browser, program, [])
                state = "as it should be"
            except Exception:
                # Whatever it is: the other scripts are run, and this one is counted.
                state = "NOT as it should be"
                failed.append(name)
                print(said.getvalue() + traceback.format_exc(), end="")
            print(f"{name}: {state}, {time.monotonic() - from_time:.0f} s, of processors without the browser {cpu() - from_cpu:.0f} s", flush=True)
    print(f"{len(wanted) - len(failed)} of {len(wanted)} scripts as they should be, {time.monotonic() - begun:.0f} s" + (f"; failed: {', '.join(failed)}" if failed else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
