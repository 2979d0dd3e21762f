//! Requests that have to be refused; after each of them the server still answers.

use std::io::{Read as _, Write as _};
use std::time::{Duration, Instant};

use kinecut_web::Limits;
use serde_json::json;

use crate::common::{Folder, PLATE, Running, reply};

fn plate() -> (Folder, Running) {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let running = Running::of(&folder);
    (folder, running)
}

/// The headers of our own page with one of them replaced; without a value it is left out.
fn but(running: &Running, name: &str, value: Option<&str>) -> Vec<(String, String)> {
    let mut headers = running.own();
    headers.retain(|(own, _)| own != name);
    headers.extend(value.map(|value| (name.to_owned(), value.to_owned())));
    headers
}

#[test]
fn only_the_own_page_reaches_the_api() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let body = json!({ "client": "c", "file": id }).to_string();
    let ask =
        |headers: &[(String, String)]| running.with_headers("POST", "/api/plan", headers, body.as_bytes());
    assert_eq!(ask(&running.own()).status, 200);
    let port = running.port;
    let (other, near) = (format!("evil.example:{port}"), format!("http://127.0.0.1:{}", port ^ 1));
    let wrong = "0".repeat(64);
    for (name, value, status, reason) in [
        ("Host", Some(other.as_str()), 403, "host"),
        ("Host", Some("127.0.0.1"), 403, "host"),
        ("Host", Some(""), 403, "host"),
        ("Origin", Some("http://evil.example"), 403, "origin"),
        ("Origin", Some(near.as_str()), 403, "origin"),
        ("Origin", Some("null"), 403, "origin"),
        ("Origin", None, 403, "origin"),
        ("Sec-Fetch-Site", Some("cross-site"), 403, "site"),
        ("Sec-Fetch-Site", Some("same-site"), 403, "site"),
        ("Authorization", None, 401, "token"),
        ("Authorization", Some("Bearer "), 401, "token"),
        ("Authorization", Some(format!("Bearer {wrong}").as_str()), 401, "token"),
        ("Authorization", Some(running.token.as_str()), 401, "token"),
        ("Content-Type", None, 415, "type"),
        ("Content-Type", Some("text/plain"), 415, "type"),
        ("Content-Type", Some("application/x-www-form-urlencoded"), 415, "type"),
    ] {
        let reply = ask(&but(&running, name, value));
        assert_eq!((reply.status, reply.reason().as_str()), (status, reason), "{name}: {value:?}");
        assert!(reply.header("access-control-allow-origin").is_none(), "{}", reply.head);
        running.still_answers();
    }
}

#[test]
fn a_host_is_there_once() {
    let (_folder, running) = plate();
    let (port, token) = (running.port, &running.token);
    let ask = |hosts: &str, target: &str| {
        let text = format!(
            "GET {target} HTTP/1.1\r\n{hosts}Authorization: Bearer {token}\r\nConnection: close\r\n\r\n"
        );
        running.raw(text.as_bytes()).status
    };
    let own = format!("Host: 127.0.0.1:{port}\r\n");
    assert_eq!(ask(&own, "/api/project"), 200);
    assert_eq!(ask(&format!("Host: localhost:{port}\r\n"), "/api/project"), 200);
    assert_eq!(ask(&format!("Host: [::1]:{port}\r\n"), "/api/project"), 200);
    let refused = |status: u16| status == 403 || status == 400;
    assert!(refused(ask("", "/api/project")));
    assert!(refused(ask(&format!("{own}{own}"), "/api/project")));
    assert!(refused(ask(&format!("{own}Host: evil.example\r\n"), "/api/project")));
    assert!(refused(ask(&own, &format!("http://evil.example:{port}/api/project"))));
    // The page itself is no less guarded: a rebound name does not even get that.
    assert!(refused(ask(&format!("Host: evil.example:{port}\r\n"), "/")));
    running.still_answers();
}

