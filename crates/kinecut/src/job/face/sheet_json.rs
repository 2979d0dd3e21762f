//! The sheet of a face as JSON, in the units of the shop.

use super::FaceSheet;

impl FaceSheet {
    /// The sheet as JSON: mm, degrees, s.
    pub fn json(&self) -> serde_json::Value {
        serde_json::json!({ "title": self.title })
    }
}
