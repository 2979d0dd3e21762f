"""Attacks on the workbench from pages in a real browser: python3 security.py KINECUT. None reads, none writes, and the own page goes on. Needs and
settings: common.py."""

import hashlib
import http.server
import os
import re
import threading

from common import EVIL, Script, Stage

SECRET = "secret-of-the-folder"

# What a page of others may try. Each gives what it could read, or nothing.
ATTACK = """async ({ base, id, token, sha256 }) => {
  const got = {};
  const attempt = async (name, what) => {
    try { got[name] = String(await what()); } catch (e) { got[name] = ""; }
  };
  const body = JSON.stringify({ text: "written by others", sha256 });
  const text = async (url, options) => {
    const answer = await fetch(url, options);
    return answer.ok || answer.type === "opaque" ? await answer.text() : "";
  };
  const bearer = { Authorization: `Bearer ${token}` };
  await attempt("read", () => text(`${base}/api/project`));
  await attempt("read, no cors", () => text(`${base}/api/project`, { mode: "no-cors" }));
  await attempt("read with the token", () => text(`${base}/api/file/${id}`, { headers: bearer }));
  await attempt("page", () => text(`${base}/`));
  await attempt("simple post", () => text(`${base}/api/file/${id}`, { method: "POST", mode: "no-cors", body }));
  await attempt("simple post of a new file", () =>
    text(`${base}/api/file`, { method: "POST", mode: "no-cors", body: JSON.stringify({ new: "evil.toml", text: "x" }) }));
  await attempt("put", () => text(`${base}/api/file/${id}`, { method: "PUT", body }));
  await attempt("put with the token", () =>
    text(`${base}/api/file/${id}`, { method: "PUT", body, headers: { ...bearer, "Content-Type": "application/json" } }));
  await attempt("post with the token", () =>
    text(`${base}/api/file`, { method: "POST", body: JSON.stringify({ new: "evil.toml", text: "x" }), headers: { ...bearer, "Content-Type": "application/json" } }));
  await attempt("beacon", () => { navigator.sendBeacon(`${base}/api/file`, body); return ""; });
  await attempt("events", () => new Promise((done) => {
    const events = new EventSource(`${base}/api/events?client=evil`);
    events.onopen = () => done("open");
    events.onerror = () => done("");
  }));
  await attempt("socket", () => new Promise((done) => {
    const socket = new WebSocket(`${base.replace("http", "ws")}/api/events`);
    socket.onopen = () => done("open");
    socket.onerror = () => done("");
  }));
  await attempt("script", () => new Promise((done) => {
    const script = document.createElement("script");
    script.src = `${base}/api/schema/job`;
    script.onload = () => done("loaded");
    script.onerror = () => done("");
    document.head.append(script);
  }));
  await attempt("picture", () => new Promise((done) => {
    const picture = new Image();
    picture.onload = () => done("loaded");
    picture.onerror = () => done("");
    picture.src = `${base}/assets/icon.svg`;
  }));
  await attempt("form", () => new Promise((done) => {
    const form = document.createElement("form");
    const frame = document.createElement("iframe");
    frame.name = "sink";
    document.body.append(frame, form);
    Object.assign(form, { action: `${base}/api/file`, method: "POST", enctype: "text/plain", target: "sink" });
    const field = document.createElement("input");
    field.name = '{"new":"evil.toml","text":"x","a":"';
    field.value = '"}';
    form.append(field);
    form.submit();
    setTimeout(() => done(""), 500);
  }));
  await attempt("frame", () => new Promise((done) => {
    const frame = document.createElement("iframe");
    document.body.append(frame);
    frame.onload = () => {
      // A page that may be framed is one of another origin here; one that may not is an error page.
      try { done(frame.contentDocument?.body?.textContent ?? ""); } catch { done(""); }
    };
    frame.src = `${base}/`;
  }));
  return got;
}"""


class Others(http.server.BaseHTTPRequestHandler):
    """The page of an attacker."""

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!doctype html><title>others</title><body>")

    def log_message(self, *_):
        pass


