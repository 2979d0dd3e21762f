//! Words of rotary axes, of the control of the tool centre point and of tilted planes: what differs between controls, as
//! data; and when the tool stands along Z because all rotary axes are at zero.

/// Words by which a control writes and reads more than three axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct MultiAxis {
    /// Words of the rotary axes A, B and C, and the decimals of their degrees; none: it has three axes, or klartext says
    /// them.
    pub(super) rotary: Option<([&'static str; 3], u8)>,
    /// Remark for a person if a rotary axis goes beyond a whole turn; empty: nothing to remark.
    pub(super) whole_turns: &'static str,
    /// Control of the tool centre point.
    pub(super) tcp: TcpWord,
    /// Words of the components of a tool axis, and their decimals.
    pub(super) vector: Option<([&'static str; 3], u8)>,
    /// Tilted planes, and the decimals of their angles.
    pub(super) tilt: TiltWord,
    pub(super) tilt_decimals: u8,
}

impl MultiAxis {
    /// Nothing but X, Y and Z.
    pub(super) const NONE: MultiAxis = MultiAxis {
        rotary: None,
        whole_turns: "",
        tcp: TcpWord::None,
        vector: None,
        tilt: TiltWord::None,
        tilt_decimals: 3,
    };
}

/// Words of the control of the tool centre point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TcpWord {
    /// It has none, or its words are elsewhere.
    None,
    /// The call of a tool length: `G43.4 H` with rotary axes, `G43.5 H` with the tool axis as a vector, until `G49`
    /// (FANUC).
    Length,
    /// A transformation, `TRAORI` to `TRAFOOF`, and under it `ORIAXES` or `ORIVECT` (SINUMERIK).
    Transformation,
}

/// Words of tilted planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TiltWord {
    /// It has none, or its words are elsewhere.
    None,
    /// `G68.2`, `G53.1`, `G69` (FANUC).
    Feature,
    /// `CYCLE800` (SINUMERIK).
    Swivel,
}

/// Letters of the rotary axes.
pub(super) const ROTARY: [&str; 3] = ["A", "B", "C"];

/// Positions of the rotary axes that a text gives; `T` is a count of steps or an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rotaries<T> {
    /// Positions by letter.
    pub(super) at: [Option<T>; 3],
    /// Letters that were named.
    named: [bool; 3],
    /// The control has turned them along a plane, and they were not all named since.
    swung: bool,
}

impl<T: Copy> Default for Rotaries<T> {
    fn default() -> Rotaries<T> {
        Rotaries { at: [None; 3], named: [false; 3], swung: false }
    }
}

impl<T: Copy> Rotaries<T> {
    /// An axis goes to a position.
    pub(super) fn set(&mut self, axis: usize, to: T) {
        self.at[axis] = Some(to);
        self.named[axis] = true;
    }

    /// The control turns them by itself.
    pub(super) fn swing(&mut self) {
        self.at = [None; 3];
        self.swung = true;
    }

    /// Whether the tool stands along Z of the work offset because nothing was ever turned, or all axes that were named
    /// are at zero; `zero` tests a position.
    pub(super) fn upright(&self, zero: impl Fn(T) -> bool) -> bool {
        let named = self.named.iter().any(|n| *n);
        let all = (0..3).all(|i| !self.named[i] || self.at[i].is_some_and(&zero));
        all && (named || !self.swung)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tool_is_upright_when_every_axis_that_was_named_is_at_zero() {
        let zero = |degrees: f64| degrees == 0.0;
        let mut axes = Rotaries::default();
        assert!(axes.upright(zero));
        axes.set(0, 30.0);
        axes.set(2, 0.0);
        assert!(!axes.upright(zero));
        axes.set(0, 0.0);
        assert!(axes.upright(zero));
        axes.swing();
        axes.set(0, 0.0);
        assert!(!axes.upright(zero), "C is not known");
        axes.set(2, 0.0);
        assert!(axes.upright(zero));
        let mut axes = Rotaries::<f64>::default();
        axes.swing();
        assert!(!axes.upright(zero));
    }
}
