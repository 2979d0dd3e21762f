//! Files listed, read and saved.

use std::fs;

use kinecut::job::sha256;
use serde_json::json;

use crate::common::{Folder, PLATE, Running};

#[test]
fn files_are_listed_with_their_kinds_and_read() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    folder.write("sub/O1007.nc", "G0 X0\n");
    folder.write("part.stl", "solid x\nendsolid x\n");
    folder.write(".hidden.toml", "x = 1");
    folder.write("program.exe", "x");
    let running = Running::of(&folder);
    let project = running.get("/api/project").json();
    let files: Vec<_> = project["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| (f["name"].as_str(), f["kind"].as_str()))
        .collect();
    let wanted = [("job.toml", "job"), ("part.stl", "mesh"), ("sub/O1007.nc", "program")];
    assert_eq!(files, wanted.map(|(n, k)| (Some(n), Some(k))));
    assert_eq!((project["folder"].as_str(), project["protocol"].as_u64()), (Some("opened"), Some(1)));
    let read = running.get(&format!("/api/file/{}", running.id("job.toml"))).json();
    assert_eq!(read["text"], PLATE);
    assert_eq!(read["sha256"], sha256(PLATE.as_bytes()));
    let bytes = running.get(&format!("/api/bytes/{}", running.id("part.stl")));
    assert_eq!((bytes.status, bytes.body.as_slice()), (200, b"solid x\nendsolid x\n".as_slice()));
    assert_eq!(running.get("/api/file/0123456789abcdef").status, 404);
}

#[test]
fn a_file_is_saved_only_over_what_was_read() {
    let folder = Folder::new();
    folder.write("job.toml", "a = 1");
    let running = Running::of(&folder);
    let path = format!("/api/file/{}", running.id("job.toml"));
    let hash = |text: &str| json!(sha256(text.as_bytes()));
    let saved = running.send("PUT", &path, &json!({ "text": "a = 2", "sha256": hash("a = 1") }));
    assert_eq!((saved.status, saved.json()["sha256"].clone()), (200, hash("a = 2")));
    assert_eq!(folder.read("job.toml"), "a = 2");
    // Another program writes it meanwhile.
    folder.write("job.toml", "a = 3");
    let refused = running.send("PUT", &path, &json!({ "text": "a = 4", "sha256": hash("a = 2") }));
    assert_eq!((refused.status, refused.reason().as_str()), (409, "changed"));
    let refused = refused.json();
    assert_eq!((&refused["disk"]["text"], &refused["yours"]), (&json!("a = 3"), &json!("a = 4")));
    assert_eq!(folder.read("job.toml"), "a = 3");
    // Mine is kept by saying what it replaces.
    let kept = running.send("PUT", &path, &json!({ "text": "a = 4", "sha256": refused["disk"]["sha256"] }));
    assert_eq!((kept.status, folder.read("job.toml").as_str()), (200, "a = 4"));
    // A file that has gone is made again only if that is said.
    fs::remove_file(folder.opened().join("job.toml")).unwrap();
    let gone = running.send("PUT", &path, &json!({ "text": "a = 5", "sha256": hash("a = 4") }));
    assert_eq!((gone.status, gone.json()["disk"]["sha256"].clone()), (409, json!(null)));
}

#[test]
fn a_new_file_replaces_none() {
    let folder = Folder::new();
    folder.write("sub/job.toml", PLATE);
    let running = Running::of(&folder);
    let beside = running.id("sub/job.toml");
    let made = running.post("/api/file", &json!({ "new": "PLATE.NGC", "beside": beside, "text": "G0" }));
    assert_eq!((made.status, made.json()["name"].as_str()), (200, Some("sub/PLATE.NGC")));
    assert_eq!((folder.read("sub/PLATE.NGC").as_str(), running.id("sub/PLATE.NGC").len()), ("G0", 16));
    let again = running.post("/api/file", &json!({ "new": "PLATE.NGC", "beside": beside, "text": "G1" }));
    assert_eq!((again.status, again.reason().as_str()), (409, "exists"));
    assert_eq!(folder.read("sub/PLATE.NGC"), "G0");
    // Bytes that are no text come in base64.
    let made = running.post("/api/file", &json!({ "new": "O7.NC", "base64": "RzD/Cg==" }));
    assert_eq!((made.status, fs::read(folder.opened().join("O7.NC")).unwrap()), (200, b"G0\xff\n".to_vec()));
    let both = json!({ "new": "O8.NC", "base64": "RzA=", "text": "G0" });
    for asked in [json!({ "new": "O8.NC", "base64": "R*" }), json!({ "new": "O8.NC" }), both] {
        assert_eq!(running.post("/api/file", &asked).status, 400, "{asked}");
    }
    assert!(!folder.opened().join("O8.NC").exists());
}

#[cfg(unix)]
#[test]
fn a_saved_file_keeps_its_rights_and_a_link_stays_one() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = Folder::new();
    folder.write("job.toml", "a = 1");
    folder.write("real.toml", "b = 1");
    folder.write("fixed.toml", "c = 1");
    let place = |name: &str| folder.opened().join(name);
    symlink("real.toml", place("link.toml")).unwrap();
    let rights =
        |name: &str, mode| fs::set_permissions(place(name), fs::Permissions::from_mode(mode)).unwrap();
    rights("job.toml", 0o640);
    rights("fixed.toml", 0o444);
    let running = Running::of(&folder);
    let save = |name: &str, before: &str| {
        let asked = json!({ "text": "x = 2", "sha256": sha256(before.as_bytes()) });
        running.send("PUT", &format!("/api/file/{}", running.id(name)), &asked).status
    };
    assert_eq!(save("job.toml", "a = 1"), 200);
    assert_eq!(place("job.toml").metadata().unwrap().permissions().mode() & 0o777, 0o640);
    assert_eq!(save("link.toml", "b = 1"), 200);
    assert!(place("link.toml").is_symlink() && folder.read("real.toml") == "x = 2");
    assert_eq!(save("fixed.toml", "c = 1"), 422);
    assert_eq!(folder.read("fixed.toml"), "c = 1");
    // Nothing is left beside them.
    let names: Vec<_> = fs::read_dir(folder.opened()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
}
