//! Which scheme conserves what: the linear impulses ΣΓx and ΣΓy, the angular impulse ΣΓ|z|², its discrete
//! counterpart J_d = D₂L_d·ξ, and the discrete two-form (Rowley & Marsden 2002, eq. 17 and section 6).

use crate::claim::larger;
use anyhow::Result;
use dvi_core::discrete::Interval;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim};
use crate::figure::{AMBER, Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, PURPLE, Panel, VERMILLION};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case, FourPoints, FourVortices};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "momenta", title: "Conserved quantities, scheme by scheme", share: 1.0, run };

const H: f64 = 0.1;
const STEPS: u64 = 1000;
/// The index of ΣΓ|z|² among the declared momenta.
const ANGULAR: usize = 2;

/// The largest deviations of one scheme from the initial values.
#[derive(Clone, Debug)]
struct Drifts {
    scheme: &'static str,
    /// ΣΓx, ΣΓy, ΣΓ|z|².
    momenta: [f64; 3],
    /// J_d, of the variational schemes.
    discrete: Option<f64>,
    /// The largest change of the two-form under the tangent map of a step: of the discrete one (17), of
    /// one-step methods Ω.
    two_form: Option<f64>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    job.expect(7 * STEPS);
    let case = models::quasi_periodic();
    let rk = Start::RungeKutta(RungeKutta::midpoint());
    let quarter = Sigma { start: rk, ..Sigma::new(0.25) };
    let all = [
        variational(job, &case, "VI2 (σ = ½)", Sigma::midpoint())?,
        variational(job, &case, "σ = ½, RK2 start", Sigma { start: rk, ..Sigma::midpoint() })?,
        variational(job, &case, "σ = ¼", quarter)?,
        // What it preserves, it preserves whatever becomes of its parasitic mode.
        variational(
            job,
            &case,
            "VE2 (σ = 0)",
            Sigma { start: rk, parasitic_limit: None, ..Sigma::leapfrog() },
        )?,
        baseline(job, &case, "RK2", RungeKutta::midpoint())?,
        baseline(job, &case, "RK4", RungeKutta::classical())?,
        baseline(job, &case, "Gauss, order 4", Gauss::<2>::new())?,
    ];
    job.publish(EXPERIMENT.name, figure(&all), table(&all)?)?;
    Ok(Outcome { claims: claims(&all), references: vec![], notes: vec![] })
}

fn baseline(
    job: &Job<'_>,
    case: &Case,
    scheme: &'static str,
    method: impl Method<FourVortices, f64> + Copy,
) -> Result<Drifts> {
    let two_form = Some(one_step_defect(case, method)?);
    Ok(Drifts { two_form, ..conserved(job, case, scheme, method)? })
}

/// The deviations of the momenta.
fn conserved(
    job: &Job<'_>,
    Case { vortices, start }: &Case,
    scheme: &'static str,
    method: impl Method<FourVortices, f64>,
) -> Result<Drifts> {
    let mut run = Integrator::new(vortices, method, H, *start)?;
    let initial: Vec<f64> = run.momenta().map(|(_, value)| value).collect();
    let mut momenta = [0.0f64; 3];
    job.repeat(STEPS, || {
        run.advance()?;
        for ((_, value), (drift, initial)) in run.momenta().zip(momenta.iter_mut().zip(&initial)) {
            *drift = larger(*drift, (value - initial).abs());
        }
        Ok(())
    })?;
    Ok(Drifts { scheme, momenta, discrete: None, two_form: None })
}

/// Points of the orbit at which the tangent map of a one-step method is looked at.
const LOOKS: u64 = 10;

