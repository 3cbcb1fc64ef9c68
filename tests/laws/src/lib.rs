//! The table of schemes: each on systems of the kinds that it fits, with what it says of itself.
//!
//! A row is a method with its options, the ways in which its steps are solved and added up, its
//! equations, and an order where that on these systems is not the one that it has everywhere. Every law
//! in `tests` is asked of every row.

pub mod case;

use std::rc::Rc;

use dvi_core::Lagrangian;
use dvi_core::discrete::Rule;
use dvi_core::mechanics::Rates;
use dvi_core::methods::{Composition, EnergyLimit};
use dvi_core::prelude::*;

pub use case::{Case, Fused, Options};
pub use dvi_tests::laws::{equations, formula, fuse, subject, systems};
use equations::{Equations, Nodes};
use formula::Formula;
use subject::Subject;
use systems::*;

use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::*;
use dvi_tests::zoo::constrained::{
    Bead, Charge, Double, DoubleAngles, DoubleAnglesState, Links, Spherical, Swing, SwingAngleState,
    swinging,
};
use dvi_tests::zoo::nonholonomic::{Particle, Steered};
use dvi_tests::zoo::particles::Mirror;
use dvi_tests::zoo::regular::*;

/// Where the order is hidden, by a parasitic mode or by rounding. High orders are measured on the
/// oscillator.
const HIDDEN: usize = 0;

const fn solved(solver: Solver) -> Options {
    Options { solver, summation: Summation::Plain }
}

const COMPENSATED: Options = Options { solver: Solver::Automatic, summation: Summation::Compensated };
/// Of schemes with nothing to solve, and of those that are asked for one way alone.
const ONE: [Options; 1] = [solved(Solver::Automatic)];
/// By every solver that goes with any Lagrangian.
const BY_NEWTON: [Options; 3] =
    [solved(Solver::Automatic), solved(Solver::Newton), solved(Solver::NewtonKrylov)];
/// The same, with compensated sums.
const SOLVED: [Options; 4] = [BY_NEWTON[0], BY_NEWTON[1], BY_NEWTON[2], COMPENSATED];
/// With a fixed point too.
const ALL: [Options; 5] = [SOLVED[0], SOLVED[1], SOLVED[2], SOLVED[3], solved(Solver::FixedPoint)];
/// Of the σ-family.
const PLAIN: [Options; 3] = [solved(Solver::Automatic), solved(Solver::FixedPoint), solved(Solver::Newton)];
const EXPLICIT: [Options; 2] = [ONE[0], COMPENSATED];

/// The first of them, and one of the others in turn: of many rows so that each of them meets each rule and
/// each system.
fn in_turn(all: &[Options], turn: usize) -> [Options; 2] {
    [all[0], all[1 + turn % (all.len() - 1)]]
}

