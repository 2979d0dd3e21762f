//! Writing that is cut short, on disks that fail.

use std::fs::{self, File};
use std::path::Path;

use super::super::{Proof, Verdict, verify};
use super::*;
use crate::base::{DiskLoader, Loader as _, Silent};

/// A disk that fails from some step on: with an error, or as a machine that was switched off.
struct Failing {
    steps_left: usize,
    /// Removes nothing either, as a killed process.
    dies: bool,
    kind: io::ErrorKind,
    failed: bool,
    /// Fails at one step only.
    once: bool,
    /// The places renamed to, and the waits for the disk, in order.
    log: Vec<String>,
}

impl Failing {
    fn after(steps: usize, dies: bool) -> Failing {
        let log = Vec::new();
        Failing { steps_left: steps, dies, kind: io::ErrorKind::StorageFull, failed: false, once: false, log }
    }

    fn step(&mut self) -> io::Result<()> {
        if self.steps_left == 0 {
            self.failed = true;
            if self.once {
                self.steps_left = usize::MAX;
            }
            return Err(self.kind.into());
        }
        self.steps_left -= 1;
        Ok(())
    }
}

impl Disk for Failing {
    fn create(&mut self, folder: &Path) -> io::Result<(PathBuf, File)> {
        self.step()?;
        RealDisk.create(folder)
    }

    fn fill(&mut self, mut file: File, bytes: &[u8]) -> io::Result<()> {
        use std::io::Write as _;
        self.step()?;
        // Written in three pieces, each of which may be the last.
        for piece in bytes.chunks(bytes.len().div_ceil(3).max(1)) {
            file.write_all(piece)?;
            self.step()?;
        }
        Ok(())
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        self.step()?;
        self.log.push(to.file_name().unwrap().to_string_lossy().into_owned());
        RealDisk.rename(from, to)
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        if self.dies && self.failed {
            return Err(self.kind.into());
        }
        RealDisk.remove(path)
    }

