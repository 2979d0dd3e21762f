//! Keys of a request that nothing reads.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::refusal::Refusal;

/// Keys of a request that nothing reads: a word that is written wrongly is not passed over.
#[derive(Deserialize)]
pub(crate) struct Rest(BTreeMap<String, IgnoredAny>);

impl Rest {
    /// Refuses a request with keys that nothing reads.
    ///
    /// # Errors
    /// Names the first.
    pub(crate) fn is_empty(&self) -> Result<(), Refusal> {
        match self.0.keys().next() {
            None => Ok(()),
            Some(key) => Err(Refusal::request(format!("there is no key `{}`", kinecut::page::visible(key)))),
        }
    }
}