/// A system that lives as long as the tests, and what the laws know of it.
pub type On<S> = (&'static S, Rc<Subject>);

/// Of `start` at t = −0.7, so that nothing begins at a time of zero.
pub fn on<S>(system: S, start: [&[f64]; 2], h: f64) -> On<S>
where
    S: Lagrangian + Formula + System<Kind: Rates<S, f64>> + 'static,
{
    let system: &'static S = Box::leak(Box::new(system));
    (system, Rc::new(Subject::new::<S>(system, start, [-0.7, h])))
}

/// With so few steps that parasites are small.
fn few<S>((system, subject): On<S>, steps: u32) -> On<S> {
    (system, Rc::new(Rc::into_inner(subject).expect("no other").few(steps)))
}

/// The rows of the methods on each of some systems, of which `at` has the options.
macro_rules! rows {
    ($table:ident, [$($on:expr),+ $(,)?], |$at:ident| $rows:tt) => {$(
        let on = &$on;
        rows!(@on $table, on, $at, $rows);
    )+};
    (@on $table:ident, $on:ident, $at:ident,
        {$($method:expr => $options:expr, $equations:expr $(, $order:expr)?;)+}) => {$(
        for options in $options {
            #[allow(unused_variables)]
            let $at = options;
            let of_row = ($equations, None$(.or(Some($order)))?);
            $table.push(Case::new($on.0, &$on.1, options, ($method, $method), of_row));
        }
    )+};
}

fn discrete(c: &[f64], w: &[f64]) -> Equations {
    Equations::Discrete(Nodes::new(c, w))
}

fn fitted(nodes: Nodes) -> Equations {
    Equations::Discrete(nodes.fitted(OMEGA))
}

const OMEGA: f64 = 1.3;
use Equations::{Collocation, Elsewhere};

/// Two-forms that are constant, or depend on time alone.
pub fn affine() -> Vec<Case> {
    let mut table = Vec::new();
    let ((system, start), vortices) =
        (quasi_periodic(), [&[1.0, 2.0, -0.5], &[0.0, 1.0, 0.3], &[0.0, 0.2, 1.5]]);
    let vortices_start = [start.x, start.y].concat();
    let four = on(PointVortices { gamma: system.gamma }, [&vortices_start, &[]], 0.05);
    let [gamma, x, y] = vortices;
    let many = on(ManyVortices { gamma: gamma.to_vec() }, [&[*x, *y].concat(), &[]], 0.05);
    let (driven, breathing) = (
        few(on(Driven {}, [&[0.4, -0.3], &[]], 0.06), 11),
        few(on(Breathing { depth: 0.3 }, [&[0.4, -0.3], &[]], 0.06), 8),
    );
    let quadratic = quadratic();
    for sigma in [0.0, 0.2, 0.5, 0.7, 1.0] {
        rows!(table, [four, many], |at| {
            Sigma { solver: at.solver, parasitic_limit: None, ..Sigma::new(real(sigma)) }
                => PLAIN, discrete(&[sigma], &[1.0]);
        });
    }
    rows!(table, [breathing, driven, quadratic], |at| {
        Sigma { solver: at.solver, parasitic_limit: None, ..Sigma::midpoint() }
            => PLAIN, discrete(&[0.5], &[1.0]);
    });
    // Whose parasites are watched.
    let start = Start::RungeKutta(RungeKutta::heun());
    rows!(table, [four], |at| {
        Sigma { start, summation: at.summation, ..Sigma::new(real(0.25)) }
            => EXPLICIT, discrete(&[0.25], &[1.0]), HIDDEN;
        Sigma { start, ..Sigma::leapfrog() } => ONE, discrete(&[0.0], &[1.0]), HIDDEN;
        Sigma::leapfrog() => ONE, discrete(&[0.0], &[1.0]);
    });
    rows!(table, [four, many], |at| {
        Sigma { summation: at.summation, ..Sigma::midpoint() } => [COMPENSATED], discrete(&[0.5], &[1.0]);
        Sigma { solver: at.solver, ..Sigma::midpoint() } => [BY_NEWTON[2]], discrete(&[0.5], &[1.0]);
    });
    rows!(table, [driven, four], |at| {
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<1>::new() } => ALL, Collocation(1);
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<2>::new() } => ALL, Collocation(2);
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<4>::new() }.in_lanes()
            => ALL, Collocation(4);
    });
    rows!(table, [driven], |at| {
        Projected::symmetric() => ONE, Elsewhere;
    });
    rows!(table, [four], |at| {
        // The implicit midpoint rule, all three of them.
        Sigma::midpoint() => ONE, Collocation(1);
        Projected::symmetric() => ONE, Collocation(1);
        RungeKutta::midpoint() => ONE, Elsewhere;
        RungeKutta::heun() => ONE, Elsewhere;
        RungeKutta::classical() => ONE, Elsewhere;
        Composition::suzuki(Gauss::<1>::new()) => ONE, Elsewhere;
        Composition::suzuki(Composition::suzuki(Gauss::<1>::new())) => ONE, Elsewhere;
        EnergyLimit { method: Sigma::midpoint(), limit: 1e2 } => ONE, discrete(&[0.5], &[1.0]);
    });
    table
}

