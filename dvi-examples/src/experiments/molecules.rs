//! A chain of rigid molecules by RATTLE, and the same molecules with stiff springs in place of the rods.
//!
//! RATTLE keeps momenta and rods to rounding, and the energy has no trend (Andersen 1983; Leimkuhler & Skeel
//! 1994). Steps with springs must be shorter than 2/ω for the fastest vibration of a molecule, ω² = 3k/m,
//! whatever the chain does; with rods the chain sets the length of the steps.

mod claims;
mod picture;
mod scan;
mod series;

use anyhow::Result;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::experiments::accelerations::Accelerations;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{RigidMolecules, RigidMoleculesState, SpringMolecules};
use scan::Scan;
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "molecules",
    title: "A chain of rigid molecules by RATTLE, beside molecules with stiff springs",
    share: 10.0,
    run,
};

const MOLECULES: usize = 8;
const BETA: f64 = 4.0;
const SPEED: f64 = 0.4;
const RIGID: RigidMolecules = RigidMolecules { n: MOLECULES, beta: BETA };
/// The stiffness of the springs.
const SOFT: f64 = 1e4;
const STIFF: f64 = 1e5;
/// The step with rods, and the one with soft springs.
const H: f64 = 0.05;
const H_SPRINGS: f64 = 0.01;
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 2.0;
const ORDER_STEPS: [f64; 4] = [0.04, 0.02, 0.01, 0.005];
const FINE: f64 = 0.00125;
/// How long the run is that is reversed.
const REVERSED: u64 = 400;

/// All that is measured.
struct Measured {
    end: f64,
    rods: Series,
    springs: Series,
    /// The chain with rods when it is drawn, and the time.
    instant: (f64, Vec<[f64; 2]>),
    /// The energy error over the length of the steps: rods, soft springs, stiff springs.
    scans: [Scan; 3],
    /// The largest distance of an atom from the reference at [`ORDER_TIME`], for each of [`ORDER_STEPS`].
    errors: [f64; 4],
    between_references: f64,
    /// The largest difference of a coordinate or velocity from the start, after steps there and back.
    there_and_back: f64,
}

fn springs(k: f64) -> SpringMolecules {
    SpringMolecules { n: MOLECULES, beta: BETA, k }
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(5000.0, 100.0);
    let scanned = job.choose(50.0, 10.0);
    job.expect(((end / H).round() + (end / H_SPRINGS).round()) as u64);
    let start = RIGID.chain(SPEED)?;
    let (soft, stiff) = (springs(SOFT), springs(STIFF));
    let fine = reference(FINE)?;
    let measured = Measured {
        end,
        rods: Series::new(job, "rods, RATTLE", &RIGID, Rattle::default(), start.clone(), H, end)?,
        springs: Series::new(
            job,
            "springs, trapezoid",
            &soft,
            Variational::trapezoid(),
            start.clone().into(),
            H_SPRINGS,
            end,
        )?,
        instant: instant()?,
        scans: [
            Scan::new(job, &RIGID, &Rattle::default(), &start, [0.01, 0.16], scanned)?,
            Scan::new(job, &soft, &Variational::trapezoid(), &start.clone().into(), [0.005, 0.04], scanned)?,
            Scan::new(
                job,
                &stiff,
                &Variational::trapezoid(),
                &start.clone().into(),
                [0.0025, 0.02],
                scanned,
            )?,
        ],
        errors: errors(&fine)?,
        between_references: distance(&fine, &reference(2.0 * FINE)?),
        there_and_back: there_and_back(start)?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(&measured), references: vec![], notes: vec![] })
}

/// Where the atoms are.
fn atoms(state: &RigidMoleculesState) -> Vec<[f64; 2]> {
    state.x.iter().zip(&state.y).map(|(&x, &y)| [x, y]).collect()
}

/// The largest distance of an atom of one from the same atom of the other.
fn distance(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    let apart = one.iter().zip(other).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    apart.fold(0.0, larger)
}

fn errors(reference: &[[f64; 2]]) -> Result<[f64; 4]> {
    let mut errors = [f64::NAN; 4];
    for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
        let mut run = Integrator::new(&RIGID, Rattle::default(), h, RIGID.chain(SPEED)?)?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        *error = distance(&atoms(&run.state()), reference);
    }
    Ok(errors)
}

/// The atoms at [`ORDER_TIME`] by RK4.
fn reference(h: f64) -> Result<Vec<[f64; 2]>> {
    let mut run = Accelerations::new(&RIGID, h, &RIGID.chain(SPEED)?)?;
    for _ in 0..(ORDER_TIME / h).round() as u64 {
        run.step()?;
    }
    Ok(atoms(&run.state()))
}

fn there_and_back(start: RigidMoleculesState) -> Result<f64> {
    let mut there = Integrator::new(&RIGID, Rattle::default(), H, start.clone())?;
    there.take_steps(REVERSED)?;
    let mut back = Integrator::new_at(&RIGID, Rattle::default(), there.time(), -H, there.state())?;
    back.take_steps(REVERSED)?;
    let end = back.state();
    let apart = RIGID.values(&end)?.zip(RIGID.values(&start)?).map(|(a, b): (f64, f64)| (a - b).abs());
    Ok(apart.fold(0.0, larger))
}

/// The chain after some time, about its centre of mass.
fn instant() -> Result<(f64, Vec<[f64; 2]>)> {
    let mut run = Integrator::new(&RIGID, Rattle::default(), H, RIGID.chain(SPEED)?)?;
    run.take_steps(1000)?;
    let mut atoms = atoms(&run.state());
    let count = atoms.len() as f64;
    let centre: [f64; 2] = std::array::from_fn(|i| atoms.iter().map(|atom| atom[i]).sum::<f64>() / count);
    for atom in &mut atoms {
        *atom = std::array::from_fn(|i| atom[i] - centre[i]);
    }
    Ok((run.time(), atoms))
}
