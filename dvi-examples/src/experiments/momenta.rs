//! Which scheme conserves what: the linear impulses ΣΓx and ΣΓy, the angular impulse ΣΓ|z|², its discrete
//! counterpart J_d = D₂L_d·ξ, and the discrete two-form (Rowley & Marsden 2002, eq. 17 and section 6).

use crate::vocabulary::*;

const H: f64 = 0.1;
const STEPS: u64 = 1000;
/// The index of ΣΓ|z|² among the declared momenta.
const ANGULAR: usize = 2;

/// The largest deviations of one scheme from the initial values: ΣΓx, ΣΓy, ΣΓ|z|², J_d of the variational
/// schemes, and the largest change of the two-form under the tangent map of a step: of the discrete one
/// (17), of one-step methods Ω.
type Drifts = (&'static str, [Option<f64>; 5]);

const QUANTITIES: [(&str, Colour); 5] = [
    ("ΣΓ*x*", BLUE),
    ("ΣΓ*y*", GREEN),
    ("ΣΓ|*z*|²", VERMILLION),
    ("discrete momentum", PURPLE),
    ("two-form, in a step", AMBER),
];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let case = models::quasi_periodic();
    // What VE2 preserves, it preserves whatever becomes of its parasitic mode.
    let ve2 = unwatched(begun_by_rk2(0.0));
    let all = [
        drifts(&case, "VI2 (σ = ½)", Sigma::midpoint(), two_step)?,
        drifts(&case, "σ = ½, RK2 start", begun_by_rk2(0.5), two_step)?,
        drifts(&case, "σ = ¼", begun_by_rk2(0.25), two_step)?,
        drifts(&case, "VE2 (σ = 0)", ve2, two_step)?,
        drifts(&case, "RK2", RungeKutta::midpoint(), one_step)?,
        drifts(&case, "RK4", RungeKutta::classical(), one_step)?,
        drifts(&case, "Gauss, order 4", Gauss::<2>::new(), one_step)?,
    ];
    let columns = "scheme,sum_gamma_x,sum_gamma_y,sum_gamma_z2,J_d,two_form";
    job.publish(figure(&all), Table::of(columns, all.iter().map(|(scheme, of)| ([*scheme], *of))))?;
    let [vi2, started, quarter, ve2, rk2, rk4, gauss] = &all;
    let most = |all: &[Drifts], quantity: usize| largest(all.iter().filter_map(|(_, of)| of[quantity]));
    let [angular, two_form] = [ANGULAR, 4].map(|quantity| move |(_, of): &Drifts| of[quantity]);
    let impulses = larger(most(&all, 0), most(&all, 1));
    let change = "largest change under the tangent map of a step, σ = 0, ¼, ½";
    let text =
        "the angular impulse ΣΓ|z|² itself is preserved by VI2, and by none of the others of the family";
    claims([
        says("eq. 17", "the two-form (17) is exactly preserved").at_most(change, most(&all[..4], 4), 1e-12),
        says("section 6", "the schemes are momentum preserving")
            .at_most("largest drift of ΣΓx and ΣΓy, all schemes", impulses, 1e-12)
            .at_most("largest drift of the discrete momentum J_d, σ = 0, ¼, ½", most(&all, 3), 1e-11),
        beyond(text)
            .at_most("drift, VI2", angular(vi2), 1e-11)
            .at_least("drift, σ = ½ with RK2 start", angular(started), 1e-9)
            .at_least("drift, σ = ¼", angular(quarter), 1e-9)
            .at_least("drift, VE2", angular(ve2), 1e-9),
        beyond("RK2 and RK4 break the two-form Ω, Gauss's method preserves Ω")
            .at_least("largest change of Ω in a step, RK2", two_form(rk2), 1e-9)
            .at_least("RK4", two_form(rk4), 1e-9)
            .at_most("Gauss, order 4", two_form(gauss), 1e-11),
    ])
}

/// The deviations of the momenta, and what `more` finds: of J_d, and of the two-form.
fn drifts<M: Method<FourVortices, f64> + Copy>(
    case: &Case,
    scheme: &'static str,
    method: M,
    more: fn(&Case, M) -> Result<[Option<f64>; 2]>,
) -> Result<Drifts> {
    let mut run = Problem::new(&case.vortices, case.start).run(method, H)?;
    let all = course(&mut run, STEPS, momenta::<3>)?;
    let largest = |k: usize| largest(all.iter().map(|momenta| (momenta[k] - all[0][k]).abs()));
    let ([x, y, angular], [discrete, two_form]) = ([0, 1, 2].map(|k| Some(largest(k))), more(case, method)?);
    Ok((scheme, [x, y, angular, discrete, two_form]))
}