fn quadratic() -> On<Quadratic> {
    let system = Quadratic {
        a: [[0.3, 1.1, -0.4, 0.2], [-0.7, 0.1, 0.5, 0.9], [0.2, -0.6, 0.4, 1.3], [0.8, -0.1, -1.0, -0.2]],
        s: [[1.0, 0.2, 0.0, 0.1], [0.2, 1.5, -0.3, 0.0], [0.0, -0.3, 0.8, 0.2], [0.1, 0.0, 0.2, 1.2]],
        quartic: 0.3,
    };
    few(on(system, [&[0.5, -0.3, 0.4, 0.2], &[]], 0.02), 10)
}

fn prey() -> On<LotkaVolterra> {
    few(on(LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] }, [&[1.3, 1.6], &[]], 0.02), 7)
}

/// Two-forms that depend on the place, and couple any coordinates.
pub fn at_large() -> Vec<Case> {
    let mut table = Vec::new();
    let curved = few(on(Curved { kappa: 0.2 }, [&[0.6, -0.4], &[]], 0.05), 20);
    let guiding = few(on(Guiding { kappa: 0.4 }, [&[0.6, -0.5, 0.2, 0.7], &[]], 0.06), 6);
    let sphere = few(on(SphereForm { gamma: 1.5 }, [&[0.4, 0.3], &[]], 0.05), 8);
    let mirror = on(Mirror, [&[0.4, 0.3, 0.2, 0.5], &[]], 0.1);
    let loose = on(Loose { n: 2 }, [&[0.3, -0.4, 0.5, 0.1], &[]], 0.1);
    let prey = prey();
    rows!(table, [curved, prey, guiding, sphere], |at| {
        Sigma { solver: at.solver, parasitic_limit: None, ..Sigma::midpoint() }
            => PLAIN, discrete(&[0.5], &[1.0]);
    });
    rows!(table, [guiding, prey], |at| {
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<2>::new() } => ALL, Collocation(2);
        Gauss { solver: at.solver, ..Gauss::<8>::new() }.in_lanes() => PLAIN, Collocation(8), HIDDEN;
    });
    rows!(table, [mirror, loose, prey], |at| {
        Projected::symmetric() => ONE, Elsewhere;
        Composition::suzuki(Projected::symmetric()) => ONE, Elsewhere;
    });
    rows!(table, [guiding], |at| {
        RungeKutta::classical() => ONE, Elsewhere;
    });
    table
}

/// α = ϑ·dx with half of the coordinates.
pub fn in_class() -> Vec<Case> {
    let mut table = Vec::new();
    let mixed = on(Mixed, [&[0.4, 0.3, -0.5, 0.7], &[]], 0.1);
    let belt = on(Belt { n: 3 }, [&[0.3, -0.4, 0.2, 0.5, 0.1, -0.3], &[]], 0.1);
    let sphere = on(SphereForm { gamma: 1.3 }, [&[0.4, 0.3], &[]], 0.1);
    let canonical = on(Canonical { n: 2, k: 1.0, gamma: 0.2 }, [&[0.6, 0.5, 0.3, -0.2], &[]], 0.1);
    let harvested = on(Harvested { harvest: 0.1 }, [&[1.4, 1.7], &[]], 0.05);
    rows!(table, [mixed, belt, sphere, canonical, harvested], |at| {
        OneStep::midpoint() => ONE, Elsewhere;
        OneStep::trapezoid() => ONE, Elsewhere;
        OneStepGauss::<2>::new() => ONE, Elsewhere;
        OneStepGauss::<3>::new() => ONE, Elsewhere;
        Composition::suzuki(OneStep::midpoint()) => ONE, Elsewhere;
        Composition::kahan_li_8(OneStep::trapezoid()) => ONE, Elsewhere;
    });
    rows!(table, [mixed, sphere], |at| {
        OneStepGauss::<1>::new() => ONE, Elsewhere;
        OneStepGauss::<4>::new() => ONE, Elsewhere;
        Composition::kahan_li_6(OneStep::midpoint()) => ONE, Elsewhere;
    });
    rows!(table, [canonical, harvested], |at| {
        Sigma { solver: at.solver, ..Sigma::midpoint() } => PLAIN, Elsewhere;
        Projected::symmetric() => ONE, Elsewhere;
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<3>::new() } => ALL, Collocation(3);
        RungeKutta::classical() => ONE, Elsewhere;
    });
    // Of an affine form both are the midpoint rule.
    rows!(table, [canonical], |at| {
        Sigma::midpoint() => ONE, Collocation(1);
        OneStep::midpoint() => ONE, Collocation(1);
    });
    table
}

