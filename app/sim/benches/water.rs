//! What the water costs a node and step: `cargo bench -p endline-sim --bench water`.
//!
//! Throughput is in nodes per second; its inverse is the time of a node (docs/physics.md, Water).

#![allow(clippy::expect_used, reason = "a benchmark says what it needs")]

use divan::Bencher;
use divan::counter::ItemsCount;
use endline_sim::DVec3;
use endline_sim::water::field::Walk;
use endline_sim::water::waves::{Spectrum, WaveKind, Waves};
use endline_sim::water::{Current, Sea, Water, WavesOut};

/// Nodes of the rope.
const NODES: usize = 500;

fn main() {
    divan::main();
}

fn sea(exponent: f64, components: usize) -> Sea {
    let spectrum = Spectrum { significant_height_m: 1.2, peak_period_s: 5.0, gamma: 3.3 };
    let waves =
        Waves { toward: DVec3::X, ramp_s: 10.0, kind: WaveKind::Jonswap { spectrum, components } };
    let current = Current::power(DVec3::X * 0.5, exponent);
    let waves = (components > 0).then_some(waves);
    let water = Water {
        density_kg_m3: 1025.0,
        gravity_m_s2: 9.81,
        depth_m: 25.0,
        rope_dries: true,
        current,
        waves,
    };
    Sea::new(&water, None, 1)
}

/// A rope of 32 m from the seabed to the surface.
fn rope() -> Vec<DVec3> {
    (0..NODES)
        .map(|node| {
            DVec3::new(20.0, 0.0, 25.0) * (node as f64 / (NODES - 1) as f64) - DVec3::Z * 25.0
        })
        .collect()
}

#[divan::bench(args = [0.0, 1.0 / 7.0])]
fn current(bencher: Bencher, exponent: f64) {
    let (sea, rope, mut flow) = (sea(exponent, 0), rope(), vec![DVec3::ZERO; NODES]);
    bencher
        .counter(ItemsCount::new(NODES))
        .bench_local(|| sea.current_at(divan::black_box(&rope), 1.0, divan::black_box(&mut flow)));
}

#[divan::bench(args = [1, 16, 64])]
fn waves(bencher: Bencher, components: usize) {
    let (sea, rope, mut flow) = (sea(0.0, components), rope(), vec![DVec3::ZERO; NODES]);
    let (mut walk, mut acceleration, mut surface) = (Walk::default(), Vec::new(), Vec::new());
    bencher.counter(ItemsCount::new(NODES)).bench_local(|| {
        sea.add_waves(
            divan::black_box(&rope),
            20.0,
            &mut walk,
            WavesOut { flow: &mut flow, acceleration: &mut acceleration, surface: &mut surface },
        );
    });
}