/// The largest change of the two-form Ω = ΣΓ dx ∧ dy under the tangent map, by differences of fourth order.
fn one_step<M: Method<FourVortices, f64> + Copy>(case: &Case, method: M) -> Result<[Option<f64>; 2]> {
    let Case { vortices, start } = case;
    const DISPLACEMENT: f64 = 1e-3;
    let flat = |run: &[f64]| -> [f64; 8] { std::array::from_fn(|i| run[i]) };
    let stepped = |q: [f64; 8]| -> Result<[f64; 8]> {
        let mut run = Integrator::new(vortices, method, H, vortices.state_of(q))?;
        run.advance()?;
        Ok(flat(run.q()))
    };
    let form = |u: [f64; 8], v: [f64; 8]| -> f64 {
        (0..4).map(|j| vortices.gamma[j] * (u[j] * v[j + 4] - u[j + 4] * v[j])).sum()
    };
    let mut orbit = Integrator::new(vortices, method, H, *start)?;
    let mut defect = 0.0f64;
    for _ in 0..10 {
        let mut columns = [[0.0; 8]; 8];
        for (a, column) in columns.iter_mut().enumerate() {
            for (shift, weight) in [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)] {
                let mut displaced = flat(orbit.q());
                displaced[a] += shift * DISPLACEMENT;
                let end = stepped(displaced)?;
                (0..8).for_each(|i| column[i] += weight * end[i] / (12.0 * DISPLACEMENT));
            }
        }
        let unit = |a: usize| std::array::from_fn(|i| if i == a { 1.0 } else { 0.0 });
        for (a, b) in (0..8).flat_map(|a| (0..8).map(move |b| (a, b))) {
            defect = larger(defect, (form(columns[a], columns[b]) - form(unit(a), unit(b))).abs());
        }
        orbit.take_steps(STEPS / 10)?;
    }
    Ok([None, Some(defect)])
}

/// The largest change of J_d, and of the two-form (17).
fn two_step(Case { vortices, start }: &Case, method: Sigma) -> Result<[Option<f64>; 2]> {
    let mut run = Integrator::new(vortices, method, H, *start)?;
    let momentum = |run: &Integrator<_, _>| anyhow::Ok(run.discrete_momentum(ANGULAR)?.unwrap_or(f64::NAN));
    let initial = momentum(&run)?;
    let [mut before, mut map] = [(); 2].map(|()| TangentMap::new(vortices, &method));
    let (mut discrete, mut two_form) = (0.0f64, 0.0f64);
    for step in 0..STEPS {
        let (interval, from) = (Interval { t: run.time(), h: H }, run.q().to_vec());
        run.advance()?;
        map.evaluate(vortices, interval, &from, run.q())?;
        if step > 0 {
            two_form = larger(two_form, map.two_form_defect(&before, vortices));
        }
        (before, map) = (map, before);
        discrete = larger(discrete, (momentum(&run)? - initial).abs());
    }
    Ok([Some(discrete), Some(two_form)])
}

fn figure(all: &[Drifts]) -> Figure {
    // Exact conservation has no place on a logarithmic axis.
    const SMALLEST: f64 = 1e-17;
    let names = all.iter().rev().map(|(scheme, _)| (*scheme).to_owned()).collect();
    let label = "largest deviation from the initial value; of the two-form, largest change in a step";
    let drift = Axis::logarithmic(label).within([0.5 * SMALLEST, 10.0]);
    let empty = Panel::new("Deviations over 1000 steps", drift, Axis::names("", names));
    let panel = empty.each(QUANTITIES.into_iter().enumerate(), |panel, (i, (name, colour))| {
        let lift = 0.3 - 0.15 * i as f64;
        let rows = all.iter().rev().enumerate();
        let points = rows.filter_map(|(row, (_, of))| Some([of[i]?.max(SMALLEST), row as f64 + lift]));
        panel.discs(points.collect(), colour).labelled(name)
    });
    Figure::of(format!("Four equal vortices, *h* = {H}; below 10⁻¹¹: rounding, or finite differences"))
        .row(500.0, vec![panel.legend_at(Corner::Beside)])
        .footer("Rowley & Marsden 2002. Two-form: (17) of the σ-family, ΣΓ d*x* ∧ d*y* of one-step methods.")
}
