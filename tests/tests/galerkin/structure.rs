//! What the steps preserve, and that they can be undone.

use dvi_core::discrete::FrequencyIn;
use dvi_core::methods::{Method, PreservedForm};
use dvi_core::prelude::*;
use dvi_core::state::Statistics;
use dvi_core::{Space, State};
use dvi_tests::{apart, larger};
use num_dual::Dual64;

use crate::galerkin::systems::{
    KEPLER, Outcome, chain, double_pendulum, driven, dual, growing, magnetic, pericentre, spherical,
};

/// Entry by entry, (q, p) and its derivative in the direction of entry `direction` of (q, v), at the start
/// and after some steps.
fn tangents<S: RegularLagrangian<Dual64>, M: Method<S, Dual64> + Copy>(
    system: &S,
    start: &S::State<f64>,
    method: M,
    momentum: impl Fn(&M::Memory) -> &[Dual64],
) -> Result<[Vec<Vec<f64>>; 2], Box<dyn core::error::Error>> {
    let n = Space::dimension(system.space());
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    let len = |block| system.block_len(block);
    start.write(len, &mut q, &mut v)?;
    let start = [q, v].concat();
    let [mut first, mut last] = [Vec::new(), Vec::new()];
    for direction in 0..2 * n {
        let varied = dual(&start, Some(direction));
        let state = S::State::<Dual64>::read(len, &varied[..n], &varied[n..]);
        let mut run = Integrator::new(system, method, Dual64::from_re(0.1), state)?;
        let column = |run: &Integrator<'_, S, M, Dual64>| {
            run.q().iter().chain(momentum(run.memory())).map(|x| x.eps).collect::<Vec<_>>()
        };
        first.push(column(&run));
        run.take_steps(3)?;
        last.push(column(&run));
    }
    Ok([first, last])
}

/// The largest change of dq ∧ dp, evaluated on the variations of the start.
fn defect<S: RegularLagrangian<Dual64>, F: FrequencyIn<Dual64> + Copy, const NODES: usize>(
    system: &S,
    start: &S::State<f64>,
    method: Galerkin<NODES, F>,
) -> Result<f64, Box<dyn core::error::Error>> {
    Ok(change_of_form(tangents(system, start, method, |memory| memory.p())?))
}

/// The same of variations at the start and after some steps.
fn change_of_form([first, last]: [Vec<Vec<f64>>; 2]) -> f64 {
    let two_form = |a: &[f64], b: &[f64]| {
        let n = a.len() / 2;
        (0..n).map(|i| a[i] * b[n + i] - a[n + i] * b[i]).sum::<f64>()
    };
    let mut largest: f64 = 0.0;
    for i in 0..first.len() {
        for j in 0..i {
            largest = larger(largest, (two_form(&last[i], &last[j]) - two_form(&first[i], &first[j])).abs());
        }
    }
    largest
}

fn check_symplectic<S: RegularLagrangian<Dual64>, F: FrequencyIn<Dual64> + Copy, const NODES: usize>(
    (system, start): (S, S::State<f64>),
    method: Galerkin<NODES, F>,
) -> Outcome {
    for solver in [Solver::Automatic, Solver::Newton] {
        let method = Galerkin { solver, ..method };
        let found = defect(&system, &start, method)?;
        assert!(found < 1e-11, "{}, {method:?}: {found:e}", S::REPORT.system);
    }
    Ok(())
}

#[test]
fn the_canonical_two_form_is_preserved() -> Outcome {
    assert_eq!(Galerkin::<3>::new().preserved_form(), PreservedForm::Canonical);
    let fitted = Galerkin::<4>::new().phase_fitted(Constant(1.3));
    check_symplectic((KEPLER, pericentre(0.3)), Galerkin::<3>::new())?;
    check_symplectic((KEPLER, pericentre(0.3)), Galerkin::<4>::new())?;
    check_symplectic((KEPLER, pericentre(0.3)), Galerkin::<5>::new())?;
    check_symplectic((KEPLER, pericentre(0.3)), fitted)?;
    check_symplectic(driven(), fitted)?;
    check_symplectic(chain(), Galerkin::<3>::new())?;
    check_symplectic(double_pendulum(), Galerkin::<4>::new())?;
    check_symplectic(double_pendulum(), fitted)?;
    // Most nodes, by the matrix of all unknowns.
    check_symplectic(double_pendulum(), Galerkin::<9>::new())?;
    check_symplectic(spherical(), Galerkin::<3>::new())?;
    check_symplectic(magnetic(), Galerkin::<5>::new())
}

/// By the fixed point too, one by one and in lanes, packs of dual numbers.
#[test]
fn lanes_preserve_the_two_form() -> Outcome {
    macro_rules! check {
        ($system:expr, $start:expr; $($nodes:literal)*) => {{
            let (system, start) = (&$system, &$start);
            $(
                for solver in [Solver::Automatic, Solver::FixedPoint] {
                    let method = Galerkin { solver, ..Galerkin::<$nodes>::new() };
                    let alone = tangents(system, start, method, |memory| memory.p())?;
                    let in_lanes = tangents(system, start, method.in_lanes(), |memory| memory.p())?;
                    assert_eq!(alone, in_lanes, "{} nodes, {solver:?}", $nodes);
                    let found = change_of_form(in_lanes);
                    assert!(found < 1e-13, "{} nodes, {solver:?}: {found:e}", $nodes);
                }
            )*
        }};
    }
    // Two lanes, four and eight.
    check!(KEPLER, pericentre(0.3); 4 9);
    let (system, start) = chain();
    check!(system, start; 6);
    Ok(())
}

