//! A disc that rolls upright on a plane, and a sleigh on a blade: constraints of velocities.
//!
//! A step solves the discrete equations of Lagrange and d'Alembert (Cortés & Martínez 2001). It is
//! reversible, as the motion is, but neither is symplectic. So the energy of a step need not stay near that
//! of the beginning: it does in regular motions, which the reversal takes into themselves, and wanders in
//! others (Modin & Verdier 2020). The sleigh ends in straight motion, to which no symplectic map could lead.

mod claims;
mod growth;
mod picture;
mod reduced;
mod sleigh;

use anyhow::Result;
use dvi_core::discrete::{Midpoint, Unfitted};
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::deviation::Deviation;
use crate::experiments::rk4::rk4;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{RollingDisc, RollingDiscState};
use growth::Growth;
use reduced::start;
use sleigh::Sleigh;

pub const EXPERIMENT: Experiment = Experiment {
    name: "disc",
    title: "A disc that rolls and a sleigh that turns: constraints of velocities",
    share: 18.0,
    run,
};

const FREE: RollingDisc = RollingDisc { radius: 1.0, stiffness: [0.0; 2], field: [0.0; 2], gradient: 0.0 };
/// On springs that are the same in all directions.
const SPRINGS: RollingDisc = RollingDisc { stiffness: [1.0; 2], ..FREE };
/// On springs that are not, with a magnet.
const MAGNET: RollingDisc =
    RollingDisc { radius: 1.0, stiffness: [1.0, 1.7], field: [0.3, 0.1], gradient: 0.3 };
/// Where all discs begin, and the rates of θ and φ.
const PLACE: [f64; 2] = [0.5, 0.2];
const RATES: [f64; 2] = [1.2, 0.4];
const H: f64 = 0.1;
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 8.0;
const ORDER_STEPS: [f64; 4] = [0.1, 0.05, 0.025, 0.0125];
const FINE: f64 = 0.00125;
/// The end of the runs with half the step.
const HALVED: f64 = 1e4;
/// How long the runs are that are reversed.
const REVERSED: u64 = 200;

/// What a run without a potential leaves.
struct Free {
    /// Relative.
    energy: Deviation,
    momenta: [Deviation; 2],
    /// The largest |ẋ − Rθ̇ cos φ| and |ẏ − Rθ̇ sin φ|.
    across: f64,
    /// θ at the end.
    rolled: f64,
}

