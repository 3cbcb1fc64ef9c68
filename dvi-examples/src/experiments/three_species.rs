//! Three species that eat each other in a circle: an odd number of coordinates, and two invariants.
//!
//! x' = x(y − z), y' = y(z − x), z' = z(x − y) keeps x + y + z and xyz. It is a Poisson system of rank two
//! and has no one-form in x, y and z. In w = ln xyz, which commutes with everything, and a coordinate s
//! conjugate to it, it has one, in the class of one-step schemes; s' = z then says that s counts the third
//! species.

use crate::vocabulary::*;

/// x, y and z at the start; the paths in the figure begin at others too.
const START: Species = [0.3, 0.7, 2.0];
const OTHERS: [Species; 3] = [[0.1, 0.9, 2.0], [0.6, 0.9, 1.5], [0.85, 1.0, 1.15]];
const H: f64 = 0.1;
const EARLY: u64 = 2000;

type Species = [f64; 3];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    // Relative changes of x + y + z and of xyz.
    let (span, [sum, product], mut species) = (Span::of(steps, H, EARLY), invariants(&START), START);
    let all = [
        job.series(("one step, midpoint", solid(BLUE)), &mut run_from(START)?, span, |run, _| {
            [run.energy() / sum - 1.0, (run.q()[3] - product.ln()).exp_m1()]
        })
        .whole()?,
        job.watch(("RK4", solid(VERMILLION)), span, (H, 1), || {
            species = rk4(&species, H, rates);
            let [now, of_all] = invariants(&species);
            anyhow::Ok([now / sum - 1.0, of_all / product - 1.0])
        })?,
    ];
    let table = range_table("method,invariant,t", &["x + y + z", "xyz"], &all);
    job.publish(figure(&all, span.end)?, table)?;
    let text = "one step keeps xyz to rounding errors, and its error of x + y + z is no larger in the \
                whole run than in its beginning; RK4 keeps the sum, which is linear, and loses the product";
    let [[one_sum, one_product], [rk4_sum, rk4_product]] = all.each_ref().map(|series| &series.kept);
    let growth = |of: &str| format!("{of} over all / over {EARLY} steps");
    claims([
        beyond(text)
            .at_most("one step: largest relative change of xyz", one_product.largest, 1e-10)
            .at_most(growth("one step: max|Δ(x + y + z)|"), one_sum.growth(), 1.001)
            .at_most("RK4: largest relative change of x + y + z", rk4_sum.largest, 1e-10)
            .at_least(growth("RK4: max|Δ(xyz)|"), rk4_product.growth(), 5.0),
        same_motion()?,
        means()?,
    ])
}

fn invariants(species: &Species) -> [f64; 2] {
    [species.iter().sum(), species.iter().product()]
}

fn begin([x, y, z]: Species) -> Problem<'static, ThreeSpecies> {
    let [_, product] = invariants(&[x, y, z]);
    Problem::new(&ThreeSpecies {}, ThreeSpeciesState { x, s: 0.0, y, w: product.ln() })
}

fn run_from(start: Species) -> Result<Integrator<&'static ThreeSpecies, OneStep>> {
    begin(start).run(OneStep::midpoint(), H)
}

fn orbit(start: Species, steps: u64) -> Result<Vec<Species>> {
    let species = |ThreeSpeciesState { x, y, w, .. }: ThreeSpeciesState| [x, y, w.exp() / (x * y)];
    Ok(course(&mut run_from(start)?, steps, |run| species(run.state()))?)
}

fn rates(&[x, y, z]: &Species) -> Species {
    [x * (y - z), y * (z - x), z * (x - y)]
}

