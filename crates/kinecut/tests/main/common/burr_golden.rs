//! The golden file of the least burr.

use std::collections::BTreeMap;

use glam::DVec2;
use kinecut::geom::Outline;
use serde::Deserialize;

use super::golden::text;

#[derive(Deserialize)]
pub(crate) struct Golden {
    pub(crate) polygons: BTreeMap<String, Polygon>,
    pub(crate) cases: Vec<Case>,
}

#[derive(Deserialize)]
pub(crate) struct Polygon {
    pub(crate) loops: Vec<Vec<[f64; 2]>>,
    pub(crate) optima: Vec<Optimum>,
    pub(crate) nelder_mead_psi0_90_guard_0: Option<NelderMead>,
}

#[derive(Deserialize)]
pub(crate) struct Optimum {
    #[serde(rename = "R")]
    pub(crate) radius: f64,
    pub(crate) psi0_deg: f64,
    pub(crate) guard_deg: f64,
    pub(crate) margin: f64,
    pub(crate) value: f64,
    pub(crate) gamma_deg: f64,
    pub(crate) c: f64,
    pub(crate) certified_lower: f64,
    pub(crate) perimeter: f64,
}

#[derive(Deserialize)]
pub(crate) struct NelderMead {
    pub(crate) best: f64,
    pub(crate) median: f64,
    pub(crate) worst: f64,
    pub(crate) within_1pct: f64,
}

#[derive(Deserialize)]
#[serde(untagged)]
pub(crate) enum PolygonOf {
    Name(String),
    Loops(Vec<Vec<[f64; 2]>>),
}

#[derive(Deserialize)]
pub(crate) struct Case {
    pub(crate) id: String,
    pub(crate) polygon: PolygonOf,
    #[serde(rename = "R")]
    pub(crate) radius: f64,
    /// Feed per radian.
    pub(crate) r: f64,
    /// Teeth.
    pub(crate) z: usize,
    pub(crate) gamma_deg: f64,
    pub(crate) tx: f64,
    pub(crate) ty: f64,
    pub(crate) psi0_deg: f64,
    pub(crate) n_events: usize,
    pub(crate) n_front_exits: usize,
    pub(crate) n_bad_front_exits: usize,
    pub(crate) sum_t: f64,
    pub(crate) sum_psi_front_exits: f64,
    pub(crate) f_discrete_front: f64,
    pub(crate) f_discrete_back: f64,
    pub(crate) f_limit: f64,
    pub(crate) f_limit_rho: f64,
    pub(crate) f_limit_back: f64,
    pub(crate) f_limit_either: f64,
    /// tooth, edge, t, s, x, y, exit angle in degrees, is it an exit, is it in front.
    #[serde(default)]
    pub(crate) events: Vec<[f64; 9]>,
}

impl Golden {
    pub(crate) fn read() -> Golden {
        serde_json::from_str(&text("burr")).unwrap()
    }

    pub(crate) fn outline(&self, polygon: &PolygonOf) -> Outline {
        match polygon {
            PolygonOf::Name(name) => self.polygons[name].outline(),
            PolygonOf::Loops(loops) => outline(loops),
        }
    }
}

impl Polygon {
    pub(crate) fn outline(&self) -> Outline {
        outline(&self.loops)
    }
}

fn outline(loops: &[Vec<[f64; 2]>]) -> Outline {
    let loops: Vec<Vec<DVec2>> =
        loops.iter().map(|l| l.iter().map(|&p| DVec2::from_array(p)).collect()).collect();
    Outline::polygons(&loops).unwrap()
}
