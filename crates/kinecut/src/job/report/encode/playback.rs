//! The stock over time: corners in steps, faces in the order in which they come; their corners count back from the next one that no face
//! has had yet, so that neighbours take few bits.

use serde::Serialize;

use super::Streams;
use super::numbers::Numbers;
use crate::stock::cut::{PlayedSurface, REMAINS};

/// Corners are rounded to this part of the step of their lattice.
const PART: f64 = 1.0 / 32.0;

#[derive(Serialize)]
pub(super) struct PlaybackHead {
    step: f64,
    ticks: u16,
    vertices: usize,
    faces: usize,
    /// Coordinates count in this [mm].
    unit: f64,
}

pub(super) fn stream(played: &PlayedSurface, streams: &mut Streams) -> PlaybackHead {
    let unit = played.step * PART;
    let columns = [0, 1, 2].map(|k| {
        let place = |v: &[f32; 3]| (f64::from(v[k]) / unit).round() as i64;
        played.vertices.iter().map(place).collect::<Vec<_>>()
    });
    let mut corners = [0, 1, 2, 3].map(|_| Vec::with_capacity(played.faces.len()));
    // The next corner that no face has had yet.
    let mut next = 0;
    for face in &played.faces {
        for (corner, column) in face.corners.iter().zip(&mut corners) {
            let number = i64::from(*corner);
            column.push(next - number);
            next += i64::from(number == next);
        }
    }
    let from: Vec<i64> = played.faces.iter().map(|face| i64::from(face.from)).collect();
    let life = |to: u16, from: u16| if to == REMAINS { 0 } else { i64::from(to) - i64::from(from) };
    let lives: Vec<i64> = played.faces.iter().map(|face| life(face.to, face.from)).collect();
    let mut stream = Numbers::default();
    columns.iter().chain([&from, &lives]).chain(&corners).for_each(|column| stream.column(column));
    streams.push(("kc-playback", stream.0));
    PlaybackHead {
        step: played.step,
        ticks: played.ticks,
        vertices: played.vertices.len(),
        faces: played.faces.len(),
        unit,
    }
}

#[cfg(test)]
mod tests {
    use super::super::numbers::tests::Reader;
    use super::super::tests::{report, stream};
    use super::*;
    use crate::stock::cut::PlayedFace;

    #[test]
    fn faces_come_back_with_their_corners_and_moments() {
        let mut report = report();
        let face = |corners, from, to| PlayedFace { corners, from, to };
        report.playback = Some(PlayedSurface {
            step: 0.8,
            ticks: 9,
            vertices: vec![
                [0.8, 0.0, 0.1],
                [0.8, 0.8, 0.0],
                [0.0, 0.8, 0.0],
                [0.0, 0.0, 0.0],
                [-1.6, 0.8, 0.0],
            ],
            faces: vec![face([0, 1, 2, 3], 0, 4), face([4, 1, 2, 3], 4, REMAINS)],
        });
        let scene = super::super::scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        assert_eq!(head["playback"]["vertices"], 5);
        let mut read = Reader::of(stream(&scene, "kc-playback"));
        assert_eq!(read.column(5), [32, 32, 0, 0, -64]);
        assert_eq!(read.column(5), [0, 32, 32, 0, 32]);
        assert_eq!(read.column(5), [4, 0, 0, 0, 0]);
        assert_eq!(read.column(2), [0, 4]);
        assert_eq!(read.column(2), [4, 0], "one that remains has no end");
        for want in [[0, 0], [0, 4], [0, 3], [0, 2]] {
            assert_eq!(read.column(2), want);
        }
        assert!(read.is_done());
    }
}
