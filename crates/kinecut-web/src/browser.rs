//! Opens an address in the browser of the user.

use std::io;
use std::process::{Command, Stdio};

/// Programs that open an address, the usual one of the system first.
#[cfg(target_os = "macos")]
const OPENERS: &[&[&str]] = &[&["open"]];
#[cfg(windows)]
const OPENERS: &[&[&str]] = &[&["rundll32", "url.dll,FileProtocolHandler"]];
#[cfg(not(any(target_os = "macos", windows)))]
const OPENERS: &[&[&str]] = &[&["xdg-open"], &["gio", "open"], &["sensible-browser"]];

/// Opens an address; does not wait for the browser.
///
/// # Errors
/// No program of the system does it.
pub fn open(address: &str) -> io::Result<()> {
    let mut failed = io::Error::from(io::ErrorKind::NotFound);
    for opener in OPENERS {
        let Some((program, words)) = opener.split_first() else { continue };
        let mut command = Command::new(program);
        command.args(words).arg(address);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        match command.spawn() {
            Ok(_) => return Ok(()),
            Err(e) => failed = e,
        }
    }
    Err(failed)
}
