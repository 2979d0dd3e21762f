//! Texts kept in `tests/main/snapshots`, a file each.

/// That a text is the one kept under this name. After a wanted change: `INSTA_UPDATE=always cargo test`, then read the
/// difference.
#[track_caller]
pub(crate) fn assert_kept(name: &str, text: &str) {
    let mut settings = insta::Settings::new();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/main/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}
