//! The surface of a plate 260 x 260 x 30 mm with a bore of 200 mm, lattice step 0.2 mm (1300 x 1300 x 150 points).

use divan::Bencher;
use glam::DVec3;
use kinecut::base::Silent;
use kinecut::stock::surface::{SurfaceOptions, surface};
use kinecut::stock::{Axis, DexelGrid, EndPoint, Interval, Lattice, PackedNormal, fixed};

fn main() {
    divan::main();
}

/// Lines one after the other.
struct Plate {
    lattice: Lattice,
    starts: [Vec<u32>; 3],
    intervals: [Vec<Interval>; 3],
}

const HALF: f64 = 130.0;
const BOTTOM: f64 = -30.0;

impl Plate {
    /// A bore of radius `wide` down to `floor`, below it of radius `narrow`.
    fn new(step: f64, wide: f64, narrow: f64, floor: f64) -> Plate {
        let (min, max) = (DVec3::new(-HALF, -HALF, BOTTOM), DVec3::new(HALF, HALF, 0.0));
        let counts = ((max - min) / step).round().to_array().map(|n| n as u32);
        let lattice = Lattice { origin: min + 0.5 * step, step, counts };
        let end =
            |at: f64, normal: DVec3| EndPoint { at: fixed(at), normal: PackedNormal::new(normal, 0), cut: 0 };
        let mut starts = [const { Vec::new() }; 3];
        let mut intervals = [const { Vec::new() }; 3];
        for axis in Axis::ALL {
            let (u, v) = axis.others();
            let n = axis.index();
            let mut e = DVec3::ZERO;
            e[n] = 1.0;
            starts[n].push(0);
            for b in 0..counts[v.index()] {
                for a in 0..counts[u.index()] {
                    let (a, b) = (lattice.coordinate(u, a), lattice.coordinate(v, b));
                    if axis == Axis::Z {
                        let r = a.hypot(b);
                        if r > narrow {
                            let top = if r > wide { 0.0 } else { floor };
                            intervals[n].push(Interval { lo: end(BOTTOM, -e), hi: end(top, e) });
                        }
                    } else {
                        // Z is the second of the others of X and the first of those of Y.
                        let (off, z) = if axis == Axis::X { (a, b) } else { (b, a) };
                        let r = if z > floor { wide } else { narrow };
                        if off.abs() >= r {
                            intervals[n].push(Interval { lo: end(-HALF, -e), hi: end(HALF, e) });
                        } else {
                            let h = (r * r - off * off).sqrt();
                            let mut inward = DVec3::ZERO;
                            inward[1 - n] = -off / r;
                            inward[n] = h / r;
                            let lo = Interval { lo: end(-HALF, -e), hi: end(-h, inward) };
                            inward[n] = -h / r;
                            intervals[n].extend([lo, Interval { lo: end(h, inward), hi: end(HALF, e) }]);
                        }
                    }
                    starts[n].push(intervals[n].len() as u32);
                }
            }
        }
        Plate { lattice, starts, intervals }
    }
}

impl DexelGrid for Plate {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn line(&self, axis: Axis, a: u32, b: u32) -> &[Interval] {
        let (n, across) = (axis.index(), self.lattice.counts[axis.others().0.index()]);
        let line = (b * across + a) as usize;
        &self.intervals[n][self.starts[n][line] as usize..self.starts[n][line + 1] as usize]
    }
}

fn bench(bencher: Bencher<'_, '_>, step: f64, narrow: f64) {
    let plate = Plate::new(step, 100.0, narrow, -18.05);
    let mesh = surface(&plate, &SurfaceOptions::default(), &Silent).expect("the tolerance is the default");
    assert!(mesh.check_closed().is_ok());
    // The bound that the picture of the main job asks for.
    assert!(mesh.triangles.len() < 90_000);
    bencher.bench(|| surface(&plate, &SurfaceOptions::default(), &Silent));
}

#[divan::bench(sample_count = 10)]
fn through_bore_1300x1300x150(bencher: Bencher<'_, '_>) {
    bench(bencher, 0.2, 100.0);
}

#[divan::bench(sample_count = 10)]
fn stepped_bore_1300x1300x150(bencher: Bencher<'_, '_>) {
    bench(bencher, 0.2, 80.0);
}

#[divan::bench(sample_count = 10)]
fn stepped_bore_650x650x75(bencher: Bencher<'_, '_>) {
    bench(bencher, 0.4, 80.0);
}
