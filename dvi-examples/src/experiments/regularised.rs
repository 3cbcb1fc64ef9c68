//! The state of the art on Kepler orbits, against which general methods must be seen.
//!
//! It knows that the force is 1/r². The leapfrog on the logarithmic Hamiltonian stays on the exact orbit and
//! errs in the phase alone; regularisation makes the problem an oscillator, which phase fitting solves
//! exactly.

use super::kepler::Course;
use crate::vocabulary::*;

/// Takes so many steps for each of the periods; each returns the physical time that it takes, the position
/// and the energy.
fn by_period(
    job: &Job<'_>,
    Orbit { e }: Orbit,
    steps: u32,
    periods: u64,
    mut step: impl FnMut() -> (f64, [f64; 2], f64),
) -> Result<Course> {
    let (mut course, mut time, mut rest) = (Course::default(), 0.0, 0.0);
    job.repeat(periods, || {
        for _ in 0..steps {
            let (dt, [x, y], energy) = step();
            // A sum with compensation.
            let (before, wanted) = (time, dt + rest);
            time += wanted;
            rest = wanted - (time - before);
            course.energy = larger(course.energy, (energy + 0.5).abs());
            course.position = larger(course.position, Orbit { e }.error(time, &[x, y]));
            course.off_orbit = larger(course.off_orbit, (x.hypot(y) + e * x - (1.0 - e * e)).abs());
        }
        anyhow::Ok(())
    })?;
    (course.steps, course.evaluations) = (f64::from(steps), f64::from(steps));
    Ok(course)
}

/// Leapfrog on Λ = ln(½p² + B) − ln(1/r), B = −E(0), with `steps` steps per period (Mikkola & Tanikawa 1999;
/// Preto & Tremaine 1999): drift dq = p ds/(½p² + B), dt = ds/(½p² + B), kick dp = −q ds/r².
pub fn logarithmic_hamiltonian(job: &Job<'_>, orbit: Orbit, steps: u32, periods: u64) -> Result<Course> {
    let start = orbit.pericentre();
    let (mut q, mut p) = ([start.x, start.y], [start.dot_x, start.dot_y]);
    let (binding, ds) = (0.5, TAU / f64::from(steps));
    // ds = dt/r advances by 2π each period, as the eccentric anomaly does.
    by_period(job, orbit, steps, periods, || {
        let half = |p: [f64; 2]| 0.5 * ds / (0.5 * dot(p, p) + binding);
        let first = half(p);
        q = moved(q, first, p);
        p = moved(p, -ds / dot(q, q), q);
        let second = half(p);
        q = moved(q, second, p);
        (first + second, q, 0.5 * dot(p, p) - 1.0 / q[0].hypot(q[1]))
    })
}

/// Levi-Civita's regularisation with the phase-fitted recursion, `steps` steps per period.
///
/// Time is the integral of |u|² over the exact oscillation:
/// ∫|u|² ds = |u|²(h/2 + sin 2ωh/4ω) + |u'/ω|²(h/2 − sin 2ωh/4ω) + u·u' sin²(ωh)/ω², ω = ½.
pub fn levi_civita(job: &Job<'_>, orbit: Orbit, steps: u32, periods: u64) -> Result<Course> {
    const OMEGA: f64 = 0.5;
    let Orbit { e } = orbit;
    let h = TAU / f64::from(steps);
    let start = LeviCivitaState { u: [(1.0 - e).sqrt(), 0.0], dot_u: [0.0, OMEGA * (1.0 + e).sqrt()] };
    let method = Variational { fitting: Fitting::PhaseAndMomentum, ..Variational::trapezoid() };
    let mut run = Integrator::new(&LeviCivita {}, method.phase_fitted(Constant(OMEGA)), h, start)?;
    run.advance()?;
    let [mut u, mut next]: [[f64; 2]; 2] = [start.u, [run.q()[0], run.q()[1]]];
    let (sin, cos) = (OMEGA * h).sin_cos();
    let half = (2.0 * OMEGA * h).sin() / (4.0 * OMEGA);
    let square = |x: [f64; 2]| dot(x, x);
    let velocity = |u: [f64; 2], next: [f64; 2]| [0, 1].map(|i| OMEGA * (next[i] - cos * u[i]) / sin);
    let mut du = velocity(u, next);
    by_period(job, orbit, steps, periods, || {
        let dt = square(u) * (0.5 * h + half)
            + square(du) / (OMEGA * OMEGA) * (0.5 * h - half)
            + dot(u, du) * (sin / OMEGA).powi(2);
        // The recursion runs in both directions alike, rounding included.
        (u, next) = (next, [0, 1].map(|i| 2.0 * cos * next[i] - u[i]));
        du = velocity(u, next);
        (dt, [u[0] * u[0] - u[1] * u[1], 2.0 * u[0] * u[1]], (2.0 * square(du) - 1.0) / square(u))
    })
}
