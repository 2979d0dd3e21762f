//! Lengths that a program makes of numbers and registers.

/// A length in force that is not that of one register of the tool table (`G43.1`, `G43.2` of LinuxCNC).
///
/// It has a register of the program's own, see [`super::OWN_REGISTERS`].
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::program::OwnLength;
/// // G43 H1, then G43.1 X2, then G43.2 H3.
/// let first = OwnLength { before: Some(1), set: [Some(2.0), None, None], add: None };
/// let table = |register| match register {
///     1 => Some([Some(0.0), Some(0.0), Some(100.0)]),
///     _ => Some([Some(0.5), Some(0.0), None]),
/// };
/// assert_eq!(first.offset(table), [Some(2.0), Some(0.0), Some(100.0)]);
/// let second = OwnLength { before: Some(1), set: [None; 3], add: Some(3) };
/// assert_eq!(second.offset(table), [Some(0.5), Some(0.0), None]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnLength {
    /// Register of the length that was in force before, where that counts.
    pub before: Option<u32>,
    /// Offsets along X, Y and Z in place of those of that one [mm].
    pub set: [Option<f64>; 3],
    /// Register whose offsets are added.
    pub add: Option<u32>,
}

impl OwnLength {
    /// Offsets along X, Y and Z [mm], as far as they are known; `of` tells those of a register.
    pub fn offset(&self, of: impl Fn(u32) -> Option<[Option<f64>; 3]>) -> [Option<f64>; 3] {
        let nothing = [Some(0.0); 3];
        let held = |register: Option<u32>| match register {
            None | Some(0) => nothing,
            Some(register) => of(register).unwrap_or([None; 3]),
        };
        let (before, add) = (held(self.before), held(self.add));
        [0, 1, 2].map(|axis| Some(self.set[axis].or(before[axis])? + add[axis]?))
    }
}