/// Forces at the ends and inside, and what is solved for in between.
pub fn separable() -> Vec<Case> {
    let mut table = Vec::new();
    let shaken = on(Shaken { depth: 0.4 }, [&[0.5, -0.2], &[0.4, -0.3]], 0.06);
    let coupled = on(Coupled { mass: vec![1.0, 2.0, 1.5] }, [&[0.2, -0.1, 0.4], &[0.3, 0.5, -0.2]], 0.06);
    let swirl = on(Swirl { swirl: 0.6 }, [&[0.7, 0.4], &[-0.2, 0.5]], 0.06);
    let kepler = on(Kepler { mu: 1.0 }, [&[0.7, 0.1], &[0.2, 1.3]], 0.05);
    for beta in [0.0, 1.0 / 12.0, 0.25, 0.5] {
        let options = || if beta == 0.0 { EXPLICIT.iter().copied() } else { ALL.iter().copied() };
        rows!(table, [shaken, coupled, kepler, swirl], |at| {
            Newmark { solver: at.solver, summation: at.summation, ..Newmark::new(real(beta)) }
                => options(), Equations::Newmark(beta);
        });
    }
    rows!(table, [shaken, coupled, kepler, swirl], |at| {
        Variational { summation: at.summation, ..Variational::trapezoid() }
            => EXPLICIT, discrete(&[0.0, 1.0], &[0.5, 0.5]);
        Variational { solver: at.solver, summation: at.summation, ..Variational::midpoint() }
            => ALL, discrete(&[0.5], &[1.0]);
        Variational { solver: at.solver, summation: at.summation, ..Variational::simpson() }
            => ALL, discrete(&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]);
        Variational { solver: at.solver, ..Variational::simpson() }.phase_fitted(Constant(OMEGA))
            => BY_NEWTON, fitted(Nodes::new(&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]));
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<3>::new() }
            => ALL, Equations::Discrete(Nodes::lobatto(3));
        Galerkin { solver: at.solver, ..Galerkin::<3>::new() }.phase_fitted(Constant(OMEGA))
            => BY_NEWTON, fitted(Nodes::lobatto(3));
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<6>::new() }.in_lanes()
            => ALL, Equations::Discrete(Nodes::lobatto(6)), HIDDEN;
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<2>::new() } => ALL, Collocation(2);
    });
    rows!(table, [shaken, kepler], |at| {
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<5>::new() }
            => ALL, Equations::Discrete(Nodes::lobatto(5));
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<1>::new() } => ALL, Collocation(1);
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<8>::new() }.in_lanes()
            => ALL, Collocation(8), HIDDEN;
        RungeKutta::midpoint() => ONE, Elsewhere;
        RungeKutta::heun() => ONE, Elsewhere;
        RungeKutta::classical() => ONE, Elsewhere;
        Composition::suzuki(Variational::trapezoid()) => ONE, Elsewhere;
        Composition::kahan_li_6(Variational::trapezoid()) => ONE, Elsewhere;
        Composition::kahan_li_8(Variational::trapezoid()) => ONE, Elsewhere;
        EnergyLimit { method: Newmark::new(real(0.25)), limit: 1e2 } => ONE, Equations::Newmark(0.25);
    });
    for (number, rule) in rules().into_iter().flat_map(|rule| [rule, rule]).enumerate() {
        let (fitting, nodes) = if number % 2 == 1 {
            let nodes =
                Nodes { fitted_momenta: true, ..Nodes::new(rule.nodes(), rule.weights()).fitted(OMEGA) };
            (Fitting::PhaseAndMomentum, nodes)
        } else {
            (Fitting::Phase, Nodes::new(rule.nodes(), rule.weights()).fitted(OMEGA))
        };
        rows!(table, [shaken, coupled, swirl, kepler], |at| {
            Variational { solver: at.solver, fitting, ..Variational::new(rule) }.phase_fitted(Constant(OMEGA))
                => in_turn(&BY_NEWTON, number / 2 + table.len() / 2), Equations::Discrete(nodes.clone());
        });
    }
    for (reading, lobatto) in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational]
        .into_iter()
        .filter_map(|reading| Some((reading, Quadrature::lobatto(4).ok()?)))
    {
        let order = if reading == Reading::LeftFrozen { 3 } else { 4 };
        rows!(table, [kepler], |at| {
            Variational { solver: at.solver, ..Variational::new(lobatto) }
                .phase_fitted(Radial(reading)) => PLAIN, Elsewhere, order;
            Variational { solver: at.solver, ..Variational::new(Quadrature::simpson()) }
                .phase_fitted(Curvature(reading)) => PLAIN, Elsewhere, 2;
        });
    }
    rows!(table, [kepler], |at| {
        Galerkin { solver: at.solver, ..Galerkin::<3>::new() }.phase_fitted(Radial(Reading::Averaged))
            => PLAIN, Elsewhere;
        Galerkin { solver: at.solver, ..Galerkin::<4>::new() }.phase_fitted(Curvature(Reading::Averaged))
            => PLAIN, Elsewhere;
    });
    table
}

