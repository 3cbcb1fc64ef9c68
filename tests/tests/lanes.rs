//! Packs of numbers: formulas on them are those on their lanes, and methods with their stages or nodes in
//! lanes are those methods, bit for bit.

use dvi_core::Space;
use dvi_core::methods::{Here, Step};
use dvi_core::prelude::*;
use dvi_core::scalar::Lanes;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::laws::systems::{Breathing, Magnetic};
use dvi_tests::systems::*;
use dvi_tests::zoo::functions::*;
use dvi_tests::zoo::language::*;
use dvi_tests::zoo::particles::*;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, bits};

use crate::packs::{W, lanes_agree};

fn formulas_in_lanes<S: DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>>(system: &S, q: &[f64]) {
    lanes_agree(q, |q, t, out| system.flow_source(q, t, out), |q, t, out| system.flow_source(q, t, out));
    lanes_agree(q, |q, t, out| system.one_form(q, t, out), |q, t, out| system.one_form(q, t, out));
    lanes_agree(
        q,
        |q, t, out| out[0] = system.hamiltonian(q, t),
        |q, t, out| out[0] = system.hamiltonian(q, t),
    );
}

#[test]
fn formulas_on_packs_are_those_on_their_lanes() {
    formulas_in_lanes(&EveryFunction {}, &[0.35, 0.62]);
    for q in [[0.2, 0.5], [0.7, 0.3], [-0.4, 1.2], [1.4, -0.9]] {
        formulas_in_lanes(&Branches { edge: 0.4 }, &q);
    }
    formulas_in_lanes(&Breathing { depth: 0.3 }, &[0.1, 0.4]);
    formulas_in_lanes(&Corners, &vec![0.4; Corners.space().dimension()]);
}

/// Takes 12 steps, of which the last are guessed from as many increments as are kept: the bits of all points
/// and velocities, and what they have cost.
fn history<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: &M,
    [q0, v0]: [&[f64]; 2],
    h: f64,
) -> Outcome<(Vec<u64>, Statistics)> {
    let (mut q, mut v) = (system.space().vector(), system.space().vector());
    q.copy_from_slice(q0);
    let (t, mut passed, mut statistics) = (0.2, Vec::new(), Statistics::default());
    let mut memory = method.begin(system, &q, v0, t, h)?;
    for number in 0..12 {
        let now = t + f64::from(number) * h;
        let step = Step { system, q: &mut q, t: now, h, statistics: &mut statistics };
        let taken = method.step(step, &mut memory);
        taken.map_err(|failure| format!("{} at step {number}: {failure}", S::REPORT.system))?;
        method.velocity(Here { system, q: &q, t: now + h }, &memory, &mut v)?;
        passed.extend([bits(&q), bits(&v)].concat());
    }
    Ok((passed, statistics))
}

/// Compares steps whose stages or nodes are evaluated one by one with steps in which these are in lanes,
/// with so many of them: three do not fill a pack, as those of the laws in lanes do.
macro_rules! stages {
    ($system:expr, $q:expr, $v:expr, $h:expr) => { stages!(@ $system, $q, $v, $h; Gauss<3>) };
    (@ $system:expr, $q:expr, $v:expr, $h:expr; $($method:ident<$stages:literal>)*) => {{
        let (system, start): (_, [&[f64]; 2]) = (&$system, [&$q, &$v]);
        for summation in [Summation::Compensated, Summation::Plain] {
            for solver in [Solver::Automatic, Solver::Newton] {$(
                let method = $method { summation, solver, ..$method::<$stages>::new() };
                let alone = history(system, &method, start, $h)?;
                assert_eq!(alone, history(system, &method.in_lanes(), start, $h)?, "{method:?}");
            )*}
        }
    }};
}

#[test]
fn stages_in_lanes_are_those_one_by_one_on_degenerate_systems() -> Outcome {
    let (vortices, start) = quasi_periodic();
    // Ω constant and by pairs; at run time; constant and full; full; with time.
    stages!(@ vortices, [start.x, start.y].concat(), [], 0.2; Gauss<8>);
    let many = ManyVortices { gamma: vec![1.0, 0.7, -0.4, 1.2, 0.9] };
    stages!(many, [0.1, 1.3, -0.8, 0.2, -1.1, 0.9, 0.1, -0.3, -1.2, 0.4], [], 0.1);
    let a = [[0.1, 0.9, -0.2, 0.3], [-0.7, 0.2, 0.4, 0.1], [0.3, -0.5, 0.1, 1.1], [0.2, 0.4, -0.8, 0.0]];
    let s = [[1.0, 0.1, 0.0, 0.2], [0.1, 1.2, 0.3, 0.0], [0.0, 0.3, 0.8, 0.1], [0.2, 0.0, 0.1, 1.1]];
    stages!(Quadratic { a, s, quartic: 0.3 }, [0.3, -0.2, 0.5, 0.1], [], 0.1);
    stages!(Mirror, [0.4, 0.3, 0.2, 0.5], [], 0.1);
    stages!(Breathing { depth: 0.3 }, [0.4, -0.3], [], 0.06);
    Ok(())
}

