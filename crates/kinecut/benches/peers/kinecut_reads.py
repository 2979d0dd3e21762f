"""kinecut as the judges call it: a program written again for LinuxCNC, or read and described.

Two names stand for a kinecut that is not there: `same` hands the text back as it is, `altered` with one number changed.
"""

import json
import pathlib
import re
import subprocess
import tempfile


class Refused(Exception):
    """The first error: where, and its message."""

    def __init__(self, message, line=None, column=None, code=""):
        super().__init__(message)
        self.message, self.line, self.column, self.code = message, line, column, code

    def __str__(self):
        return f"{self.line}:{self.column} {self.message}"


def altered(text):
    """The number of an axis word in the middle, larger by a tenth."""
    before = lambda m: text[text.rfind("\n", 0, m.start()) + 1:m.start()]
    words = [m for m in re.finditer(r"(?i)(?<![<\w])([XYZ])([-+]?\d+\.?\d*)", text) if not re.search("[;(]", before(m))]
    if not words:
        return re.sub(r"(?im)^(N\d+)?[ \t]*(M0?2|M30|%\s*\Z)", r"G0 X7\n\2", text, count=1)
    word = words[len(words) // 2]
    return text[:word.start()] + f"{word[1]}{float(word[2]) + 0.1:.4f}" + text[word.end():]


class Kinecut:
    def __init__(self, binary, limit=60, tools=None):
        self.binary, self.limit, self.tools = binary, limit, tools

    def run(self, arguments, folder=None):
        try:
            return subprocess.run([self.binary, *map(str, arguments)], capture_output=True, timeout=self.limit, cwd=folder)
        except subprocess.TimeoutExpired:
            raise Refused(f"it does not end within {self.limit} s") from None

    def check(self, path, control, machine=None):
        """What `kinecut check` says of a program."""
        on = ["--machine", machine, "--position", "0,0,0"] if machine else []
        done = self.run(["--json", "check", path, "--control", control, *on])
        return answer(done)

    def post(self, path, to="linuxcnc", control="linuxcnc", decimals=6, folders=(), machine=None, kept=None):
        """The text that it writes again, and what it found; `kept`: folder with the files of the machine, tool.tbl and kept.var."""
        path = pathlib.Path(path)
        if self.binary in ("same", "altered"):
            text = path.read_bytes().decode(errors="replace")
            return (text if self.binary == "same" else altered(text)), {}
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "post.ngc"
            arguments = ["--json", "post", path, "--from", control, "--to", to, "--decimals", decimals, "-o", out]
            arguments += ["--tools", self.tools] if self.tools else []
            arguments += ["--tools", kept / "tool.tbl", "--parameters", kept / "kept.var"] if kept else []
            arguments += [word for folder in folders for word in ("--subprograms", folder)]
            arguments += ["--machine", machine, "--position", "0,0,0"] if machine else []
            found = answer(self.run(arguments))
            if not out.exists():
                raise Refused("no text came out")
            return out.read_text(errors="replace"), found


def answer(done):
    """The JSON of an answer; an error is raised."""
    said = done.stdout.decode(errors="replace")
    try:
        found = json.loads(said)
    except ValueError:
        told = done.stderr.decode(errors="replace")
        if done.returncode < 0 or "panicked" in told:
            raise Refused(f"CRASH, code {done.returncode}: {told.strip()[-300:]}") from None
        place = re.search(r":(\d+):(\d+)", told)
        raise Refused(next((line for line in told.splitlines() if line.strip()), f"code {done.returncode}, no JSON"),
                      *(map(int, place.groups()) if place else ())) from None
    wrong = [f for f in found.get("findings", []) if f.get("severity") == "error"] if isinstance(found, dict) and found.get("errors") else []
    if wrong:
        found = wrong[0]
    if done.returncode not in (0, 1) or isinstance(found, dict) and found.get("severity") == "error" and "message" in found:
        first = found[0] if isinstance(found, list) and found else found
        first = first.get("error", first) if isinstance(first, dict) else {}
        place = first.get("place") or {}
        raise Refused(first.get("message", said[:200]), place.get("line"), place.get("column"), first.get("code", ""))
    return found
