"""Changes of a text by the form touch nothing but the value meant: python3 edits.py, with Node beside it. Every value of every example is changed,
taken away and put back; the standard library's reader says what the text holds then, and all other lines and comments stay."""

import copy
import datetime
import json
import subprocess
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXAMPLES = HERE.parents[3] / "examples"
# What stands in texts of people that no example has.
ODD = '''# one
"quoted key" = "a # b \\" c"   # two
'single' = 'raw \\n'
a.b.c = 1 # three
a.b.d = { x = [1, 2,
  3, # inside
  4], "y z" = true }
empty = {}
none = []
big = 1_000
hex = 0xff
long = """
text with = and [brackets]
"""
[t] # four
k = 1

  [t.u]
  m = -2.5e3
[[l]]
v = 1
[[l.m]]
w = 2
[[l]]
v = 3 # five
'''


def leaves(node, path=()):
    if isinstance(node, dict) and node:
        for key, inner in node.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(node, list) and node and isinstance(node[0], (dict, list)):
        for i, inner in enumerate(node):
            yield from leaves(inner, (*path, i))
    else:
        yield path


def holder(node, path):
    for step in path[:-1]:
        node = node[step]
    return node


def asked(text: str) -> list[tuple[dict, dict]]:
    """Operations, and what the text shall hold after each."""
    known = tomllib.loads(text)
    ops = []
    for path in leaves(known):
        for value in (123.5, "x \" y", [1, 2.5], {"a": {"b": True}}):
            want = copy.deepcopy(known)
            holder(want, path)[path[-1]] = value
            ops.append(({"what": "set", "path": path, "value": value}, want))
        want = copy.deepcopy(known)
        if isinstance(path[-1], str):
            del holder(want, path)[path[-1]]
            ops.append(({"what": "remove", "path": path}, want))
            want = copy.deepcopy(known)
            holder(want, path)["brand_new"] = 7
            ops.append(({"what": "set", "path": (*path[:-1], "brand_new"), "value": 7}, want))
            want = copy.deepcopy(known)
            holder(want, path)["fresh"] = {"inner": 8}
            ops.append(({"what": "set", "path": (*path[:-1], "fresh", "inner"), "value": 8}, want))
    for i, setup in enumerate(known.get("setup", [])):
        operations = setup.get("operation", [])
        for k in range(len(operations)):
            want = copy.deepcopy(known)
            del want["setup"][i]["operation"][k]
            if not want["setup"][i]["operation"]:
                del want["setup"][i]["operation"]
            ops.append(({"what": "remove", "path": ["setup", i, "operation", k]}, want))
        want = copy.deepcopy(known)
        want["setup"][i].setdefault("operation", []).append({"type": "bore", "n": 1})
        ops.append(({"what": "append", "path": ["setup", i, "operation"], "value": [["type", "bore"], ["n", 1]]}, want))
    return ops


def main() -> None:
    texts = {str(p.relative_to(EXAMPLES)): p.read_text() for p in sorted(EXAMPLES.glob("*/*.toml"))} | {"odd": ODD}
    all_asked = {name: asked(text) for name, text in texts.items()}
    question = [{"text": text, "ops": [op for op, _ in all_asked[name]]} for name, text in texts.items()]
    done = subprocess.run(["node", str(HERE / "edits.mjs")], input=json.dumps(question), capture_output=True, text=True, check=True)
    count = 0
    for (name, text), answer in zip(texts.items(), json.loads(done.stdout)):
        assert answer["values"] == json.loads(json.dumps(tomllib.loads(text), default=lambda v: v.isoformat() if isinstance(v, datetime.date) else v)), name
        for (op, want), after in zip(all_asked[name], answer["after"]):
            assert after is not None, (name, op)
            try:
                got = tomllib.loads(after)
            except tomllib.TOMLDecodeError as error:
                raise AssertionError((name, op, str(error), after)) from error
            assert got == want, (name, op, after)
            lost = [line for line in text.split("\n") if line.startswith("#") and line not in after.split("\n")]
            assert not lost or op["what"] == "remove", (name, op, lost)
            count += 1
    print(f"{count} changes of {len(texts)} texts: each as meant")


main()
