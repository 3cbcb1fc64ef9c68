//! What constrained steps preserve: the symplectic form on the constraints, momenta, the way back, the
//! constraints themselves.

use dvi_core::methods::{InnerScheme, Method};
use dvi_core::prelude::*;
use dvi_core::{Real, Separable};
use dvi_tests::larger;
use dvi_tests::zoo::constrained::*;
use num_dual::Dual64;

use super::Outcome;
use super::equations::{links, ring};

/// A run whose memory has momenta.
trait Momenta<T> {
    fn momenta(&self) -> Vec<T>;
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Momenta<T> for Integrator<'_, S, Rattle, T> {
    fn momenta(&self) -> Vec<T> {
        self.memory().p().to_vec()
    }
}

impl<S, M, T> Momenta<T> for Integrator<'_, S, Constrained<M>, T>
where
    S: HolonomicLagrangian<T>,
    M: InnerScheme<S, T>,
    T: Real,
{
    fn momenta(&self) -> Vec<T> {
        self.memory().p().to_vec()
    }
}

/// A state whose derivative in a direction is along the constraints.
fn along<S: HolonomicLagrangian<Dual64> + HolonomicLagrangian>(
    system: &S,
    start: &<S as System>::State<f64>,
    phase: f64,
) -> Result<<S as System>::State<Dual64>, Box<dyn core::error::Error>> {
    let values: Vec<f64> = system.values(start)?.collect();
    let moved = |(i, &x): (usize, &f64)| Dual64::new(x, (1.0 + i as f64 * phase).sin());
    let entries: Vec<Dual64> = values.iter().enumerate().map(moved).collect();
    let (q, v) = entries.split_at(entries.len() / 2);
    let state = dvi_core::State::read(|block| system.block_len(block), q, v);
    Ok(system.projected(Dual64::from(0.0), &state)?)
}

/// dq ∧ dp on two tangent vectors.
fn form(one: (&[Dual64], &[Dual64]), other: (&[Dual64], &[Dual64])) -> f64 {
    let pairing = |q: &[Dual64], p: &[Dual64]| q.iter().zip(p).map(|(q, p)| q.eps * p.eps).sum::<f64>();
    pairing(one.0, other.1) - pairing(other.0, one.1)
}

/// By how much the form changes in twenty steps, at most, relative to itself or one.
fn change_of_form<S, M>(
    system: &S,
    method: &M,
    start: &<S as System>::State<f64>,
    h: f64,
) -> Result<f64, Box<dyn core::error::Error>>
where
    S: HolonomicLagrangian<Dual64> + HolonomicLagrangian,
    M: Method<S, Dual64> + Clone,
    for<'a> Integrator<'a, S, M, Dual64>: Momenta<Dual64>,
{
    let mut runs = Vec::new();
    for phase in [0.7, 1.9] {
        let start = along(system, start, phase)?;
        runs.push(Integrator::new(system, method.clone(), Dual64::from(h), start)?);
    }
    let form_of = |runs: &[Integrator<'_, S, M, Dual64>]| {
        let momenta: Vec<Vec<Dual64>> = runs.iter().map(Momenta::momenta).collect();
        form((runs[0].q(), &momenta[0]), (runs[1].q(), &momenta[1]))
    };
    let begin = form_of(&runs);
    assert!(begin.abs() > 1e-3, "the directions say nothing: {begin:e}");
    let mut largest = 0.0;
    for _ in 0..20 {
        for run in &mut runs {
            run.advance()?;
        }
        largest = larger(largest, (form_of(&runs) - begin).abs() / begin.abs().max(1.0));
    }
    Ok(largest)
}

/// `preserved!(system, start, step => method, …)`
macro_rules! preserved {
    ($system:expr, $start:expr, $h:expr => $($method:expr),+ $(,)?) => {$(
        let change = change_of_form(&$system, &$method, &$start, $h)?;
        assert!(change < 1e-12, "{} by {}: {change:e}", stringify!($system), stringify!($method));
    )+};
}

