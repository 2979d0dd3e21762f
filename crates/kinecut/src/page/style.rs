//! The look of all pages and the script that plays pictures, as built from the sources in `viewer/`, and the policy under which
//! they may run.

use std::sync::LazyLock;

use base64::Engine as _;
use sha2::{Digest as _, Sha256};

use super::draw;

/// Plays the motion of pictures. It comes first, so that it runs where the 3-D view cannot.
pub(crate) const PICTURE_SCRIPT: &str = include_str!("assets/picture.js");

/// The rules of all pages: the colours, the page, looks of shapes.
pub(crate) fn style() -> &'static str {
    static STYLE: LazyLock<String> = LazyLock::new(|| {
        let page = concat!(include_str!("assets/report.css"), include_str!("assets/picture.css"));
        format!("{}{page}{}", draw::palette::of_page(), draw::rules())
    });
    &STYLE
}

/// The policy of a page that runs these scripts only, with this style sheet.
pub(crate) fn policy_of(scripts: &[&str], style: &str) -> String {
    let hash = |text: &str| {
        let hash = base64::engine::general_purpose::STANDARD.encode(Sha256::digest(text.as_bytes()));
        format!("'sha256-{hash}'")
    };
    let run: Vec<String> = scripts.iter().map(|s| hash(s)).collect();
    let run = if run.is_empty() { "'none'".to_owned() } else { run.join(" ") };
    format!(
        "default-src 'none'; script-src {run}; style-src {}; img-src data: blob:; base-uri 'none'; form-action 'none'",
        hash(style)
    )
}