/// Rules of one node, with and without symmetry, with weights of both signs, and of many nodes.
fn rules() -> Vec<Quadrature> {
    let rules = [
        Ok(Quadrature::sigma(0.0)),
        Ok(Quadrature::sigma(0.3)),
        Ok(Quadrature::sigma(1.0)),
        Quadrature::new(&[0.9, 0.1, 0.4], &[0.5, 0.75, -0.25]),
        // Of Radau.
        Quadrature::new(&[1.0 / 3.0, 1.0], &[0.75, 0.25]),
        Quadrature::new(&[0.0, 1.0 / 3.0, 0.5, 0.8, 1.0], &[0.1, 0.3, 0.2, 0.25, 0.15]),
        Quadrature::gauss(2),
        Quadrature::gauss(5),
        Quadrature::lobatto(4),
        // The mean of midpoint and trapezoid.
        Quadrature::new(&[0.0, 0.5, 1.0], &[0.25, 0.5, 0.25]),
    ];
    rules.map(|rule| rule.expect("nodes and weights of a rule")).to_vec()
}

/// Masses that depend on the place, terms that are linear in velocities, and L that is no polynomial in
/// them.
pub fn regular() -> Vec<Case> {
    let mut table = Vec::new();
    let magnetic = on(Magnetic { b: 0.7 }, [&[0.5, -0.2], &[0.4, -0.3]], 0.06);
    let fast = on(Fast { field: 0.6 }, [&[0.5, -0.2], &[0.4, -0.3]], 0.06);
    let damped = on(Damped { gamma: 0.3 }, [&[1.2, 0.0], &[0.1, 0.9]], 0.03);
    let dragged = on(Pulled { drag: [0.5, 0.8] }, [&[0.3, -0.2, 0.5], &[0.4, 0.6, 0.7]], 0.06);
    let spherical = on(SphericalPendulum { g: 1.0 }, [&[1.2, 0.3], &[0.4, 0.8]], 0.05);
    rows!(table, [magnetic, fast, damped, dragged, spherical], |at| {
        Variational { solver: at.solver, summation: at.summation, ..Variational::trapezoid() }
            => SOLVED, discrete(&[0.0, 1.0], &[0.5, 0.5]);
        Variational { solver: at.solver, summation: at.summation, ..Variational::midpoint() }
            => SOLVED, discrete(&[0.5], &[1.0]);
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<3>::new() }
            => SOLVED, Equations::Discrete(Nodes::lobatto(3));
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<2>::new() } => ALL, Collocation(2);
    });
    rows!(table, [magnetic, dragged], |at| {
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<4>::new() }
            => SOLVED, Equations::Discrete(Nodes::lobatto(4));
        Galerkin { solver: at.solver, ..Galerkin::<5>::new() }.phase_fitted(Constant(OMEGA))
            => BY_NEWTON, fitted(Nodes::lobatto(5));
        Galerkin { solver: at.solver, summation: at.summation, ..Galerkin::<9>::new() }.in_lanes()
            => SOLVED, Equations::Discrete(Nodes::lobatto(9)), HIDDEN;
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<1>::new() } => ALL, Collocation(1);
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<3>::new() } => ALL, Collocation(3);
        Gauss { solver: at.solver, summation: at.summation, ..Gauss::<8>::new() }.in_lanes()
            => ALL, Collocation(8), HIDDEN;
        RungeKutta::classical() => ONE, Elsewhere;
        Composition::suzuki(Variational::midpoint()) => ONE, Elsewhere;
    });
    let pendulums = {
        let system = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
        on(system, [&[1.2, -0.4], &[0.3, 0.9]], 0.05)
    };
    let ring = {
        let system = Ring { mass: [1.0, 2.0, 0.5, 1.5], alpha: 0.3 };
        on(system, [&[0.1, -0.2, 0.3, 0.0], &[0.5, 0.1, -0.4, 0.2]], 0.07)
    };
    let chain = {
        let system = RunTimeChain { mass: vec![1.0, 2.0, 1.5], coupling: 0.2 };
        on(system, [&[0.1, -0.2, 0.3, 0.0], &[0.5, 0.1, -0.4, 0.2]], 0.07)
    };
    let particle = on(MagneticParticle { m: 1.0, b: 0.8 }, [&[0.3, 0.2, 0.1], &[0.4, -0.6, 0.2]], 0.05);
    let planar: [&[f64]; 2] = [&[0.3, 0.2], &[0.4, -0.6]];
    let mixed = on(MixedVelocities {}, planar, 0.05);
    let surface = on(Surface { k: 1.3 }, planar, 0.05);
    let growing = on(GrowingMass {}, planar, 0.05);
    let relativistic = on(Relativistic { m: 1.0 }, planar, 0.05);
    let driven = on(DrivenOscillator { depth: 0.3, omega: 2.0 }, [&[0.4], &[0.9]], 0.07);
    for rule in rules() {
        let nodes = Nodes::new(rule.nodes(), rule.weights());
        rows!(
            table,
            [
                pendulums, ring, chain, particle, magnetic, fast, damped, dragged, spherical, mixed,
                surface, growing, relativistic, driven,
            ],
            |at| {
                Variational { solver: at.solver, summation: at.summation, ..Variational::new(rule) }
                    => in_turn(&SOLVED, table.len() / 2), Equations::Discrete(nodes.clone());
            }
        );
    }
    table
}

