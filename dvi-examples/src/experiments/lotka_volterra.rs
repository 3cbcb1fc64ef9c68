//! Predators and prey: one-step schemes where the two-step scheme fails.
//!
//! The one-form is not affine. With a component along one coordinate only it is in the class of one-step
//! schemes; in the symmetric form of the same motion it is not, and the two-step midpoint scheme loses it to
//! its parasitic mode.

use crate::vocabulary::*;

const ONE_SIDED: OneSidedPredators = OneSidedPredators {};
const SYMMETRIC: Predators = Predators { share: 1.0, shift: 0.0 };
const START: (f64, f64) = (2.0, 1.0);
const H: f64 = 0.1;
const EARLY: u64 = 1000;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    let (one_sided, symmetric) = (Problem::new(&ONE_SIDED, START), Problem::new(&SYMMETRIC, START));
    let [span, short] = [steps, EARLY].map(|steps| Span::of(steps, H, EARLY));
    let (halved, places) = (Span::of(2 * steps, H / 2.0, EARLY), EARLY as usize + 1);
    let [midpoint, gauss] = [("one step, midpoint", BLUE), ("one step, Gauss of order 4", GREEN)]
        .map(|(name, colour)| (name, solid(colour)));
    let two_steps = ("two steps, σ = ½", solid(VERMILLION));
    let two_step = job.energy(two_steps, symmetric.run(unwatched(Sigma::midpoint()), H)?, short, places);
    let runs = [
        (midpoint, one_sided.any(OneStep::midpoint(), H)?),
        (gauss, one_sided.any(OneStepGauss::<2>::new(), H)?),
        (("RK4", dashed(SLATE)), one_sided.any(RungeKutta::classical(), H)?),
    ];
    let [one, other, rk4] = each(runs, |(named, run)| job.energy(named, run, span, places).whole())?;
    let all = [one, other, rk4, two_step];
    let half = job.energy(midpoint, one_sided.run(OneStep::midpoint(), H / 2.0)?, halved, 0).whole()?;
    let watched = job.energy(two_steps, symmetric.run(Sigma::midpoint(), H)?, short, 0);
    // The steps that failed.
    let ended = |run: &Series<1>| run.ended.map_or(f64::INFINITY, |error| error.step as f64);
    let (ended, watched) = (ended(&all[3]), ended(&watched));
    job.publish(figure(&all, ended, span.end), range_table("method,t", &[""], &all))?;
    let near = |h: f64, run: &Series<1>, bound| {
        Check::new(format!("one step, midpoint, h = {h}: max|ΔH|"), run.kept[0].largest, bound)
    };
    let references =
        vec![near(H, &all[0], Bound::Near(1.04e-2, 5e-5)), near(H / 2.0, &half, Bound::Near(2.56e-3, 5e-6))];
    let [of_midpoint, of_gauss, of_rk4, _] = all.each_ref().map(|series| series.kept[0].growth());
    let fails =
        "the two-step midpoint fails in the symmetric one-form, and its parasitic mode is seen before";
    let (between, apart) = ("steps between the error of the parasitic mode and that", ended - watched);
    let claims = vec![
        beyond("the energy error of one-step schemes is no larger in the whole run than in its beginning")
            .at_most("midpoint: max|ΔH| over all / over 1000 steps", of_midpoint, 1.001)
            .at_most("Gauss of order 4: max|ΔH| over all / over 1000 steps", of_gauss, 1.001)
            .at_least("RK4: max|ΔH| over all / over 1000 steps", of_rk4, 5.0),
        beyond(fails).at_most("steps until no step is found", ended, 118.0).at_least(between, apart, 1.0),
        gauges()?,
    ];
    Ok(Outcome { claims, references, notes: vec![] })
}

/// Four one-forms that differ by gauges.
fn gauges() -> Result<Claim> {
    let others = [SYMMETRIC, Predators { share: 0.0, shift: 1.0 }, Predators { shift: 1.0, ..SYMMETRIC }];
    let places = || (0..25).map(|k| [0.3 + 0.7 * f64::from(k / 5), 0.2 + 0.6 * f64::from(k % 5)]);
    let apart = others.iter().flat_map(|other| {
        places().map(move |place| (omega(other, place) / omega(&ONE_SIDED, place) - 1.0).abs())
    });
    let [coarse, fine] = each([H, H / 2.0], |h| {
        let ([b, c, d], a) = (each(others.each_ref(), |system| end(system, h))?, end(&ONE_SIDED, h)?);
        Ok(largest([a, b, c, d].iter().flat_map(|&one| [a, b, c, d].map(|other| distance(one, other)))))
    })?;
    Ok(beyond("four gauges have one Ω, and their runs differ by the second order of the scheme")
        .at_most("largest relative difference of Ω", largest(apart), 1e-14)
        .near("projected, spread at t = 10: h = 0.1 over h = 0.05", coarse / fine, [4.0, 0.4]))
}

/// Where a projected run is at t = 10.
fn end<S: DegenerateLagrangian<State<f64>: From<(f64, f64)>>>(system: &S, h: f64) -> Result<[f64; 2]> {
    let mut run = Problem::new(system, START).run(Projected::symmetric(), h)?;
    run.take_steps((10.0 / h).round() as u64)?;
    Ok(place(&run))
}

fn figure(all: &[Series<1>; 4], ended: f64, end: f64) -> Figure {
    let [one_step, .., two_step] = all;
    let paths = Panel::window("Path", ("*x*", [0.0, 4.5]), ("*y*", [0.0, 4.5])).lines([
        (&one_step.name, solid(BLUE).width(2.5), one_step.path.clone()),
        (&two_step.name, solid(VERMILLION).width(1.0), two_step.path.clone()),
    ]);
    let labels = ["Error of the energy", "largest |*H* − *H*(0)| of each interval"];
    let energy = over_time(labels, end, [1e-6, 1.0], &all[..3], 0);
    Figure::of(format!(
        "From (2, 1), *h* = {H}; two steps with the symmetric one-form end after {ended} of them"
    ))
    .row(470.0, vec![paths, energy.weight(1.35).legend_at(Corner::BottomRight)])
}