#[test]
fn the_symplectic_form_on_the_constraints_is_preserved() -> Outcome {
    let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
    let start = angles.masses(&DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 });
    let double = Double { m: angles.m, rod: angles.rod };
    preserved! { double, start, 0.1 =>
        Rattle::default(),
        Constrained::new(Variational::trapezoid()),
        Constrained::new(Variational::midpoint()),
        Constrained::new(Variational::sigma(0.2)),
    }
    let bead = on_ring(&BeadParameterState { s: 0.4, dot_s: 0.5 });
    preserved!(Bead, bead, 0.1 => Constrained::new(Variational::midpoint()), Constrained::new(Variational::simpson()));
    let charge = ChargeState { r: [0.6, 0.0, -0.8], dot_r: [0.4, 1.0, 0.3] };
    preserved!(Charge { b: 0.7 }, charge, 0.1 => Constrained::new(Variational::midpoint()));
    let (system, start) = links(4);
    preserved!(system, start, 0.05 => Rattle::default(), Constrained::new(Variational::midpoint()));
    let (system, start) = ring()?;
    preserved!(system, start, 0.05 => Rattle::default(), Constrained::new(Variational::simpson()));
    // A moved pivot changes nothing of that, friction does.
    let swing = swinging(&SwingAngleState { a: 1.2, dot_a: 0.5 }, 0.0);
    let method = Constrained::new(Variational::simpson());
    preserved!(Swing { gamma: 0.0 }, swing, 0.1 => method);
    assert!(change_of_form(&Swing { gamma: 0.5 }, &method, &swing, 0.1)? > 1e-3);
    Ok(())
}

/// The axial momentum, with and without a magnetic field, over many steps.
#[test]
fn momentum_maps_are_conserved() -> Outcome {
    fn check<S: Lagrangian, M: Method<S, f64>>(system: &S, method: M, start: S::State<f64>) -> Outcome {
        let mut run = Integrator::new(system, method, 0.05, start)?;
        let begin = run.momentum(0).ok_or("no momentum")?;
        for _ in 0..100 {
            run.take_steps(200)?;
            let change = run.momentum(0).ok_or("no momentum")? - begin;
            assert!(change.abs() < 1e-12, "{}: {change:e}", S::REPORT.system);
        }
        Ok(())
    }
    let start = SphericalState { r: [0.6, 0.0, -0.8], dot_r: [0.4, 1.0, 0.3] };
    check(&Spherical, Rattle::default(), start)?;
    check(&Spherical, Constrained::new(Variational::simpson()), start)?;
    let start = ChargeState { r: [0.6, 0.0, -0.8], dot_r: [0.4, 1.0, 0.3] };
    check(&Charge { b: 0.7 }, Constrained::new(Variational::midpoint()), start)
}

/// Symmetric steps lead back, others do not.
#[test]
fn symmetric_steps_are_undone_by_steps_back() -> Outcome {
    fn back<S: Lagrangian, M: Method<S, f64> + Clone>(
        system: &S,
        method: &M,
        start: &S::State<f64>,
    ) -> Result<f64, Box<dyn core::error::Error>> {
        let mut run = Integrator::new_at(system, method.clone(), 0.2, 0.04, start.clone())?;
        run.take_steps(30)?;
        let mut back = Integrator::new_at(system, method.clone(), run.time(), -0.04, run.state())?;
        back.take_steps(30)?;
        let end = back.state();
        Ok(system
            .values(&end)?
            .zip(system.values(start)?)
            .map(|(a, b): (f64, f64)| (a - b).abs())
            .fold(0.0, larger))
    }
    let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
    let start = angles.masses(&DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 });
    let double = Double { m: angles.m, rod: angles.rod };
    assert!(back(&double, &Rattle::default(), &start)? < 1e-13);
    assert!(back(&double, &Constrained::new(Variational::midpoint()), &start)? < 1e-13);
    assert!(back(&double, &Constrained::new(Variational::sigma(0.2)), &start)? > 1e-4);
    let bead = on_ring(&BeadParameterState { s: 0.4, dot_s: 0.5 });
    assert!(back(&Bead, &Constrained::new(Variational::simpson()), &bead)? < 1e-13);
    let swing = swinging(&SwingAngleState { a: 1.2, dot_a: 0.5 }, 0.2);
    assert!(back(&Swing { gamma: 0.3 }, &Constrained::new(Variational::midpoint()), &swing)? < 1e-13);
    let (system, start) = links(30);
    assert!(back(&system, &Constrained::new(Variational::trapezoid()), &start)? < 1e-12);
    Ok(())
}
