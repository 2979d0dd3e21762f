//! What the chain of a contour makes of its ends on the axis, whatever the size of the tool.

use glam::{DVec2, DVec3};
use kinecut::machine::Twist;
use kinecut::sweep::{ChainPiece, PieceKind, ProfileChain};
use kinecut::tool::{Contour, ContourElement, DOWN, ElementRole, UP};

/// A spindle: an arc of this radius from tip to tip, `half` high to each side of its widest place. Its centre lies beyond the
/// axis.
fn spindle(radius: f64, half: f64) -> ProfileChain {
    let angle = (half / radius).asin();
    let aside = ((radius - half) * (radius + half)).sqrt();
    let arc = ContourElement::arc([-aside, 0.0], radius, -angle, angle, ElementRole::Cutting);
    ProfileChain::new(&Contour::new(vec![arc]).unwrap())
}

fn kinds(chain: &ProfileChain) -> Vec<PieceKind> {
    chain.pieces().iter().map(|p| p.kind).collect()
}

#[test]
fn points_of_an_arc_are_poles_whatever_its_radius() {
    let mut rounded = 0;
    for k in 0..400 {
        let radius = 10f64.powf(1.0 + 0.0125 * f64::from(k));
        let half = 3.0 + 0.01 * f64::from(k);
        let chain = spindle(radius, half);
        assert_eq!(kinds(&chain), [PieceKind::Pole, PieceKind::Element, PieceKind::Pole], "radius {radius}");
        let [low, arc, high] = chain.pieces() else { panic!("three pieces") };
        rounded += usize::from(arc.point(arc.from).x.abs() > 1e-12);
        // The fans stand on the axis, at the tips, and turn the normal from the axis to the arc's and back.
        let place = |p: &ChainPiece, u: f64| (p.point(u), p.normal(u));
        let tips = [(low, low.from, DOWN, -half), (high, high.to, UP, half)];
        for (piece, u, angle, height) in tips {
            let (point, normal) = place(piece, u);
            assert_eq!(point.x, 0.0, "radius {radius}");
            assert!((point.y - height).abs() < 1e-14 * radius + 1e-12, "radius {radius}: {point}");
            assert!(normal.distance(DVec2::new(angle.cos(), angle.sin())) < 1e-15);
        }
        assert!(low.normal(low.to).distance(arc.normal(arc.from)) < 1e-15);
        assert!(high.normal(high.from).distance(arc.normal(arc.to)) < 1e-15);
    }
    // The ends of the arcs do miss the axis, by more than any small bound for all sizes.
    assert!(rounded > 40, "{rounded}");
}

#[test]
fn an_edge_near_the_axis_is_an_edge() {
    // A needle with a flat tip of two picometres, and with one of ten micrometres.
    for radius in [2e-9, 1e-2] {
        let needle = Contour::new(vec![
            ContourElement::line([0.0, 0.0], [radius, 0.0], ElementRole::Cutting),
            ContourElement::line([radius, 0.0], [0.3, 0.4], ElementRole::Cutting),
            ContourElement::line([0.3, 0.4], [0.0, 0.4], ElementRole::Shank),
        ]);
        let chain = ProfileChain::new(&needle.unwrap());
        use PieceKind::{Edge, Element};
        assert_eq!(kinds(&chain), [Element, Edge, Element, Edge, Element], "radius {radius}");
    }
}

#[test]
fn the_moment_of_a_normal_is_that_of_its_place() {
    let tool = Contour::new(vec![
        ContourElement::line([0.0, 1.5], [3.0, -1.0], ElementRole::Cutting),
        ContourElement::arc([3.0, 1.0], 2.0, DOWN, 0.3, ElementRole::Cutting),
        ContourElement::line(
            [3.0 + 2.0 * 0.3f64.cos(), 1.0 + 2.0 * 0.3f64.sin()],
            [4.0, 20.0],
            ElementRole::Cutting,
        ),
        ContourElement::line([4.0, 20.0], [0.0, 22.0], ElementRole::Shank),
    ]);
    let chain = ProfileChain::new(&tool.unwrap());
    assert!(chain.pieces().len() > 6);
    for piece in chain.pieces() {
        for k in 0..=4 {
            let u = piece.from + (piece.to - piece.from) * f64::from(k) / 4.0;
            let (p, n) = (piece.point(u), piece.normal(u));
            assert!((piece.moment(u) - (n.x * p.y - n.y * p.x)).abs() < 1e-13, "{piece:?} at {u}");
        }
    }
}

#[test]
fn a_curve_goes_on_where_a_whole_circle_stands_still() {
    let pin = Contour::new(vec![
        ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
        ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
        ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    ]);
    let chain = ProfileChain::new(&pin.unwrap());
    // Turning about an axis that meets the tool's at a height stops the circle of the wall there: at its ends, and inside.
    for height in [0.0, 30.0, 7.0] {
        let turn = DVec3::new(0.4, 1.0, 0.0);
        let twist = Twist { turn, shift: -turn.cross(DVec3::new(0.0, 0.0, height)) };
        let grazing = chain.grazing(&twist);
        let wall = grazing.spans.iter().find(|s| s.piece == 2).unwrap();
        let ends = [(0.0, 1e-4), (1.0, 1.0 - 1e-4)];
        for (t, beside) in ends {
            let [at, near] = [t, beside].map(|t| chain.grazing_points(wall, t));
            for (a, b) in at.iter().zip(&near) {
                assert!(a.point.distance(b.point) < 1e-3, "{height}: {} and {}", a.point, b.point);
            }
        }
    }
}
