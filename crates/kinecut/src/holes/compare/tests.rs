//! The comparison table of the specification, and the paper's claims, on the paper's hole.

use super::*;

/// R = 79, n = 20, 6 m/min.
fn paper(entry: f64) -> Terms {
    Terms { entry, allowance: 1.0, limits: Limits { axis_velocity: 1e4, ..Limits::usual(100.0) }, ..Terms::new(79.0, 20.0, 4.0, 100.0) }
}

#[test]
fn print_all() {
    let t0 = std::time::Instant::now();
    let mut all = compare(&paper(0.0)).unwrap();
    println!("{:?}", t0.elapsed());
    for r in &mut all.rows {
        let Some(f) = &mut r.figures else { println!("{} {:?}", r.strategy, r.error); continue };
        println!("{} L {} blocks {} ({} inv, {} ch) turns {} closing {:?} \n   worst {:?} peaks {:?} at_step {:?} sampled {:?} most {:.2} at {:.1} mean {:.2} times {:?}", r.strategy, f.length, f.blocks, f.involutes, f.characters, f.turns, f.closing, f.worst, f.peaks, f.at_step, f.closing_sampled, f.load.most.to_degrees(), f.load.most_at, f.load.mean.to_degrees(), f.times.iter().map(|t| t.time).collect::<Vec<_>>());
    }
    for l in &all.lead_ins { println!("{} touch {} way {} engaged {} growth {} thin {}", l.contact, l.touch, l.way, l.engaged.to_degrees(), l.growth.to_degrees(), l.thin_way); }
    for c in &all.claims { println!("{:?} {}: {}", c.holds, c.claim, c.found); }
    println!("{}", serde_json::to_string(&all).unwrap().len());
    let all = compare(&paper(10.0)).unwrap();
    for r in &all.rows {
        if let Some(f) = &r.figures { println!("{} {} {} {:?} start {:?}", r.strategy, f.length, f.blocks, f.times.iter().map(|t| t.time).collect::<Vec<_>>(), f.start); } else { println!("{:?}", r.error) }
    }
}
