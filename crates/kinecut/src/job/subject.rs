//! Subjects of a verdict: files and tables by their hashes.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// SHA-256 of bytes, in hexadecimal.
///
/// ```
/// assert_eq!(kinecut::job::sha256(b"")[..8], *"e3b0c442");
/// ```
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

/// A thing that the verdict is about: its role, the file it came from if there is one, and its hash.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// "program", "output", "given program", "given design", "job", "tools", "machine", "stock", "design", "setups".
    pub role: String,
    /// File, relative to the folder of the verdict for outputs, as the job spells it for inputs; `None` for a part
    /// of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// SHA-256 of the bytes; of a part of the job, of its canonical JSON.
    pub sha256: String,
}
