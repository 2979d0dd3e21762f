//! A running server, and requests to it byte by byte.

use std::fs;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use kinecut_web::{Limits, Look, Server, ServerWants, Stop};
use serde_json::Value;

/// A small job.
pub(crate) const PLATE: &str = r#"format = 1
stock = { box = { min = [0, 0, -10], max = [40, 30, 0] } }
post = { control = "linuxcnc" }
tool = [{ number = 1, type = "drill", diameter = 8, point_angle = 118, flute_length = 40, teeth = 2 }]
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
"#;

/// A folder that is removed at the end.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> Folder {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("kinecut-web-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(path.join("opened")).unwrap();
        Folder(path)
    }

    /// The folder that is opened; what lies beside it is outside.
    pub(crate) fn opened(&self) -> PathBuf {
        self.0.join("opened")
    }

    pub(crate) fn outside(&self) -> &Path {
        &self.0
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        let place = self.opened().join(name);
        fs::create_dir_all(place.parent().unwrap()).unwrap();
        fs::write(place, text).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.opened().join(name)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A server that runs.
pub(crate) struct Running {
    pub(crate) port: u16,
    pub(crate) token: String,
    pub(crate) look: Look,
    stop: Stop,
    thread: Option<JoinHandle<std::io::Result<()>>>,
}

/// An answer.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Reply {
    pub(crate) fn json(&self) -> Value {
        let text = String::from_utf8_lossy(&self.body);
        serde_json::from_slice(&self.body).unwrap_or_else(|e| panic!("{e}: {} {text}", self.head))
    }

    /// The word that says why a request was refused.
    pub(crate) fn reason(&self) -> String {
        self.json()["error"]["reason"].as_str().unwrap_or_default().to_owned()
    }

    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        let lines = self.head.lines().filter_map(|line| line.split_once(": "));
        lines.into_iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, value)| value)
    }
}

impl Running {
    pub(crate) fn of(folder: &Folder) -> Running {
        Running::with(folder, Limits::default())
    }

    pub(crate) fn with(folder: &Folder, limits: Limits) -> Running {
        let server =
            Server::bind(&folder.opened(), &ServerWants { limits, ..ServerWants::default() }).unwrap();
        let (port, token) = (server.port(), server.token().as_str().to_owned());
        let (look, stop) = (server.look(), server.stop());
        let thread = std::thread::Builder::new().spawn(move || server.run()).unwrap();
        Running { port, token, look, stop, thread: Some(thread) }
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        stream
    }

    /// What comes back for these bytes.
    pub(crate) fn raw(&self, bytes: &[u8]) -> Reply {
        let mut stream = self.connect();
        // The server may have answered and closed before all was sent.
        let _ = stream.write_all(bytes);
        reply(&mut stream)
    }

    /// The headers of our own page.
    pub(crate) fn own(&self) -> Vec<(String, String)> {
        let pair = |k: &str, v: String| (k.to_owned(), v);
        vec![
            pair("Host", format!("127.0.0.1:{}", self.port)),
            pair("Origin", format!("http://127.0.0.1:{}", self.port)),
            pair("Sec-Fetch-Site", "same-origin".to_owned()),
            pair("Authorization", format!("Bearer {}", self.token)),
            pair("Content-Type", "application/json".to_owned()),
        ]
    }

    /// A request with these headers.
    pub(crate) fn with_headers(
        &self,
        method: &str,
        path: &str,
        headers: &[(String, String)],
        body: &[u8],
    ) -> Reply {
        let mut text = format!("{method} {path} HTTP/1.1\r\nConnection: close\r\n");
        headers.iter().for_each(|(k, v)| text += &format!("{k}: {v}\r\n"));
        text += &format!("Content-Length: {}\r\n\r\n", body.len());
        self.raw(&[text.as_bytes(), body].concat())
    }

    pub(crate) fn get(&self, path: &str) -> Reply {
        self.with_headers("GET", path, &self.own(), b"")
    }

    pub(crate) fn send(&self, method: &str, path: &str, body: &Value) -> Reply {
        self.with_headers(method, path, &self.own(), body.to_string().as_bytes())
    }

    pub(crate) fn post(&self, path: &str, body: &Value) -> Reply {
        self.send("POST", path, body)
    }

    /// The identifier of a file.
    pub(crate) fn id(&self, name: &str) -> String {
        let project = self.get("/api/project").json();
        let files = project["files"].as_array().unwrap().iter();
        let mut own = files.filter(|file| file["name"] == name);
        own.next().unwrap_or_else(|| panic!("{name} is not listed: {project}"))["id"]
            .as_str()
            .unwrap()
            .to_owned()
    }

    /// Whether a request of our own page is answered, at once.
    pub(crate) fn still_answers(&self) {
        let begun = Instant::now();
        let reply = self.get("/api/project");
        assert_eq!(reply.status, 200, "{reply:?}");
        assert!(begun.elapsed() < Duration::from_secs(5));
    }

    /// Stops it and waits for its end.
    pub(crate) fn end(&mut self) {
        self.stop.now();
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap().unwrap();
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop.now();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The answer that a connection gives; status 0 where it gives none.
pub(crate) fn reply(stream: &mut TcpStream) -> Reply {
    let mut all = Vec::new();
    let _ = stream.read_to_end(&mut all);
    let end = all.windows(4).position(|w| w == b"\r\n\r\n").unwrap_or(all.len());
    let head = String::from_utf8_lossy(&all[..end]).into_owned();
    let status = head.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
    let body = all.get(end + 4..).unwrap_or_default().to_vec();
    let chunked = head.to_ascii_lowercase().contains("transfer-encoding: chunked");
    Reply { status, head, body: if chunked { joined(&body) } else { body } }
}

/// A body without the sizes of its pieces.
fn joined(mut body: &[u8]) -> Vec<u8> {
    let mut all = Vec::new();
    while let Some(line) = body.windows(2).position(|w| w == b"\r\n") {
        let size = usize::from_str_radix(std::str::from_utf8(&body[..line]).unwrap().trim(), 16).unwrap();
        let piece = &body[line + 2..];
        if size == 0 || piece.len() < size {
            break;
        }
        all.extend_from_slice(&piece[..size]);
        body = &piece[size + 2..];
    }
    all
}

/// Waits until something is so.
pub(crate) fn until(what: &str, mut is: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is() {
        assert!(begun.elapsed() < Duration::from_secs(60), "waited for: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}