/// Steps that are long against the fastest motion.
pub fn stiff(options: &[Options]) -> Vec<Case> {
    let mut table = Vec::new();
    let rubbing = Rubbing { b: 0.7, k: 2e4, gamma: 200.0 };
    rows!(
        table,
        [
            few(on(Hard { k: 1e4 }, [&[0.6, 0.8], &[-0.24, 0.18]], 0.1), 12),
            few(on(rubbing, [&[0.15, -0.7], &[0.4, -0.3]], 0.2), 12),
            few(on(Linked { n: 2, k: 4e4 }, [&[0.05, -0.02], &[0.4, -0.3]], 0.2), 12),
            few(on(Canonical { n: 2, k: 1e3, gamma: 0.5 }, [&[0.1, 0.05, 0.3, -0.2], &[]], 0.2), 12),
            few(on(Bent { k: 40.0 }, [&[0.1, -0.2], &[]], 0.2), 12),
        ],
        |at| {
            Gauss { solver: at.solver, ..Gauss::<1>::new() }
                => options.iter().copied(), Collocation(1), HIDDEN;
            Gauss { solver: at.solver, ..Gauss::<4>::new() }.in_lanes()
                => options.iter().copied(), Collocation(4), HIDDEN;
        }
    );
    table
}

/// Every way in which a stiff step is solved.
pub const STIFF: [Options; 3] = BY_NEWTON;
/// The one in which it cannot be.
pub const NOT_STIFF: [Options; 1] = [solved(Solver::FixedPoint)];

