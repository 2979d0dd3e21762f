//! NC texts of `tests/fixtures/nc`.

use std::path::Path;

use kinecut::nc::Control;

/// That a text is the fixture of this name for a control, letter by letter. With `INSTA_UPDATE=always` it is made so.
#[track_caller]
pub(crate) fn assert_is_fixture(text: &str, name: &str, control: Control) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/nc");
    let file = folder.join(format!("{name}.{}", control.extension()));
    if std::env::var_os("INSTA_UPDATE").is_some_and(|v| v == "always") {
        std::fs::write(&file, text).unwrap();
    }
    let wanted = std::fs::read_to_string(&file).unwrap();
    for (number, (got, want)) in text.lines().zip(wanted.lines()).enumerate() {
        assert_eq!(got, want, "{control} line {}", number + 1);
    }
    assert_eq!(text, wanted, "{control}");
}
