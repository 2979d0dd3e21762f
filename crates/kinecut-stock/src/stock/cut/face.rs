//! Face classes of cut surfaces.
//!
//! A class is `16 * part + face`: the part of the tool from the tip up (a plain end mill, ball, bull-nose or drill
//! has one; a stepped profile has one more for each step or change of shape), and the face of that part's sweep.

/// A face of the sweep of a convex tool part; left and right as seen along the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum SweptFace {
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

impl SweptFace {
    /// The class of this face of a part.
    pub fn class(self, part: usize) -> u8 {
        (part.min(15) as u8) << 4 | self as u8
    }

    /// The face of a class of a cut surface.
    pub fn of_class(class: u8) -> Option<SweptFace> {
        Some(match class & 15 {
            0 => SweptFace::Floor,
            1 => SweptFace::Trough,
            2 => SweptFace::FootLeft,
            3 => SweptFace::FootRight,
            4 => SweptFace::FootStart,
            5 => SweptFace::FootEnd,
            6 => SweptFace::WallLeft,
            7 => SweptFace::WallRight,
            8 => SweptFace::WallStart,
            9 => SweptFace::WallEnd,
            10 => SweptFace::Roof,
            _ => return None,
        })
    }

    /// Side of the foot or the wall by the end of the path at which it was cut, or the side of the path.
    pub(super) fn side(foot: bool, station: Station, left: bool) -> SweptFace {
        match (foot, station, left) {
            (true, Station::Start, _) => SweptFace::FootStart,
            (true, Station::End, _) => SweptFace::FootEnd,
            (true, Station::Between, true) => SweptFace::FootLeft,
            (true, Station::Between, false) => SweptFace::FootRight,
            (false, Station::Start, _) => SweptFace::WallStart,
            (false, Station::End, _) => SweptFace::WallEnd,
            (false, Station::Between, true) => SweptFace::WallLeft,
            (false, Station::Between, false) => SweptFace::WallRight,
        }
    }
}

/// The part of a piece of path from which a point is cut.
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
            assert_eq!(SweptFace::of_class(0x30 | class).map(|f| f.class(3)), Some(0x30 | class));
        }
        assert_eq!(SweptFace::of_class(15), None);
    }
}