/// Holonomic constraints.
pub fn constrained() -> Vec<Case> {
    let mut table = Vec::new();
    let double = {
        let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
        let at = angles.masses(&DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 });
        let system = Double { m: angles.m, rod: angles.rod };
        on(system, [&[at.x, at.y].concat(), &[at.dot_x, at.dot_y].concat()], 0.05)
    };
    let sphere: [&[f64]; 2] = [&[0.6, 0.0, -0.8], &[0.4, 1.0, 0.3]];
    let swing = {
        let at = swinging(&SwingAngleState { a: 1.2, dot_a: 0.5 }, -0.7);
        on(Swing { gamma: 0.4 }, [&[at.x, at.y], &[at.dot_x, at.dot_y]], 0.05)
    };
    let bead = {
        let (half, (sin, cos)) = (0.5_f64.sqrt(), 0.4_f64.sin_cos());
        on(Bead, [&[cos, half * sin], &[-0.5 * sin, half * 0.5 * cos]], 0.05)
    };
    let links = {
        let (system, at) = Links::stretched(vec![1.0; 4]);
        on(system, [&[at.x, at.y].concat(), &[at.dot_x, at.dot_y].concat()], 0.02)
    };
    rows!(table, [double, on(Spherical, sphere, 0.05), links], |at| {
        Rattle::default() => ONE, discrete(&[0.0, 1.0], &[0.5, 0.5]);
        Composition::suzuki(Rattle::default()) => ONE, Elsewhere;
        Composition::kahan_li_6(Rattle::default()) => ONE, Elsewhere;
    });
    rows!(table, [double, on(Charge { b: 0.7 }, sphere, 0.05), swing, bead, links], |at| {
        Constrained::new(Midpoint) => ONE, discrete(&[0.5], &[1.0]);
        Constrained::new(Quadrature::trapezoid())
            => ONE, discrete(&[0.0, 1.0], &[0.5, 0.5]);
        Constrained::new(Quadrature::simpson())
            => ONE, discrete(&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]);
        Constrained::new(Quadrature::sigma(0.3)) => ONE, discrete(&[0.3], &[1.0]);
        Composition::suzuki(Constrained::new(Midpoint)) => ONE, Elsewhere;
    });
    table
}

/// Constraints of the velocities, of which one moves, with friction.
pub fn nonholonomic() -> Vec<Case> {
    let mut table = Vec::new();
    let particle = on(Particle, [&[1.0, 0.5, 0.2], &[0.4, -0.8, 0.2]], 0.05);
    let steered = on(Steered, [&[0.5, 0.0], &[1.0, 0.5 + f64::cos(0.7)]], 0.05);
    rows!(table, [particle, steered], |at| {
        Constrained::new(Midpoint) => ONE, discrete(&[0.5], &[1.0]);
        Constrained::new(Quadrature::trapezoid())
            => ONE, discrete(&[0.0, 1.0], &[0.5, 0.5]);
        Constrained::new(Quadrature::sigma(0.3)) => ONE, discrete(&[0.3], &[1.0]);
        Composition::suzuki(Constrained::new(Midpoint)) => ONE, Elsewhere;
        Composition::kahan_li_6(Constrained::new(Midpoint)) => ONE, Elsewhere;
    });
    table
}