#[test]
fn stages_in_lanes_are_those_one_by_one_on_regular_systems() -> Outcome {
    // M diagonal; full; depending on q and t; L with terms linear in v; not quadratic in v; at run time.
    stages!(@ Kepler { mu: 1.0 }, [1.0, 0.1], [0.1, 0.9], 0.05; Gauss<1> Gauss<2> Gauss<5> Gauss<8>);
    stages!(MixedVelocities {}, [0.4, 0.3], [-0.2, 0.5], 0.1);
    stages!(Magnetic { b: 0.7 }, [0.4, 0.3], [-0.2, 0.5], 0.05);
    stages!(MagneticParticle { m: 1.2, b: 1.0 }, [0.3, -0.2, 0.5], [1.0, 0.4, -0.8], 0.05);
    stages!(Relativistic { m: 1.5 }, [0.3, -1.1], [0.6, -0.5], 0.05);
    let chain = RunTimeChain { mass: vec![1.0, 1.5, 0.8], coupling: 0.2 };
    stages!(chain, [0.1, 0.3, -0.2, 0.4], [0.2, -0.1, 0.3, 0.0], 0.05);
    Ok(())
}

/// Two lanes, four and eight, full and not; with coupled masses.
#[test]
fn interior_nodes_in_lanes_are_those_one_by_one() -> Outcome {
    stages!(@ Kepler { mu: 1.0 }, [0.7, 0.0], [0.0, 1.36], 0.15;
        Galerkin<4> Galerkin<5> Galerkin<7> Galerkin<9>);
    stages!(@ DrivenOscillator { depth: 0.3, omega: 1.7 }, [0.8], [0.3], 0.2; Galerkin<8>);
    let chain = RunTimeChain { mass: vec![1.0, 1.5, 0.7], coupling: 0.2 };
    stages!(@ chain, [0.1, -0.2, 0.4, 0.3], [0.5, 0.0, -0.1, 0.2], 0.2; Galerkin<6>);
    Ok(())
}

/// Both fail at the same step, with the same numbers in the error.
#[test]
fn failures_are_the_same_in_lanes() -> Outcome {
    // Ω vanishes at x = 1.
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = (x - x * x / 2.0) * d(y),
        hamiltonian = x * x / 4.0 - y,
    )]
    struct Folded;
    fn folded<M: Method<Folded, f64>>(method: M) -> Outcome<StepError> {
        let mut run = Integrator::new(&Folded, method, 0.25, FoldedState { x: 0.0, y: 0.3 })?;
        let Err(error) = run.take_steps(1000) else { return Err("it meets the fold".into()) };
        Ok(error)
    }
    assert_eq!(folded(Gauss::<2>::new())?, folded(Gauss::<2>::new().in_lanes())?);
    Ok(())
}

/// Says that a method can be asked for on packs of dual numbers too.
#[test]
fn stages_of_dual_numbers_go_into_lanes() -> Outcome {
    use num_dual::Dual64;
    fn slope<E>(method: Gauss<4, E>) -> Outcome<Dual64>
    where
        Gauss<4, E>: Method<Kepler, Dual64>,
    {
        let number = |x: f64| Dual64::from(x);
        let start = KeplerStateOf {
            x: number(1.0),
            y: number(0.0),
            dot_x: number(0.0),
            dot_y: Dual64::new(0.9, 1.0),
        };
        let mut run = Integrator::new(&Kepler { mu: 1.0 }, method, number(0.1), start)?;
        run.take_steps(20)?;
        Ok(run.state().x)
    }
    let (alone, together) = (slope(Gauss::<4>::new())?, slope(Gauss::<4>::new().in_lanes())?);
    assert_eq!([alone.re, alone.eps].map(f64::to_bits), [together.re, together.eps].map(f64::to_bits));
    Ok(())
}