/// Against x and y with xyz as a parameter, and against RK4 on x, y and z with small steps.
fn same_motion() -> Result<Claim> {
    const END: f64 = 20.0;
    let ([_, product], [x, y, _]) = (invariants(&START), START);
    let reduced = ThreeSpeciesReduced { product };
    let mut run = Problem::new(&reduced, ThreeSpeciesReducedState { x, y }).run(OneStep::midpoint(), H)?;
    let pairs = orbit(START, 1000)?.into_iter().zip(course(&mut run, 1000, place)?);
    let difference = largest(pairs.map(|([x, y, _], [u, v])| larger((u - x).abs(), (v - y).abs())));
    let exact = rk4_to(START, END, END / 20_000.0, rates);
    let error = |q: &[f64]| apart(&[q[0], q[2], q[3].exp() / (q[0] * q[2])], &exact);
    let order = begin(START).errors(END, &[400, 600, 800], error).order(OneStep::midpoint())?;
    Ok(beyond("with w and s, or with xyz as a parameter, the motion is that of the three species")
        .at_most("largest difference of the two in 1000 steps", difference, 1e-11)
        .near("order of the difference from x, y, z at t = 20", order, [2.0, 0.05]))
}

/// (ln x)' = y − z, and so on around the circle: over a closed orbit the means of all species are the same.
fn means() -> Result<Claim> {
    const STEPS: u64 = 20_000;
    let (mut run, mut total) = (run_from(START)?, 0.0);
    for _ in 0..STEPS {
        let before = run.q()[0];
        run.advance()?;
        total += 0.5 * (before + run.q()[0]);
    }
    let means = [total / STEPS as f64, run.q()[1] / (STEPS as f64 * H)];
    let claim = beyond("s counts the third species, whose mean is that of the first");
    Ok(claim.near("s/t over the mean of x, at t = 2000", means[1] / means[0], [1.0, 3e-3]))
}

fn figure(all: &[Series<2>; 2], end: f64) -> Result<Figure> {
    let orbits = each([START, OTHERS[0], OTHERS[1], OTHERS[2]], |start| orbit(start, 300))?;
    // The plane x + y + z = 3, with the corners at which one species is left.
    let flat = |[x, y, z]: Species| [(y - x) / 2.0f64.sqrt(), (2.0 * z - x - y) / 6.0f64.sqrt()];
    let corners = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]].map(flat);
    let [x, y] = [("(*y* − *x*) / √2", [-2.3, 2.3]), ("(2*z* − *x* − *y*) / √6", [-1.5, 2.7])];
    let plane = Panel::window("Paths in the plane *x* + *y* + *z* = 3", x, y)
        .line(closed(&corners), solid(AMBER).width(1.2))
        .each(orbits.iter().zip([0, 2, 4, 6]), |plane, (path, colour)| {
            plane.line(path.iter().copied().map(flat).collect(), solid(SEQUENCE[colour]).width(1.4))
        });
    let over_time = |i: usize| orbits[0].iter().zip(0..).map(move |(of, k)| [f64::from(k) * H, of[i]]);
    let species = Panel::linear("Species", ("time *t*", [0.0, 20.0]), ("number", [0.0, 3.0])).lines([
        ("*x*", solid(BLUE), over_time(0).collect()),
        ("*y*", solid(GREEN), over_time(1).collect()),
        ("*z*", solid(VERMILLION), over_time(2).collect()),
    ]);
    let [one_step, rk4] = all.each_ref().map(|series| series.kept.each_ref().map(Envelope::magnitude));
    let ([one_sum, _], [rk4_sum, rk4_product]) = (one_step, rk4);
    let axis = ("largest relative error", [1e-16, 10.0]);
    let errors = Panel::semilog("Errors of the invariants", ("time *t*", [0.0, end]), axis).lines([
        ("one step: *x* + *y* + *z*", solid(BLUE), one_sum),
        ("RK4: *x* + *y* + *z*", solid(VERMILLION), rk4_sum),
        ("RK4: *xyz*", dashed(VERMILLION), rk4_product),
    ]);
    Ok(Figure::of(format!("*x*′ = *x*(*y* − *z*), *y*′ = *y*(*z* − *x*), *z*′ = *z*(*x* − *y*); *h* = {H}"))
        .row(430.0, vec![plane, species.weight(1.2)])
        .row(300.0, vec![errors.legend_at(Corner::Beside)]))
}
