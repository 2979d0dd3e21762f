//! Face classes of cut surfaces.
//!
//! A class is `16 * part + face`: the part of the tool from the tip up (a plain end mill, ball, bull-nose or drill
//! has one; a stepped profile has one more for each step or change of shape), and the face of that part's sweep.

/// A face of the sweep of a convex tool part; left and right as seen along the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Face {
    /// Cut by the flat lower face.
    Floor = 0,
    /// Cut by the lower edge on a slope.
    Trough = 1,
    /// Cut by the curved or conical foot, left of the path.
    FootLeft = 2,
    /// The same, right.
    FootRight = 3,
    /// By the foot where the move starts.
    FootStart = 4,
    /// By the foot where the move ends.
    FootEnd = 5,
    /// Wall cut by the round side, left of the path.
    WallLeft = 6,
    /// The same, right.
    WallRight = 7,
    /// By the side where the move starts.
    WallStart = 8,
    /// By the side where the move ends.
    WallEnd = 9,
    /// Above the tool: the upper face of the cutting part.
    Roof = 10,
}

impl Face {
    /// The class of this face of a part.
    pub fn class(self, part: usize) -> u8 {
        (part.min(15) as u8) << 4 | self as u8
    }

    /// The face of a class of a cut surface.
    pub fn of_class(class: u8) -> Option<Face> {
        Some(match class & 15 {
            0 => Face::Floor,
            1 => Face::Trough,
            2 => Face::FootLeft,
            3 => Face::FootRight,
            4 => Face::FootStart,
            5 => Face::FootEnd,
            6 => Face::WallLeft,
            7 => Face::WallRight,
            8 => Face::WallStart,
            9 => Face::WallEnd,
            10 => Face::Roof,
            _ => return None,
        })
    }

    /// Side of the foot or the wall by the end of the path at which it was cut, or the side of the path.
    pub(super) fn side(foot: bool, station: Station, left: bool) -> Face {
        match (foot, station, left) {
            (true, Station::Start, _) => Face::FootStart,
            (true, Station::End, _) => Face::FootEnd,
            (true, Station::Between, true) => Face::FootLeft,
            (true, Station::Between, false) => Face::FootRight,
            (false, Station::Start, _) => Face::WallStart,
            (false, Station::End, _) => Face::WallEnd,
            (false, Station::Between, true) => Face::WallLeft,
            (false, Station::Between, false) => Face::WallRight,
        }
    }
}

/// Where on a piece of path a point is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Station {
    /// By the tool at the start.
    Start,
    /// By the tool on its way.
    Between,
    /// By the tool at the end.
    End,
}

impl Station {
    /// By the fraction of the path.
    pub(super) fn at(t: f64) -> Station {
        if t <= 0.0 {
            Station::Start
        } else if t >= 1.0 {
            Station::End
        } else {
            Station::Between
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_names_its_face() {
        for class in 0..=10 {
            assert_eq!(Face::of_class(0x30 | class).map(|f| f.class(3)), Some(0x30 | class));
        }
        assert_eq!(Face::of_class(15), None);
    }
}