/// The largest change of the two-form Ω = ΣΓ dx ∧ dy under the tangent map of a step, by finite differences
/// of fourth order.
fn one_step_defect(
    Case { vortices, start }: &Case,
    method: impl Method<FourVortices, f64> + Copy,
) -> Result<f64> {
    const DISPLACEMENT: f64 = 1e-3;
    let stepped = |q: [f64; 8]| -> Result<[f64; 8]> {
        let mut run = Integrator::new(vortices, method, H, points(q))?;
        run.advance()?;
        Ok(std::array::from_fn(|i| run.q()[i]))
    };
    let form = |u: [f64; 8], v: [f64; 8]| -> f64 {
        (0..4).map(|j| vortices.gamma[j] * (u[j] * v[j + 4] - u[j + 4] * v[j])).sum()
    };
    let mut orbit = Integrator::new(vortices, method, H, *start)?;
    let mut defect = 0.0f64;
    for _ in 0..LOOKS {
        let q: [f64; 8] = std::array::from_fn(|i| orbit.q()[i]);
        let mut columns = [[0.0; 8]; 8];
        for (a, column) in columns.iter_mut().enumerate() {
            for (shift, weight) in [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)] {
                let mut displaced = q;
                displaced[a] += shift * DISPLACEMENT;
                let end = stepped(displaced)?;
                (0..8).for_each(|i| column[i] += weight * end[i] / (12.0 * DISPLACEMENT));
            }
        }
        let unit = |a: usize| std::array::from_fn(|i| if i == a { 1.0 } else { 0.0 });
        for a in 0..8 {
            for b in 0..8 {
                defect = larger(defect, (form(columns[a], columns[b]) - form(unit(a), unit(b))).abs());
            }
        }
        orbit.take_steps(STEPS / LOOKS)?;
    }
    Ok(defect)
}

fn points(q: [f64; 8]) -> FourPoints {
    FourPoints { x: std::array::from_fn(|i| q[i]), y: std::array::from_fn(|i| q[i + 4]) }
}

fn variational(job: &Job<'_>, case: &Case, scheme: &'static str, method: Sigma) -> Result<Drifts> {
    let Case { vortices, start } = case;
    let drifts = conserved(job, case, scheme, method)?;
    let mut run = Integrator::new(vortices, method, H, *start)?;
    let initial = run.discrete_momentum(ANGULAR)?.unwrap_or(f64::NAN);
    let mut map = TwoPointTangentMap::new(vortices, &method);
    let (mut discrete, mut two_form) = (0.0f64, 0.0f64);
    let (mut q0, mut q1) = (run.q().to_vec(), run.q().to_vec());
    for step in 0..STEPS {
        run.advance()?;
        if step > 0 {
            let t = run.time() - 2.0 * H;
            map.evaluate(vortices, Interval { t, h: H }, [&q0, &q1, run.q()])?;
            two_form = larger(two_form, map.two_form_defect(vortices));
        }
        q0.copy_from_slice(&q1);
        q1.copy_from_slice(run.q());
        let now = run.discrete_momentum(ANGULAR)?.unwrap_or(f64::NAN);
        discrete = larger(discrete, (now - initial).abs());
    }
    Ok(Drifts { discrete: Some(discrete), two_form: Some(two_form), ..drifts })
}