#[test]
fn nothing_outside_of_the_folder_is_given() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    std::fs::write(folder.outside().join("secret.toml"), "secret = 1").unwrap();
    #[cfg(unix)]
    {
        let link = |to: &str, name: &str| {
            std::os::unix::fs::symlink(folder.outside().join(to), folder.opened().join(name))
        };
        link("secret.toml", "link.toml").unwrap();
        link("", "up").unwrap();
    }
    let running = Running::of(&folder);
    let project = running.get("/api/project").json().to_string();
    assert!(!project.contains("secret") && !project.contains("link.toml"), "{project}");
    let secret = kinecut::job::sha256(b"../secret.toml");
    for path in [
        "/api/file/../secret.toml",
        "/api/file/..%2fsecret.toml",
        "/api/file/%2e%2e%2fsecret.toml",
        "/api/file/..%252fsecret.toml",
        "/api/file/%252e%252e%252fsecret.toml",
        "/api/file/link.toml",
        "/api/file/job.toml",
        "/api/file/job.toml%00",
        "/api/file/%00",
        "/api/file/%ff%fe",
        "/api/bytes/..%2fsecret.toml",
        "/assets/../../secret.toml",
        "/assets/..%2f..%2fsecret.toml",
        "/assets/%2e%2e/%2e%2e/secret.toml",
        "/assets//etc/passwd",
        "/assets/%00",
        "/../secret.toml",
        "/%2e%2e/secret.toml",
        "//etc/passwd",
        &format!("/api/file/{}", &secret[..16]),
    ] {
        let reply = running.get(path);
        assert!(matches!(reply.status, 400 | 404), "{path}: {reply:?}");
        assert!(!String::from_utf8_lossy(&reply.body).contains("secret = 1"), "{path}");
    }
    // Neither through what a job names, nor under a name for a new file.
    for name in
        ["../secret.toml", "/etc/hosts", "link.toml", "up/secret.toml", "./../secret.toml", "a\u{0}.toml"]
    {
        let text = format!("machine = {name:?}\n{PLATE}");
        let text = text.replace("\\0", "\\u0000");
        let reply = running.post("/api/plan", &json!({ "client": "c", "new": "x.toml", "text": text }));
        assert_eq!(reply.json()["state"], "wrong", "{name}: {reply:?}");
        assert!(!String::from_utf8_lossy(&reply.body).contains("secret = 1"), "{name}");
        let reply = running.post("/api/file", &json!({ "new": name, "text": "x" }));
        assert!(matches!(reply.status, 400 | 409 | 422), "{name}: {reply:?}");
    }
    assert_eq!(std::fs::read_to_string(folder.outside().join("secret.toml")).unwrap(), "secret = 1");
    running.still_answers();
}

#[test]
fn a_giant_body_is_refused_before_it_is_there() {
    let (_folder, running) = plate();
    let head = |more: &str| {
        let own: String = running.own().iter().map(|(k, v)| format!("{k}: {v}\r\n")).collect();
        format!("POST /api/plan HTTP/1.1\r\n{own}{more}\r\n")
    };
    let begun = Instant::now();
    let reply = running.raw(head(&format!("Content-Length: {}\r\n", 1u64 << 30)).as_bytes());
    assert_eq!((reply.status, reply.reason().as_str()), (413, "size"));
    assert!(begun.elapsed() < Duration::from_secs(2), "it was waited for");
    running.still_answers();
    // In pieces nobody knows how much will come: it ends where the limit is.
    let mut stream = running.connect();
    stream.write_all(head("Transfer-Encoding: chunked\r\n").as_bytes()).unwrap();
    let piece = [b"100000\r\n".as_slice(), &vec![b' '; 1 << 20], b"\r\n"].concat();
    let mut sent = 0;
    while sent < 1024 && stream.write_all(&piece).is_ok() {
        sent += 1;
    }
    assert!(sent < 256, "{sent} MiB were taken");
    // The answer may be lost with the connection, which the server has closed.
    assert!(matches!(self::reply(&mut stream).status, 0 | 413));
    running.still_answers();
}

#[test]
fn a_long_head_is_refused() {
    let (_folder, running) = plate();
    let long =
        format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX: {}\r\n\r\n", running.port, "x".repeat(1 << 20));
    assert!(matches!(running.raw(long.as_bytes()).status, 0 | 431));
    let many: String = (0..5000).map(|i| format!("X-{i}: 1\r\n")).collect();
    let many = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{many}\r\n", running.port);
    assert!(matches!(running.raw(many.as_bytes()).status, 0 | 431));
    let noise: Vec<u8> = (0..100_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    assert!(matches!(running.raw(&noise).status, 0 | 400 | 431));
    running.still_answers();
}

#[test]
fn a_slow_sender_is_not_waited_for() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let running = Running::with(&folder, Limits { reading: Duration::from_millis(400), ..Limits::default() });
    let closed_after = |first: &[u8], drip: &[u8]| {
        let mut stream = running.connect();
        stream.set_read_timeout(Some(Duration::from_millis(20))).unwrap();
        stream.write_all(first).unwrap();
        let begun = Instant::now();
        let mut got = Vec::new();
        let mut buffer = [0; 4096];
        loop {
            assert!(begun.elapsed() < Duration::from_secs(10), "it is still waited for");
            let _ = stream.write_all(drip);
            match stream.read(&mut buffer) {
                Ok(0) => break,
                Ok(n) => got.extend_from_slice(&buffer[..n]),
                Err(e)
                    if matches!(e.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut) => {}
                Err(_) => break,
            }
        }
        (begun.elapsed(), String::from_utf8_lossy(&got).into_owned())
    };
    // A head that comes a byte at a time, and one that never comes.
    let (time, _) = closed_after(b"GET / HTTP/1.1\r\nX: ", b"x");
    assert!(time > Duration::from_millis(300));
    closed_after(b"", b"");
    // The same of a body.
    let own: String = running.own().iter().map(|(k, v)| format!("{k}: {v}\r\n")).collect();
    let head = format!("POST /api/plan HTTP/1.1\r\n{own}Content-Length: 100000\r\n\r\n");
    let (_, answer) = closed_after(head.as_bytes(), b" ");
    assert!(answer.contains(" 408 ") && answer.contains("\"slow\""), "{answer}");
    running.still_answers();
}

