use super::*;
use crate::base::*;
pub(super) fn read_stl_face(_: &str, _: &[u8], _: &OutlineOptions) -> Result<OutlineRead> {
    Err(Finding::error(Code::OUTLINE_FILE, "").into())
}
