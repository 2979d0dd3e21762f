//! The groove that a thread mill cuts, by brute force: its teeth at many places of a path, in one half-plane through the axis.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// A full-form tooth [mm, rad].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tooth {
    /// Radius at the crest.
    pub(crate) crest: f64,
    /// Radius at the pitch line, where the tooth is half a pitch wide.
    pub(crate) pitch_line: f64,
    pub(crate) pitch: f64,
    pub(crate) half_angle: f64,
}

/// Radius at which the groove is half a pitch wide [mm], in the half-plane through the origin that lies at an angle [rad]; `path`:
/// middles of the tooth, dense; those beyond a quarter of a turn belong to other grooves.
pub(crate) fn pitch_radius(tooth: Tooth, path: &[DVec3], inside: bool, angle: f64) -> f64 {
    let near = |p: &&DVec3| {
        let turned = p.truncate().to_angle() - angle;
        turned.sin().atan2(turned.cos()).abs() < 0.5 * PI
    };
    let path: Vec<DVec3> = path.iter().filter(near).copied().collect();
    assert!(path.len() > 1000, "{}", path.len());
    let width = |r: f64| {
        let at = DVec2::from_angle(angle) * r;
        let [mut upper, mut lower] = [f64::NEG_INFINITY, f64::INFINITY];
        for p in &path {
            let away = p.truncate().distance(at);
            if away <= tooth.crest {
                let half = 0.25 * tooth.pitch - (away - tooth.pitch_line) * tooth.half_angle.tan();
                upper = upper.max(p.z + half);
                lower = lower.min(p.z - half);
            }
        }
        upper - lower
    };
    // It narrows into the material.
    let middle = path.iter().map(|p| p.truncate().length()).sum::<f64>() / path.len() as f64;
    let plain = if inside { middle + tooth.pitch_line } else { middle - tooth.pitch_line };
    let deeper = if inside { 1.0 } else { -1.0 };
    let [mut low, mut high] = [-0.2 * tooth.pitch, 0.2 * tooth.pitch];
    for _ in 0..40 {
        let at = 0.5 * (low + high);
        if width(plain + deeper * at) > 0.5 * tooth.pitch { low = at } else { high = at }
    }
    plain + deeper * 0.5 * (low + high)
}
