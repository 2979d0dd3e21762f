//! The raw part of a program that is planned without a stock: nobody knows it, so no bounds are written.

use crate::nc::{Control, PostSettings};
use crate::program::Program;

/// The comment in the head of a program where the control draws the raw part.
const TO_FILL_IN: &str = "BLK FORM left out: the raw part is not known, write its corners here";

/// Takes the stand-in for the unknown stock out of a program that is to be written.
pub(super) fn left_out(program: &mut Program, post: &mut PostSettings) {
    program.setups.iter_mut().for_each(|setup| setup.stock = None);
    if post.control == Control::Heidenhain {
        post.header.push(TO_FILL_IN.to_owned());
    }
}