fn claims(all: &[Drifts; 7]) -> Vec<Claim> {
    let [vi2, started, quarter, ve2, rk2, rk4, gauss] = all;
    let variational = &all[..4];
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, larger);
    let linear = largest(&mut all.iter().flat_map(|drifts| [drifts.momenta[0], drifts.momenta[1]]));
    let discrete = largest(&mut all.iter().filter_map(|drifts| drifts.discrete));
    let two_form = largest(&mut variational.iter().filter_map(|drifts| drifts.two_form));
    let angular = |drifts: &Drifts| drifts.momenta[ANGULAR];
    vec![
        Claim::new("eq. 17", "the two-form (17) is exactly preserved").check(
            "largest change under the tangent map of a step, σ = 0, ¼, ½",
            two_form,
            Bound::AtMost(1e-12),
        ),
        Claim::new("section 6", "the schemes are momentum preserving")
            .check("largest drift of ΣΓx and ΣΓy, all schemes", linear, Bound::AtMost(1e-12))
            .check(
                "largest drift of the discrete momentum J_d, σ = 0, ¼, ½",
                discrete,
                Bound::AtMost(1e-11),
            ),
        Claim::new(
            BEYOND,
            "the angular impulse ΣΓ|z|² itself is preserved by VI2, and by none of the others of the family",
        )
        .check("drift, VI2", angular(vi2), Bound::AtMost(1e-11))
        .check("drift, σ = ½ with RK2 start", angular(started), Bound::AtLeast(1e-9))
        .check("drift, σ = ¼", angular(quarter), Bound::AtLeast(1e-9))
        .check("drift, VE2", angular(ve2), Bound::AtLeast(1e-9)),
        Claim::new(BEYOND, "RK2 and RK4 break the two-form Ω, Gauss's method preserves Ω")
            .check("largest change of Ω in a step, RK2", rk2.two_form, Bound::AtLeast(1e-9))
            .check("RK4", rk4.two_form, Bound::AtLeast(1e-9))
            .check("Gauss, order 4", gauss.two_form, Bound::AtMost(1e-11)),
    ]
}

/// What the figure and the table show of each scheme.
struct Quantity {
    name: &'static str,
    colour: Colour,
    value: fn(&Drifts) -> Option<f64>,
}

#[rustfmt::skip]
const QUANTITIES: [Quantity; 5] = [
    Quantity { name: "ΣΓ*x*",                  colour: BLUE,       value: |drifts| Some(drifts.momenta[0]) },
    Quantity { name: "ΣΓ*y*",                  colour: GREEN,      value: |drifts| Some(drifts.momenta[1]) },
    Quantity { name: "ΣΓ|*z*|²",               colour: VERMILLION, value: |drifts| Some(drifts.momenta[2]) },
    Quantity { name: "discrete momentum",      colour: PURPLE,     value: |drifts| drifts.discrete },
    Quantity { name: "two-form, in a step", colour: AMBER,      value: |drifts| drifts.two_form },
];

fn figure(all: &[Drifts]) -> Figure {
    // Exact conservation has no place on a logarithmic axis.
    const SMALLEST: f64 = 1e-17;
    let names = all.iter().rev().map(|drifts| drifts.scheme.to_owned()).collect();
    let drift = Axis::logarithmic(
        "largest deviation from the initial value; of the two-form, largest change in a step",
    )
    .within(0.5 * SMALLEST, 10.0);
    let empty = Panel::new("Deviations over 1000 steps", drift, Axis::names("", names));
    let panel = QUANTITIES.iter().enumerate().fold(empty, |panel, (i, Quantity { name, colour, value })| {
        let lift = 0.3 - 0.15 * i as f64;
        let points =
            all.iter().rev().enumerate().filter_map(|(row, drifts)| {
                value(drifts).map(|drift| [drift.max(SMALLEST), row as f64 + lift])
            });
        panel.discs(points.collect(), *colour, Fill::Solid).labelled(*name)
    });
    Figure::new(
        "What is conserved, scheme by scheme: momenta, the discrete momentum, the two-form",
        format!("Four equal vortices, *h* = {H}; deviations below 10⁻¹¹ are rounding, or the finite differences of Ω"),
    )
    .row(500.0, vec![panel.legend_at(Corner::Beside)])
    .footer("Rowley & Marsden 2002, eq. 17 and section 6. Two-form: (17) for the σ-family, Ω = ΣΓ d*x* ∧ d*y* for one-step methods.")
}

fn table(all: &[Drifts]) -> Result<Table> {
    let mut table =
        Table::new(&["scheme", "sum_gamma_x", "sum_gamma_y", "sum_gamma_z2", "J_d", "two_form"])?;
    for drifts in all {
        let numbers = QUANTITIES.map(|Quantity { value, .. }| value(drifts).map_or(String::new(), number));
        table.row([drifts.scheme.to_owned()].into_iter().chain(numbers))?;
    }
    Ok(table)
}