/// All that is measured.
struct Measured {
    /// The end of the runs whose energy is followed.
    end: f64,
    free: Free,
    /// Distances at [`ORDER_TIME`] for each of [`ORDER_STEPS`]: of the free disc from the circle, of the one
    /// with a magnet from RK4, and the same by a composition of order 4.
    errors: [[f64; 4]; 3],
    between_references: f64,
    /// The largest difference of a coordinate or velocity from the start, after steps there and back.
    there_and_back: f64,
    /// On springs and with a magnet, at [`H`].
    springs: Growth,
    magnet: Growth,
    /// The latter at half the step.
    magnet_half: Growth,
    /// The same systems by RK4 on the equations without constraints, at [`H`].
    springs_rk4: Growth,
    magnet_rk4: Growth,
    sleigh: Sleigh,
    /// The places of the discs: free, on springs, with a magnet.
    paths: [Vec<[f64; 2]>; 3],
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let (end, end_half) = job.choose((5e4, HALVED), (500.0, 500.0));
    job.expect((growth::STARTS as f64 * (4.0 * end / H + 2.0 * end_half / H)) as u64);
    let fine = reference(FINE);
    let measured = Measured {
        end,
        free: free(job)?,
        errors: [
            errors(&FREE, midpoint(), circle(ORDER_TIME))?,
            errors(&MAGNET, midpoint(), fine)?,
            errors(&MAGNET, Composition::suzuki(midpoint()), fine)?,
        ],
        between_references: distance(fine, reference(2.0 * FINE)),
        there_and_back: there_and_back(&MAGNET, &begin(&MAGNET), REVERSED)?,
        springs: Growth::constrained(job, &SPRINGS, H, end)?,
        magnet: Growth::constrained(job, &MAGNET, H, end)?,
        magnet_half: Growth::constrained(job, &MAGNET, H / 2.0, end_half)?,
        springs_rk4: Growth::rk4(job, &SPRINGS, H, end)?,
        magnet_rk4: Growth::rk4(job, &MAGNET, H, end)?,
        sleigh: Sleigh::new()?,
        paths: [path(&FREE, 16.0)?, path(&SPRINGS, 60.0)?, path(&MAGNET, 60.0)?],
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn midpoint() -> Constrained<Variational<Unfitted, Midpoint>> {
    Constrained::new(Variational::midpoint())
}

fn begin(disc: &RollingDisc) -> RollingDiscState {
    disc.rolling(PLACE, 0.3, RATES)
}

fn place(state: &RollingDiscState) -> [f64; 2] {
    [state.x, state.y]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Where a free disc is: on a circle of radius Rθ̇/φ̇.
fn circle(t: f64) -> [f64; 2] {
    let RollingDiscState { x, y, phi, dot_theta, dot_phi, .. } = begin(&FREE);
    let (radius, after) = (FREE.radius * dot_theta / dot_phi, phi + dot_phi * t);
    [x + radius * (after.sin() - phi.sin()), y - radius * (after.cos() - phi.cos())]
}

/// Where the disc with a magnet is at [`ORDER_TIME`], by RK4.
fn reference(h: f64) -> [f64; 2] {
    let steps = (ORDER_TIME / h).round() as u64;
    let end = (0..steps).fold(start(&begin(&MAGNET)), |y, _| rk4(&y, h, |y| MAGNET.reduced(y)));
    [end[0], end[1]]
}

fn errors<M: Method<RollingDisc, f64> + Clone>(
    disc: &RollingDisc,
    method: M,
    expected: [f64; 2],
) -> Result<[f64; 4]> {
    let mut errors = [f64::NAN; 4];
    for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
        let mut run = Integrator::new(disc, method.clone(), h, begin(disc))?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        *error = distance(place(&run.state()), expected);
    }
    Ok(errors)
}

fn free(job: &Job<'_>) -> Result<Free> {
    let steps: u64 = job.choose(100_000, 2_000);
    let end = steps as f64 * H;
    let mut run = Integrator::new(&FREE, midpoint(), H, begin(&FREE))?;
    let deviation = || Deviation::new(end, 1, end);
    let mut free =
        Free { energy: deviation(), momenta: [deviation(), deviation()], across: 0.0, rolled: 0.0 };
    let momenta =
        |run: &Integrator<'_, _, _>| -> [f64; 2] { [0, 1].map(|k| run.momentum(k).unwrap_or(f64::NAN)) };
    let (energy, before) = (run.energy(), momenta(&run));
    job.expect(steps);
    job.repeat(steps, || {
        run.advance()?;
        let (t, now) = (run.time(), momenta(&run));
        free.energy.push(t, run.energy() / energy - 1.0);
        for ((deviation, now), before) in free.momenta.iter_mut().zip(now).zip(before) {
            deviation.push(t, now / before - 1.0);
        }
        let RollingDiscState { phi, dot_x, dot_y, dot_theta, theta, .. } = run.state();
        let speed = FREE.radius * dot_theta;
        let across = larger((dot_x - speed * phi.cos()).abs(), (dot_y - speed * phi.sin()).abs());
        free.across = larger(free.across, across);
        free.rolled = theta;
        Ok(())
    })?;
    Ok(free)
}

/// The largest difference of a coordinate or velocity from the start, after `steps` steps of length [`H`]
/// and as many back.
fn there_and_back<S>(system: &S, start: &S::State<f64>, steps: u64) -> Result<f64>
where
    S: Lagrangian,
    Constrained<Variational<Unfitted, Midpoint>>: Method<S, f64>,
{
    let mut there = Integrator::new(system, midpoint(), H, start.clone())?;
    there.take_steps(steps)?;
    let mut back = Integrator::new(system, midpoint(), -H, there.state())?;
    back.take_steps(steps)?;
    let end = back.state();
    let apart = system.values(&end)?.zip(system.values(start)?).map(|(a, b): (f64, f64)| (a - b).abs());
    Ok(apart.fold(0.0, larger))
}

fn path(disc: &RollingDisc, end: f64) -> Result<Vec<[f64; 2]>> {
    let mut run = Integrator::new(disc, midpoint(), H, begin(disc))?;
    let mut path = vec![place(&run.state())];
    for _ in 0..(end / H).round() as u64 {
        run.advance()?;
        path.push(place(&run.state()));
    }
    Ok(path)
}