    fn settle(&mut self, folder: &Path) {
        if self.step().is_ok() {
            self.log.push("settle".into());
            RealDisk.settle(folder);
        }
    }
}

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("kinecut-output-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Outputs of a run: five files and their verdict; `mark` tells whose they are.
fn outputs(mark: &str) -> Outputs {
    let mut outputs = Outputs::default();
    for name in ["a.ngc", "plan.json", "part.stl", "part.glb", "report.html"] {
        outputs.add(name, format!("{name} of {mark}: {}", mark.repeat(7)));
    }
    let proof = Proof { claim: format!("held by {mark}"), bound: "0 mm".into() };
    let verdict = Verdict::new(Vec::new(), &[], Vec::new(), vec![proof], Vec::new(), Vec::new());
    let verdict = verdict.with_outputs(outputs.files());
    outputs.seal("verdict.json", verdict.to_json());
    outputs
}

/// Whether the verdict in the folder is there and holds.
fn is_valid(folder: &Path) -> bool {
    verify(&folder.join("verdict.json"), None).is_ok_and(|v| v.holds())
}

/// Owner of the files in the folder; `None` if they are mixed or missing.
fn owner(folder: &Path) -> Option<String> {
    let mut owners = ["a.ngc", "plan.json", "part.stl", "part.glb", "report.html"].map(|name| {
        let text = fs::read_to_string(folder.join(name)).unwrap_or_default();
        let whole = |mark: &&str| text == format!("{name} of {mark}: {}", mark.repeat(7));
        ["old", "new"].into_iter().find(whole).map(str::to_owned)
    });
    let first = owners[0].take();
    owners[1..].iter().all(|o| *o == first).then_some(first).flatten()
}

fn leftovers(folder: &Path) -> usize {
    fs::read_dir(folder)
        .unwrap()
        .flatten()
        .filter(|e| e.file_name().to_string_lossy().starts_with('.'))
        .count()
}

/// Steps of a run that is not cut short.
fn steps() -> usize {
    let folder = folder("steps");
    outputs("old").write(&folder).unwrap();
    let mut disk = Failing::after(usize::MAX, true);
    outputs("new").write_on(&mut disk, &folder).unwrap();
    fs::remove_dir_all(folder).unwrap();
    usize::MAX - disk.steps_left
}

#[test]
fn a_run_killed_at_any_step_leaves_no_valid_verdict_beside_other_bytes() {
    let steps = steps();
    assert!(steps > 35, "{steps}");
    let folder = folder("killed");
    let (mut kills, mut none, mut old, mut new) = (0, 0, 0, 0);
    // Over an old run, over nothing, and over what an earlier kill has left.
    for round in 0..5 {
        for step in 0..=steps {
            if round != 4 {
                let _ = fs::remove_dir_all(&folder);
                fs::create_dir_all(&folder).unwrap();
            }
            if round < 3 {
                outputs("old").write(&folder).unwrap();
            }
            let _ = outputs("new").write_on(&mut Failing::after(step, true), &folder);
            kills += 1;
            match is_valid(&folder) {
                false => none += 1,
                true => match owner(&folder).as_deref() {
                    Some("old") => old += 1,
                    Some("new") => new += 1,
                    other => panic!("round {round}, step {step}: a valid verdict beside files of {other:?}"),
                },
            }
        }
    }
    assert!(kills >= 200 && none > 30 && old > 50 && new > 0, "{kills} kills: {none}, {old}, {new}");
    // The next run puts all in order.
    outputs("new").write(&folder).unwrap();
    assert_eq!((is_valid(&folder), owner(&folder).as_deref(), leftovers(&folder)), (true, Some("new"), 0));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_disk_that_gets_full_leaves_no_temporary_file_and_a_verdict_only_of_what_is_there() {
    let folder = folder("full");
    let mut kept = 0;
    for step in 0..steps() {
        outputs("old").write(&folder).unwrap();
        let result = outputs("new").write_on(&mut Failing::after(step, false), &folder);
        assert_eq!(leftovers(&folder), 0, "step {step}");
        if result.is_err() && owner(&folder).as_deref() == Some("old") && is_valid(&folder) {
            kept += 1;
        }
        assert!(!is_valid(&folder) || owner(&folder).is_some(), "step {step}");
    }
    assert!(kept > 25, "an old run stays whole while nothing of it was replaced: {kept}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_link_at_a_temporary_name_is_not_followed() {
    let folder = folder("link");
    fs::write(folder.join("victim"), "mine").unwrap();
    // All names that the next files could get, and the old fixed ones.
    for n in 0..200 {
        let name = format!(".kinecut-{}-{n}.part", std::process::id());
        link(&folder.join("victim"), &folder.join(name));
    }
    link(&folder.join("victim"), &folder.join(".report.html.part"));
    outputs("new").write_on(&mut RealDisk, &folder).unwrap();
    assert_eq!(fs::read_to_string(folder.join("victim")).unwrap(), "mine");
    assert!(is_valid(&folder));
    // They count as leftovers: the links go, what they lead to stays.
    outputs("new").write(&folder).unwrap();
    assert_eq!(fs::read_to_string(folder.join("victim")).unwrap(), "mine");
    assert_eq!(leftovers(&folder), 1, "what is not ours stays");
    // A link in the place of the lock is refused, not followed.
    link(&folder.join("victim"), &folder.join(".kinecut.lock"));
    let error = outputs("new").write(&folder).unwrap_err();
    assert_eq!(error.code(), Code::OUTPUT_NOT_WRITTEN);
    fs::remove_dir_all(folder).unwrap();
}

#[cfg(unix)]
fn link(to: &Path, at: &Path) {
    std::os::unix::fs::symlink(to, at).unwrap();
}

#[cfg(not(unix))]
fn link(_: &Path, _: &Path) {}

#[test]
fn who_waits_too_long_is_told_and_writes_nothing() {
    let folder = folder("busy");
    let held = Turn::wait(&folder, &Silent).unwrap();
    let error = Turn::wait_for(&folder, &Silent, 3).err().unwrap();
    assert_eq!(error.code(), Code::OUTPUT_BUSY);
    struct Stopped;
    impl Progress for Stopped {
        fn stage(&self, _: &str, _: u64) {}
        fn advance(&self, _: u64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    assert_eq!(outputs("new").write_with(&folder, &Stopped).unwrap_err().code(), Code::CANCELLED);
    assert!(!folder.join("a.ngc").exists());
    drop(held);
    outputs("new").write(&folder).unwrap();
    assert_eq!(leftovers(&folder), 0);
    // The file of a killed run is there, but nobody holds it.
    fs::write(folder.join(".kinecut.lock"), "").unwrap();
    outputs("old").write(&folder).unwrap();
    assert!(is_valid(&folder) && leftovers(&folder) == 0);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn many_runs_into_one_folder_take_turns() {
    let folder = folder("turns");
    for _ in 0..25 {
        rayon::join(|| outputs("old").write(&folder).unwrap(), || outputs("new").write(&folder).unwrap());
        assert!(is_valid(&folder) && owner(&folder).is_some());
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_was_read_is_not_replaced_under_any_of_its_names() {
    let folder = folder("read");
    fs::create_dir(folder.join("sub")).unwrap();
    fs::write(folder.join("part.stl"), "the customer's").unwrap();
    let read = FilesRead::default();
    DiskLoader::new(&folder).noting(&read).read("part.stl").unwrap();
    let mut outputs = outputs("new");
    outputs.spare(&read);
    for way in [folder.clone(), folder.join("sub/.."), folder.join(".")] {
        let error = outputs.write(&way).unwrap_err();
        assert_eq!(error.code(), Code::INPUT_IN_THE_WAY, "{}", way.display());
    }
    if cfg!(unix) {
        link(&folder, &folder.join("sub/again"));
        assert_eq!(outputs.write(&folder.join("sub/again")).unwrap_err().code(), Code::INPUT_IN_THE_WAY);
        // An output whose place is a link to what was read.
        fs::create_dir(folder.join("other")).unwrap();
        link(&folder.join("part.stl"), &folder.join("other/report.html"));
        assert_eq!(outputs.write(&folder.join("other")).unwrap_err().code(), Code::INPUT_IN_THE_WAY);
    }
    assert_eq!(fs::read_to_string(folder.join("part.stl")).unwrap(), "the customer's");
    assert!(!folder.join("a.ngc").exists() && !folder.join("verdict.json").exists());
    outputs.write(&folder.join("sub")).unwrap();
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_was_not_replaced_keeps_its_verdict() {
    let folder = folder("back");
    let mut kept = 0;
    for step in 0..steps() {
        outputs("old").write(&folder).unwrap();
        let mut disk = Failing { once: true, ..Failing::after(step, false) };
        if outputs("new").write_on(&mut disk, &folder).is_err() && owner(&folder).as_deref() == Some("old") {
            assert!(is_valid(&folder), "step {step}: {:?}", disk.log);
            kept += usize::from(disk.log.iter().any(|to| to == "verdict.json"));
        }
        assert_eq!(leftovers(&folder), 0, "step {step}");
    }
    assert!(kept > 0, "a verdict that was taken away is put back");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_folder_in_the_way_of_a_file_is_found_before_anything_is_replaced() {
    let folder = folder("way");
    outputs("old").write(&folder).unwrap();
    fs::remove_file(folder.join("report.html")).unwrap();
    fs::create_dir(folder.join("report.html")).unwrap();
    let error = outputs("new").write(&folder).unwrap_err();
    assert_eq!(error.code(), Code::OUTPUT_NOT_WRITTEN);
    assert!(fs::read_to_string(folder.join("a.ngc")).unwrap().contains("of old"));
    assert!(folder.join("verdict.json").exists() && leftovers(&folder) == 0);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_folder_is_settled_between_the_files_and_their_verdict() {
    let folder = folder("order");
    outputs("old").write(&folder).unwrap();
    let mut disk = Failing::after(usize::MAX, false);
    outputs("new").write_on(&mut disk, &folder).unwrap();
    let at = |name: &str| disk.log.iter().rposition(|to| to == name).unwrap();
    let (last, seal) = (at("report.html"), at("verdict.json"));
    assert!(disk.log[last..seal].iter().any(|to| to == "settle"), "{:?}", disk.log);
    // And after the old one was taken away, before the first file.
    let first = at("a.ngc");
    assert!(disk.log[..first].iter().any(|to| to == "settle"), "{:?}", disk.log);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn folders_are_made_however_they_are_written() {
    let all = folder("made");
    for name in ["new", "one/.", "two/", "three/four/./five/.", "six/../seven"] {
        let folder = all.join(name);
        let _ = fs::create_dir(all.join("six"));
        outputs("new").write(&folder).unwrap();
        assert_eq!(owner(&folder).as_deref(), Some("new"), "{name}");
    }
    fs::remove_dir_all(&all).unwrap();
}
