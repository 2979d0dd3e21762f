//! Looks at the files of the folder from time to time, and tells what other programs have changed.

use std::collections::BTreeMap;
use std::sync::Arc;

use kinecut::base::FileKind;
use kinecut::job::sha256;
use serde::Serialize;

use crate::app::App;
use crate::folder::{Listed, Stamp};

/// Largest file that is read at the first look; a larger one is read when its stamp is another.
const READ_FIRST: u64 = 16 << 20;

#[derive(Serialize)]
struct Changed<'a> {
    id: &'a str,
    name: &'a str,
    sha256: Option<&'a str>,
}

#[derive(Serialize)]
struct Nothing {}

/// A file as it was seen last.
struct Seen {
    listed: Listed,
    stamp: Option<Stamp>,
    hash: Option<String>,
}

/// Looks until the server ends. Nobody listening, nothing is looked at.
pub(crate) async fn look(app: Arc<App>) {
    let mut seen: Option<BTreeMap<String, Seen>> = None;
    loop {
        tokio::time::sleep(app.limits.looking).await;
        if app.events.listening() == 0 {
            seen = None;
            continue;
        }
        let app = Arc::clone(&app);
        let before = seen.take();
        seen = tokio::task::spawn_blocking(move || compared(&app, before)).await.ok();
    }
}

/// What is there now; what is another than before is told.
fn compared(app: &App, before: Option<BTreeMap<String, Seen>>) -> BTreeMap<String, Seen> {
    let mut now = BTreeMap::new();
    let mut came = false;
    for listed in app.folder.list().files {
        let stamp = app.folder.stamp(&listed.name);
        let old = before.as_ref().and_then(|before| before.get(&listed.id));
        let hash = match old {
            Some(old) if old.stamp == stamp => old.hash.clone(),
            None if listed.bytes > READ_FIRST => None,
            _ => hash_of(app, &listed),
        };
        // Told too where the bytes are those of the last look: between the two a page may have saved others.
        if let (Some(old), Some(hash)) = (old, &hash)
            && old.stamp != stamp
        {
            tell(app, &listed, Some(hash));
        }
        came |= before.is_some() && old.is_none();
        now.insert(listed.id.clone(), Seen { listed, stamp, hash });
    }
    let mut went = false;
    for (id, old) in before.iter().flatten() {
        if !now.contains_key(id) {
            tell(app, &old.listed, None);
            went = true;
        }
    }
    if came || went {
        app.events.send(None, "files", &Nothing {});
    }
    now
}

fn tell(app: &App, listed: &Listed, sha256: Option<&String>) {
    let changed = Changed { id: &listed.id, name: &listed.name, sha256: sha256.map(String::as_str) };
    app.events.send(None, "changed", &changed);
}

fn hash_of(app: &App, listed: &Listed) -> Option<String> {
    app.folder.read(&listed.name, FileKind::Bytes).ok().map(|content| sha256(&content))
}