#[test]
fn a_thousand_connections_do_not_keep_the_page_out() {
    let (_folder, running) = plate();
    let mut held = Vec::new();
    for i in 0..1000 {
        // The system may run out of places in its queue; those that come through are held.
        if let Ok(mut stream) = std::net::TcpStream::connect(("127.0.0.1", running.port)) {
            if i % 2 == 0 {
                let _ = stream.write_all(b"GET / HTTP/1.1\r\n");
            }
            held.push(stream);
        }
        assert!(running.look.held().connections <= 32);
        if i % 250 == 0 {
            running.still_answers();
        }
    }
    assert!(held.len() > 500, "only {} connections were made", held.len());
    // All of them are still held by the attacker.
    running.still_answers();
    assert!(running.look.held().connections <= 32);
    drop(held);
    running.still_answers();
}

#[test]
fn connections_with_the_token_are_not_pushed_out() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let running = Running::with(&folder, Limits { connections: 4, ..Limits::default() });
    let mut own = running.connect();
    let head = format!(
        "GET /api/project HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\n\r\n",
        running.port, running.token
    );
    let mut ask = || {
        own.write_all(head.as_bytes()).unwrap();
        let mut got = [0; 12];
        own.read_exact(&mut got).unwrap();
        let mut rest = vec![0; 1 << 16];
        let _ = own.read(&mut rest).unwrap();
        String::from_utf8_lossy(&got).into_owned()
    };
    assert_eq!(ask(), "HTTP/1.1 200");
    let _others: Vec<_> = (0..40).map(|_| running.connect()).collect();
    assert_eq!(ask(), "HTTP/1.1 200");
}

#[test]
fn every_answer_has_its_guards() {
    let (_folder, running) = plate();
    for reply in [
        running.get("/"),
        running.get("/api/project"),
        running.get("/nothing"),
        running.raw(b"GET / HTTP/1.1\r\nConnection: close\r\n\r\n"),
    ] {
        if reply.status == 0 {
            continue;
        }
        let policy = reply.header("content-security-policy").unwrap_or_default();
        for part in [
            "default-src 'none'",
            "script-src 'self';",
            "frame-ancestors 'none'",
            "base-uri 'none'",
            "form-action 'none'",
        ] {
            assert!(policy.contains(part), "{}", reply.head);
        }
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-opener-policy", "same-origin"),
            ("cross-origin-resource-policy", "same-origin"),
        ] {
            assert_eq!(reply.header(name), Some(value), "{}", reply.head);
        }
        assert!(!reply.head.to_ascii_lowercase().contains("access-control"), "{}", reply.head);
        assert!(reply.header("set-cookie").is_none());
    }
    // A question before a request of another site gets no permission.
    let headers = vec![
        ("Host".to_owned(), format!("127.0.0.1:{}", running.port)),
        ("Origin".to_owned(), "http://evil.example".to_owned()),
        ("Access-Control-Request-Method".to_owned(), "POST".to_owned()),
    ];
    let reply = running.with_headers("OPTIONS", "/api/plan", &headers, b"");
    assert_eq!(reply.status, 403);
    assert!(!reply.head.to_ascii_lowercase().contains("access-control"), "{}", reply.head);
}

#[test]
fn words_that_nobody_reads_are_refused() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    for body in [
        json!({ "client": "c", "file": id, "setp": 1 }),
        json!({ "client": "c" }),
        json!({ "client": "../c", "file": id }),
        json!({ "client": "c", "file": id, "new": "a.toml", "text": "" }),
        json!({ "client": "c", "file": id, "generation": -1 }),
        json!([1, 2]),
    ] {
        let reply = running.post("/api/plan", &body);
        assert_eq!((reply.status, reply.reason().as_str()), (400, "request"), "{body}");
    }
    let deep = "[".repeat(200_000);
    assert_eq!(running.with_headers("POST", "/api/plan", &running.own(), deep.as_bytes()).status, 400);
    running.still_answers();
}
