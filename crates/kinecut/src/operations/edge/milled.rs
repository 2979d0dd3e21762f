//! A face as its milling has left it: what operations after it in the setup learn of its edges.

use crate::facing::burrs::MilledEdges;
use crate::operations::face::PsiSide;

/// A milled face, in coordinates of the work offset.
#[derive(Clone, Debug)]
pub(crate) struct FaceEdges {
    /// Number of the operation over all setups.
    pub(crate) operation: u32,
    /// Its name.
    pub(crate) name: String,
    /// Its edges and the way of the cutter.
    pub(crate) edges: MilledEdges,
    /// Rule for judging the exit angles, as a person reads it.
    pub(crate) rule: String,
    /// Side of the velocity from which the job gives exit angles.
    pub(crate) psi_side: PsiSide,
}
