//! Effect of a path on each stretch of the outline.

/// Effect of a path on the outline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathBurr {
    /// Length with a bad exit, by the weights of edges and exit angles [mm].
    pub bad: f64,
    /// Length at which teeth leave [mm].
    pub exits: f64,
    /// Length at which teeth enter [mm].
    pub entries: f64,
    /// Length that no piece covers [mm].
    pub uncut: f64,
    /// Length that is covered where a chain begins: the cutter is lowered onto it and has no exit angle there [mm].
    pub lowered: f64,
    /// Each edge's stretches in its direction, edge after edge; together they are the whole outline.
    pub stretches: Vec<EdgeStretch>,
}

/// A stretch of an edge that is met in one way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeStretch {
    /// The edge.
    pub edge: usize,
    /// Share of the edge's length where it begins.
    pub from: f64,
    /// Share of the edge's length where it ends.
    pub to: f64,
    /// First contact of the cutter with it.
    pub met: Met,
}

/// First contact of the cutter with a stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Met {
    /// It does not.
    Never,
    /// The cutter is lowered onto it at the start of a chain.
    Lowered {
        /// The chain.
        chain: usize,
    },
    /// In feed.
    First {
        /// The chain.
        chain: usize,
        /// The piece of the chain.
        piece: usize,
        /// Exit angles at both ends, between -pi/2 and 3 pi/2 [rad].
        angles: [f64; 2],
        /// Teeth leave here; otherwise they enter.
        exit: bool,
        /// Weight of a millimetre for its exit angle, without the edge's own weight; 0: not bad.
        weight: f64,
    },
}
