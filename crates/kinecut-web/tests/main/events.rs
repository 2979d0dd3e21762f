//! What the server tells by itself.

use std::io::{BufRead as _, BufReader, Write as _};
use std::net::TcpStream;
use std::time::Duration;

use kinecut_web::Limits;
use serde_json::{Value, json};

use crate::common::{Folder, PLATE, Running, until};

/// The events of a client, one after the other.
struct Listener(BufReader<TcpStream>);

impl Listener {
    fn of(running: &Running, client: &str) -> Listener {
        let mut stream = running.connect();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        let head = format!(
            "GET /api/events?client={client} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\n\r\n",
            running.port, running.token
        );
        let before = running.look.held().listening;
        stream.write_all(head.as_bytes()).unwrap();
        until("it listens", || running.look.held().listening > before);
        Listener(BufReader::new(stream))
    }

    /// The next event of a name.
    fn next(&mut self, name: &str) -> Value {
        let wanted = format!("event: {name}");
        loop {
            let mut line = String::new();
            assert!(self.0.read_line(&mut line).unwrap() > 0, "the stream ended before `{name}`");
            if line.trim_end() == wanted {
                let mut data = String::new();
                self.0.read_line(&mut data).unwrap();
                return serde_json::from_str(data.strip_prefix("data: ").unwrap()).unwrap();
            }
        }
    }
}

#[test]
fn progress_goes_to_who_asked_and_changes_go_to_all() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let limits = Limits { looking: Duration::from_millis(50), ..Limits::default() };
    let mut running = Running::with(&folder, limits);
    let id = running.id("job.toml");
    let (mut first, mut other) = (Listener::of(&running, "a"), Listener::of(&running, "b"));
    running.post("/api/simulate", &json!({ "client": "a", "generation": 3, "file": id, "step": 0.5 }));
    let progress = first.next("progress");
    assert_eq!(
        (&progress["client"], &progress["kind"], &progress["generation"]),
        (&json!("a"), &json!("simulate"), &json!(3))
    );
    assert!(progress["stage"].is_string() && progress["done"].as_u64() <= progress["of"].as_u64());
    let end = first.next("end");
    assert_eq!((&end["state"], &end["file"]), (&json!("done"), &json!(id)));
    // Another program writes the file.
    let edited = PLATE.replace("depth = 6", "depth = 5");
    until("the first look", || {
        std::thread::sleep(Duration::from_millis(200));
        true
    });
    folder.write("job.toml", &edited);
    for listener in [&mut first, &mut other] {
        let changed = listener.next("changed");
        assert_eq!((&changed["id"], &changed["name"]), (&json!(id), &json!("job.toml")));
        assert_eq!(changed["sha256"], kinecut::job::sha256(edited.as_bytes()));
    }
    // The page saves, and the other program puts its own back before the next look: the bytes are those that were seen last.
    let saved = running.send(
        "PUT",
        &format!("/api/file/{id}"),
        &json!({ "text": PLATE, "sha256": kinecut::job::sha256(edited.as_bytes()) }),
    );
    assert_eq!(saved.status, 200, "{}", saved.json());
    folder.write("job.toml", &edited);
    assert_eq!(other.next("changed")["sha256"], kinecut::job::sha256(edited.as_bytes()));
    folder.write("more.toml", "x = 1");
    other.next("files");
    std::fs::remove_file(folder.opened().join("job.toml")).unwrap();
    assert_eq!(other.next("changed")["sha256"], Value::Null);
    running.end();
    first.next("bye");
}