def check(what: str, is_so: bool) -> None:
    assert is_so, what
    print(f"  {what}")


def own_page(browser, base, token, name):
    """What the page of the workbench reads, and what the console says."""
    page = browser.new_page()
    said = []
    page.on("console", lambda message: said.append(message.text))
    answer = page.goto(base + "/")
    read = page.evaluate(
        """async (token) => {
          const headers = { Authorization: `Bearer ${token}` };
          const answer = await fetch("/api/project", { headers });
          return (await answer.json()).files;
        }""",
        token,
    )
    page.close()
    own = next(file for file in read if file["name"] == name)
    return answer, own["id"], [text for text in said if "Content Security Policy" in text]


def attacks(stage: Stage) -> None:
    browser, folder = stage.browser, stage.served.folder
    base, token = stage.served.address.split("/#token=")
    port = base.rsplit(":", 1)[1]
    for name in folder.iterdir():
        name.unlink()
    file = folder / "job.toml"
    text = f"# {SECRET}\nformat = 1\n"
    file.write_text(text)
    others = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Others)
    threading.Thread(target=others.serve_forever, daemon=True).start()
    other_port = others.server_address[1]

    def untouched(what: str) -> None:
        check(f"{what}: nothing was written", file.read_text() == text and os.listdir(folder) == ["job.toml"])

    try:
        answer, own, policy = own_page(browser, base, token, "job.toml")
        check("the own page reads the folder", bool(own))
        check("no message about its policy", not policy)
        headers = answer.headers
        check("its policy has a nonce of its own", bool(re.search(r"'nonce-[0-9a-f]{32}'", headers["content-security-policy"])))
        given = {"base": base, "id": own, "token": token, "sha256": hashlib.sha256(text.encode()).hexdigest()}
        # Pages of another port, of another name, and of localhost, which is another origin than 127.0.0.1.
        for origin in (f"http://127.0.0.1:{other_port}", f"http://{EVIL}:{other_port}", f"http://localhost:{other_port}"):
            page = browser.new_page()
            page.goto(origin)
            for name, got in page.evaluate(ATTACK, given).items():
                check(f"{origin}: {name} gives nothing", got == "")
            page.close()
            untouched(origin)
        # A name that was bound to this machine after its page was loaded: the page is of one origin with the server then.
        page = browser.new_page()
        page.route(
            re.compile(rf"http://{EVIL}:{port}/start"),
            lambda route: route.fulfill(body="<!doctype html><title>rebound</title><body>", content_type="text/html"),
        )
        page.goto(f"http://{EVIL}:{port}/start")
        for name, got in page.evaluate(ATTACK, {**given, "base": f"http://{EVIL}:{port}"}).items():
            check(f"rebound name: {name} gives nothing", SECRET not in got and got == "")
        status = page.evaluate("fetch('/api/project', {headers: {Authorization: 'Bearer ' + '%s'}}).then(a => a.status)" % token)
        check("rebound name: refused even with the token", status == 403)
        check("rebound name: the page is refused", page.goto(f"http://{EVIL}:{port}/").status == 403)
        page.close()
        untouched("rebound name")
        # A window that another page opens keeps no hold of it.
        page = browser.new_page()
        page.goto(f"http://127.0.0.1:{other_port}")
        with page.expect_popup() as popup:
            page.evaluate("(base) => { window.got = window.open(base + '/'); }", base)
        popup.value.wait_for_load_state()
        check("an opened window is closed to its opener", page.evaluate("window.got.closed || !window.got.length"))
        page.close()
        # The own origin without the token.
        page = browser.new_page()
        page.goto(base + "/")
        status = page.evaluate("fetch('/api/project').then(a => a.status)")
        check("without the token: refused", status == 401)
        _, again, _ = own_page(browser, base, token, "job.toml")
        check("the own page goes on", again == own)
        check("it still runs", stage.served.process.poll() is None)
    finally:
        others.shutdown()


SCRIPT = Script("the guards of the workbench", (), {"attacks": attacks})

if __name__ == "__main__":
    SCRIPT.main()
