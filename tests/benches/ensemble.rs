//! Ensembles of 10⁴ members on one thread and on two, each member alone and eight in lanes.
//!
//! `cargo bench -p dvi-benches --bench ensemble`. Each time is the best of seven, which take turns, so that
//! other work on the machine meets all alike. The table is of times on one thread, of what two threads gain,
//! and of what lanes gain on one thread.

use std::error::Error;
use std::time::{Duration, Instant};

use dvi_core::Lagrangian;
use dvi_core::ensemble::Ensemble;
use dvi_core::methods::InStep;
use dvi_core::prelude::*;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::zoo::regular::{Kepler, KeplerState};
use rayon::ThreadPool;

const MEMBERS: usize = 10_000;
const LANES: usize = 8;
const ROUNDS: usize = 7;

fn row<S, M>(
    name: &str,
    [one, two]: [&ThreadPool; 2],
    (system, method, h, steps): (&S, M, f64, u64),
    start: impl Fn(usize) -> S::State<f64>,
) -> Result<(), Box<dyn Error>>
where
    S: Lagrangian + PartialEq + Sync,
    S::State<f64>: Sync + Send,
    M: InStep<LANES, S> + PartialEq + Clone + Sync + Send + std::fmt::Debug,
{
    let ensemble = || Ensemble::new(system, method.clone(), h, (0..MEMBERS).map(&start)).stride(steps);
    let mut best = [Duration::MAX; 4];
    for _ in 0..ROUNDS {
        for (place, best) in best.iter_mut().enumerate() {
            let pool = if place % 2 == 0 { one } else { two };
            let ensemble = if place < 2 { ensemble() } else { ensemble().in_lanes::<LANES>() };
            let begin = Instant::now();
            let results = pool.install(|| ensemble.take_steps(steps))?;
            *best = begin.elapsed().min(*best);
            assert_eq!(results.members().len(), MEMBERS);
        }
    }
    let [alone, alone_2, lanes, lanes_2] = best.map(|time| time.as_secs_f64() * 1e3);
    println!(
        "| {name} | {steps} | {alone:.1} | {:.2} | {lanes:.1} | {:.2} | {:.2} |",
        alone / alone_2,
        lanes / lanes_2,
        alone / lanes,
    );
    Ok(())
}

/// The same by hand: members without records, a half of them in each of two threads that share nothing. So
/// much can two threads gain now.
fn by_hand() {
    // The compiler is not to know the parameter.
    let system = std::hint::black_box(&KEPLER);
    let run = |members: std::ops::Range<usize>| {
        for j in members {
            let Ok(mut run) = Integrator::new(system, Variational::trapezoid(), 0.01, planet(j)) else {
                continue;
            };
            assert!(run.take_steps(2000).is_ok());
        }
    };
    let mut best = [Duration::MAX; 2];
    for _ in 0..ROUNDS {
        let begin = Instant::now();
        run(0..MEMBERS);
        best[0] = begin.elapsed().min(best[0]);
        let begin = Instant::now();
        std::thread::scope(|scope| {
            scope.spawn(|| run(0..MEMBERS / 2));
            run(MEMBERS / 2..MEMBERS);
        });
        best[1] = begin.elapsed().min(best[1]);
    }
    let [one, two] = best.map(|time| time.as_secs_f64() * 1e3);
    println!("| loops that share nothing | 2000 | {one:.1} | {:.2} | | | |", one / two);
}

const KEPLER: Kepler = Kepler { mu: 1.0 };

fn planet(j: usize) -> KeplerState {
    KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 + 4e-5 * j as f64 }
}

fn main() -> Result<(), Box<dyn Error>> {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let (one, two) = (pool(1)?, pool(2)?);
    println!("| {MEMBERS} members | steps | ms alone | 2 threads | ms in lanes | 2 threads | by lanes |");
    println!("|---|---|---|---|---|---|---|");
    by_hand();
    let kepler = (&KEPLER, Variational::trapezoid(), 0.01, 2000);
    row("Kepler, Verlet", [&one, &two], kepler, planet)?;
    let (vortices, start) = quasi_periodic();
    let near = |j: usize| {
        let mut start = start;
        start.x[0] += 1e-5 * j as f64;
        start
    };
    let leapfrog = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    row("vortices, σ = 0", [&one, &two], (&vortices, leapfrog, 0.01, 200), near)?;
    row("vortices, σ = ½", [&one, &two], (&vortices, Sigma::midpoint(), 0.1, 200), near)
}