#[test]
fn a_frequency_held_constant_does_not_preserve_it() -> Outcome {
    let method = Galerkin::<3>::new().phase_fitted(Radial(Reading::Averaged));
    assert_eq!(method.preserved_form(), PreservedForm::Nothing);
    let found = defect(&KEPLER, &pericentre(0.3), method)?;
    assert!(found > 1e-9, "{found:e}");
    Ok(())
}

fn check_reversal<S: RegularLagrangian, F, const NODES: usize>(
    (system, start): (S, S::State<f64>),
    method: Galerkin<NODES, F>,
) -> Outcome
where
    F: FrequencyIn<f64> + Copy,
{
    let mut forth = Integrator::new(&system, method, 0.1, start)?;
    for _ in 0..5 {
        let first = forth.q().to_vec();
        let momentum = forth.memory().p().to_vec();
        forth.advance()?;
        let mut back = Integrator::new_at(&system, method, forth.time(), -0.1, forth.state())?;
        back.advance()?;
        let error = larger(apart(back.q(), &first), apart(back.memory().p(), &momentum));
        assert!(error < 1e-12, "{}, {method:?}: {error:e}", S::REPORT.system);
    }
    Ok(())
}

#[test]
fn a_step_back_undoes_a_step() -> Outcome {
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<3>::new())?;
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<5>::new().phase_fitted(Radial(Reading::Averaged)))?;
    check_reversal(
        (KEPLER, pericentre(0.3)),
        Galerkin::<4>::new().phase_fitted(Curvature(Reading::Averaged)),
    )?;
    check_reversal(driven(), Galerkin::<4>::new().phase_fitted(Constant(1.3)))?;
    check_reversal(double_pendulum(), Galerkin::<3>::new())?;
    check_reversal(spherical(), Galerkin::<4>::new())?;
    check_reversal(growing(), Galerkin::<5>::new())?;
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<6>::new())?;
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<9>::new())?;
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<9>::new().phase_fitted(Constant(1.3)))?;
    check_reversal(driven(), Galerkin::<8>::new())?;
    check_reversal(chain(), Galerkin::<9>::new())?;
    check_reversal(double_pendulum(), Galerkin::<9>::new())
}

#[test]
fn momentum_maps_are_preserved() -> Outcome {
    fn check<S: RegularLagrangian, F: FrequencyIn<f64>, const NODES: usize>(
        (system, start): (S, S::State<f64>),
        method: Galerkin<NODES, F>,
    ) -> Outcome {
        let mut run = Integrator::new(&system, method, 0.05, start)?;
        let first = run.momentum(0).ok_or("no momentum")?;
        for _ in 0..500 {
            run.advance()?;
            let drift = (run.momentum(0).ok_or("no momentum")? - first).abs();
            assert!(drift < 1e-12, "{}: {drift:e}", S::REPORT.system);
        }
        Ok(())
    }
    check((KEPLER, pericentre(0.3)), Galerkin::<3>::new())?;
    check((KEPLER, pericentre(0.3)), Galerkin::<4>::new().phase_fitted(Constant(1.1)))?;
    check((KEPLER, pericentre(0.3)), Galerkin::<5>::new().phase_fitted(Radial(Reading::Averaged)))?;
    check(spherical(), Galerkin::<4>::new())?;
    check((KEPLER, pericentre(0.3)), Galerkin::<6>::new())?;
    check((KEPLER, pericentre(0.3)), Galerkin::<9>::new())?;
    check((KEPLER, pericentre(0.3)), Galerkin::<9>::new().phase_fitted(Constant(1.1)))?;
    check(spherical(), Galerkin::<9>::new())
}

/// Steps of these lengths there, and of their negatives back.
fn check_variable<S: RegularLagrangian, const NODES: usize>(
    system: &S,
    method: Galerkin<NODES>,
    [q, v]: [&[f64]; 2],
) -> Outcome {
    let mut point = Space::vector(system.space());
    point.copy_from_slice(q);
    let mut memory = method.begin(system, &point, v, 0.0, 0.1)?;
    let momentum = memory.p().to_vec();
    let mut statistics = Statistics::default();
    let (lengths, mut t) = ([0.1, 0.09, 0.1, 0.03, 0.2, 0.01], 0.0);
    let back = lengths.iter().rev().map(|h| -h);
    for h in lengths.iter().copied().chain(back) {
        method.step(system, &mut memory, &mut point, t, h, &mut statistics)?;
        t += h;
    }
    let error = larger(apart(&point, q), apart(memory.p(), &momentum));
    assert!(error < 1e-12, "{}: {error:e}", S::REPORT.system);
    Ok(())
}

#[test]
fn steps_of_different_lengths_may_follow_one_another() -> Outcome {
    check_variable(&KEPLER, Galerkin::<4>::new(), [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable(&KEPLER, Galerkin::<9>::new(), [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable(&double_pendulum().0, Galerkin::<4>::new(), [&[1.1, -0.4], &[0.3, 0.9]])?;
    check_variable(&double_pendulum().0, Galerkin::<9>::new(), [&[1.1, -0.4], &[0.3, 0.9]])?;
    check_variable(&chain().0, Galerkin::<9>::new(), [&[0.1, -0.2, 0.4, 0.3], &[0.5, 0.0, -0.1, 0.2]])
}