/// All of them.
pub fn all() -> Vec<Case> {
    [affine(), at_large(), in_class(), separable(), regular(), stiff(&STIFF), constrained(), nonholonomic()]
        .into_iter()
        .flatten()
        .collect()
}

/// Each scheme on the system of its kind that has a fuse.
pub fn fused() -> Vec<Fused> {
    let mut table = Vec::new();
    macro_rules! rows {
        ($system:expr, [$q:expr, $v:expr], $h:literal; $($method:expr),+ $(,)?) => {
            $(table.push(Fused::new(&$system, [&$q, &$v], [-0.7, $h], $method));)+
        };
    }
    let summation = Summation::Compensated;
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        rows!(FusedFlow, [[0.4, -0.3], []], 0.1;
            Sigma { solver, ..Sigma::midpoint() },
            Sigma { solver, summation, ..Sigma::midpoint() },
            Gauss { solver, ..Gauss::<2>::new() },
            Gauss { solver, ..Gauss::<4>::new() }.in_lanes(),
        );
        rows!(FusedSeparable, [[0.5, -0.2], [0.4, -0.3]], 0.1;
            Variational { solver, ..Variational::midpoint() },
            Variational { solver, summation, ..Variational::simpson() },
            Newmark { solver, ..Newmark::new(0.25) },
            Galerkin { solver, ..Galerkin::<3>::new() },
            Galerkin { solver, summation, ..Galerkin::<6>::new() }.in_lanes(),
            Gauss { solver, ..Gauss::<2>::new() },
        );
    }
    rows!(FusedFlow, [[0.4, -0.3], []], 0.1;
        Sigma::leapfrog(),
        Sigma::new(0.3),
    );
    rows!(FusedForm, [[0.4, -0.3], []], 0.1;
        Sigma::midpoint(),
        OneStep::midpoint(),
        OneStep::trapezoid(),
        OneStepGauss::<3>::new(),
        Projected::symmetric(),
        Gauss::<2>::new(),
        RungeKutta::classical(),
        Composition::suzuki(OneStep::midpoint()),
    );
    rows!(FusedSeparable, [[0.5, -0.2], [0.4, -0.3]], 0.1;
        Variational::trapezoid(),
        Variational { summation, ..Variational::trapezoid() },
        Newmark::new(0.0),
        Variational::simpson().phase_fitted(Constant(OMEGA)),
        Langevin { friction: 0.3, temperature: 0.1, seed: 1 },
        RungeKutta::heun(),
        Composition::kahan_li_6(Variational::trapezoid()),
        EnergyLimit { method: Variational::trapezoid(), limit: 1e2 },
    );
    rows!(FusedMass, [[0.5, -0.2], [0.4, -0.3]], 0.1;
        Variational::midpoint(),
        Variational::trapezoid(),
        Galerkin::<3>::new(),
        Gauss::<2>::new(),
        RungeKutta::classical(),
    );
    rows!(FusedRod, [[0.6, -0.8], [0.8, 0.6]], 0.1;
        Rattle::default(),
        Constrained::new(Midpoint),
        Composition::suzuki(Rattle::default()),
    );
    rows!(FusedBall, [[0.3, 0.1], [0.2, -0.4]], 0.1;
        Impacts::new(Variational::midpoint()),
        Impacts::new(Variational::trapezoid()),
        Impacts::reflecting(Galerkin::<3>::new()),
    );
    let turned = dvi_core::rotations::exp([0.3, -0.2, 0.6]);
    rows!(FusedBody, [turned, [0.4, 0.9, -0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]], 0.1;
        Geodesic::midpoint(),
        Geodesic::trapezoid(),
        Composition::suzuki(Geodesic::trapezoid()),
    );
    table
}
