//! Kinds of layouts, by the sides of the bed on which the rotary axes are.

use crate::machine::CoordinateCode;

/// Kind of a layout, by the sides of the bed on which its rotary axes are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LayoutKind {
    /// No rotary axis.
    Linear,
    /// One rotary axis, which turns the work.
    Table,
    /// One rotary axis, which turns the tool.
    Head,
    /// Two rotary axes, both turn the work.
    TableTable,
    /// Two rotary axes, one turns the work and one the tool.
    HeadTable,
    /// Two rotary axes, both turn the tool.
    HeadHead,
    /// More than two rotary axes.
    More,
}

impl LayoutKind {
    /// The kind of a code.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::{CoordinateCode, layouts::LayoutKind};
    /// let kind = |code| LayoutKind::of(&CoordinateCode::parse(code).unwrap());
    /// assert_eq!(kind("641203"), LayoutKind::TableTable);
    /// assert_eq!(kind("612035"), LayoutKind::HeadTable);
    /// ```
    pub fn of(code: &CoordinateCode) -> LayoutKind {
        let [work, tool] = rotaries(code);
        match (work, tool) {
            (0, 0) => LayoutKind::Linear,
            (1, 0) => LayoutKind::Table,
            (0, 1) => LayoutKind::Head,
            (2, 0) => LayoutKind::TableTable,
            (1, 1) => LayoutKind::HeadTable,
            (0, 2) => LayoutKind::HeadHead,
            _ => LayoutKind::More,
        }
    }

    /// Name in the trade.
    pub fn name(self) -> &'static str {
        match self {
            LayoutKind::Linear => "no rotary axis",
            LayoutKind::Table => "rotary table",
            LayoutKind::Head => "swivel head",
            LayoutKind::TableTable => "table-table",
            LayoutKind::HeadTable => "head-table",
            LayoutKind::HeadHead => "head-head",
            LayoutKind::More => "more than two rotary axes",
        }
    }
}

impl std::fmt::Display for LayoutKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// Number of rotary axes on the work side and on the tool side.
pub(super) fn rotaries(code: &CoordinateCode) -> [usize; 2] {
    let (work, tool) = code.word().0.split_at(code.bed());
    [work, tool].map(|side| side.iter().filter(|m| m.is_rotation()).count())
}

/// Attitude in the workshop of the spindle, which is along Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Attitude {
    /// Z is vertical.
    #[default]
    Vertical,
    /// Z is horizontal, Y is vertical.
    Horizontal,
}

impl Attitude {
    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            Attitude::Vertical => "vertical",
            Attitude::Horizontal => "horizontal",
        }
    }
}
