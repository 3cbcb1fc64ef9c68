//! Rowley & Marsden 2002, Fig. 4: Poincaré sections of a quasi-periodic motion, 0 ≤ t ≤ 10⁵.
//!
//! The exact section is a closed curve. Each run is compared with that curve, computed by Gauss
//! collocation of order six.

use crate::claim::larger;
use anyhow::Result;

use super::sections::{
    self, CAVEAT, Crossings, LYAPUNOV_STEPS, Scheme, compare, cost, energy_panel, lyapunov_exponent,
};
use crate::claim::{Bound, Check, Claim};
use crate::figure::{Axis, Corner, Figure, Panel, SLATE, Stroke, scientific};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models;

pub const EXPERIMENT: Experiment = Experiment {
    name: "fig4-quasi-periodic",
    title: "Poincaré sections of a quasi-periodic motion",
    share: 25.0,
    run,
};

const RUNS: [(Scheme, f64); 6] = [
    (Scheme::Vi2, 0.1),
    (Scheme::Vi2, 0.2),
    (Scheme::Vi2, 0.5),
    (Scheme::Rk4, 0.1),
    (Scheme::Rk4, 0.2),
    (Scheme::Rk4, 0.5),
];

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e5, 4.5e4);
    let exact = [(Scheme::Gauss6, 0.2)];
    job.expect(cost(&RUNS, end) + cost(&exact, 1e5) + LYAPUNOV_STEPS);
    let case = models::quasi_periodic();
    let all = compare(job, &case, &RUNS, end)?;
    let exact = compare(job, &case, &exact, 1e5)?;
    let curve = Curve::through(&exact[0].places());
    let exponent = lyapunov_exponent(job, &case)?;
    job.publish(EXPERIMENT.name, figure(&all, &curve, end), sections::table(&all)?)?;
    let references = references(job, &all, left(&all, &curve));
    Ok(Outcome { claims: claims(&all, &curve, exponent), references, notes: sections::notes(&all) })
}

fn claims(all: &[Crossings], curve: &Curve, exponent: Option<f64>) -> Vec<Claim> {
    let [vi_small, vi_middle, vi_large, rk_small, rk_middle, _] = all else { return Vec::new() };
    let distance = |run: &Crossings| curve.largest_distance(run);
    let far = |run: &Crossings| format!("largest distance from the exact section, {}", run.name());
    let growth = |run: &Crossings| format!("max|ΔH| over all / over the first tenth, {}", run.name());
    vec![
        Claim::new("section 5", "the motion is quasi-periodic").check(
            "largest Lyapunov exponent up to t = 2·10⁴",
            exponent,
            Bound::AtMost(1e-3),
        ),
        Claim::new("Fig. 4", "both schemes give qualitatively correct results for h = 0.1")
            .check(far(vi_small), distance(vi_small), Bound::AtMost(0.01))
            .check(far(rk_small), distance(rk_small), Bound::AtMost(0.01)),
        Claim::new("Fig. 4", "RK4 gives spurious results for h = 0.2, VI2 does not")
            .check(far(rk_middle), distance(rk_middle), Bound::AtLeast(0.5))
            .check(far(vi_middle), distance(vi_middle), Bound::AtMost(0.01))
            .check(far(vi_large), distance(vi_large), Bound::AtMost(0.01)),
        Claim::new(
            "section 5",
            "with VI2 the Hamiltonian stays close to its original value, with RK4 it drifts",
        )
        .check(growth(vi_small), vi_small.error.growth(), Bound::AtMost(1.1))
        .check(growth(vi_middle), vi_middle.error.growth(), Bound::AtMost(1.1))
        .check(growth(vi_large), vi_large.error.growth(), Bound::AtMost(1.1))
        .check(growth(rk_small), rk_small.error.growth(), Bound::AtLeast(5.0)),
    ]
}

/// Numbers of independent programs.
fn references(job: &Job<'_>, all: &[Crossings], left: Option<f64>) -> Vec<Check> {
    let [vi_small, vi_middle, vi_large, rk_small, ..] = all else { return Vec::new() };
    let error = |run: &Crossings| format!("max|ΔH|, {}", run.name());
    vec![
        Check::new(error(vi_small), vi_small.error.largest, Bound::Near(3.847e-5, 5e-8)),
        Check::new(error(vi_middle), vi_middle.error.largest, Bound::Near(1.546e-4, 1e-7)),
        Check::new(error(vi_large), vi_large.error.largest, Bound::Near(1.002e-3, 1e-6)),
        Check::new(
            "ΔH at the end, RK4 at h = 0.1",
            job.only_full(rk_small.error.last),
            Bound::Near(6.518e-4, 1e-6),
        ),
        Check::new("RK4 at h = 0.2 leaves the torus at t", left, Bound::Within(4e4, 4.6e4)),
    ]
}

/// When RK4 at h = 0.2 leaves the torus.
fn left(all: &[Crossings], curve: &Curve) -> Option<f64> {
    let points = &all.get(4)?.points;
    points.iter().find(|&&[_, r1, p1]| curve.distance([r1, p1]) > 0.1).map(|point| point[0])
}

fn figure(all: &[Crossings], curve: &Curve, end: f64) -> Figure {
    let (schemes_vi, schemes_rk) = all.split_at(3);
    let row = |runs: &[Crossings]| runs.iter().map(|run| panel(run, curve)).collect();
    Figure::new(
        "Quasi-periodic motion of four equal vortices: Poincaré sections of VI2 and RK4",
        "*R*₂ = 0, d*R*₂/d*t* > 0; grey line: the exact section; *d*: the largest distance from it",
    )
    .sequence_key("colour: *t* = 0", format!("*t* = {}", scientific(end)))
    .row(370.0, row(schemes_vi))
    .row(370.0, row(schemes_rk))
    .row(330.0, vec![energy_panel(all, end)])
    .footer(format!("After Rowley & Marsden 2002, Fig. 4. {CAVEAT}"))
}

/// Close up where the run stays near the exact curve; else all of it, and a frame around the close-up.
fn panel(run: &Crossings, curve: &Curve) -> Panel {
    let [[left, right], [low, high]] = curve.frame();
    let caption = format!("*d* = {}", scientific(curve.largest_distance(run)));
    let exact = curve.closed();
    let inside = |[r1, p1]: [f64; 2]| (left..=right).contains(&r1) && (low..=high).contains(&p1);
    if run.places().into_iter().all(inside) {
        let (r1, p1) = (Axis::linear("*R*₁").within(left, right), Axis::linear("*P*₁").within(low, high));
        let panel = run.panel(r1, p1, 1.0).below(exact, Stroke::solid(SLATE).width(5.0).opacity(0.25));
        return panel.caption(Corner::TopRight, caption);
    }
    let frame = vec![[left, low], [right, low], [right, high], [left, high], [left, low]];
    // Wide enough for words beside the dots, which stay within 2.4.
    run.panel(Axis::linear("*R*₁").within(-2.6, 2.6), Axis::linear("*P*₁").within(-2.6, 3.4), 1.0)
        .below(exact, Stroke::solid(SLATE).width(3.0).opacity(0.35))
        .line(frame, Stroke::solid(SLATE).width(1.0))
        .caption(Corner::TopLeft, "frame: the close-up above")
        .caption(Corner::TopRight, caption)
}

/// A closed curve around its centre, as a polygon sorted by angle.
struct Curve {
    corners: Vec<[f64; 2]>,
}

impl Curve {
    fn through(points: &[[f64; 2]]) -> Self {
        let count = points.len() as f64;
        let centre = [0, 1].map(|i| points.iter().map(|point| point[i]).sum::<f64>() / count);
        let angle = |point: &[f64; 2]| (point[1] - centre[1]).atan2(point[0] - centre[0]);
        let mut corners = points.to_vec();
        corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        Self { corners }
    }

    /// The curve as a line that ends where it begins.
    fn closed(&self) -> Vec<[f64; 2]> {
        self.corners.iter().chain(self.corners.first()).copied().collect()
    }

    /// The ranges of both coordinates with a margin.
    fn frame(&self) -> [[f64; 2]; 2] {
        if self.corners.is_empty() {
            return [[-2.6, 2.6]; 2];
        }
        [0, 1].map(|i| {
            let values = self.corners.iter().map(|corner| corner[i]);
            let (low, high) =
                values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), larger(high, v)));
            let margin = 0.18 * (high - low);
            [low - margin, high + margin]
        })
    }

    fn distance(&self, point: [f64; 2]) -> f64 {
        let closed = self.corners.iter().zip(self.corners.iter().cycle().skip(1));
        closed.map(|(&a, &b)| distance_to_segment(point, a, b)).fold(f64::INFINITY, f64::min)
    }

    fn largest_distance(&self, run: &Crossings) -> f64 {
        run.places().into_iter().map(|place| self.distance(place)).fold(0.0, larger)
    }
}

fn distance_to_segment(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let to = [point[0] - a[0], point[1] - a[1]];
    let length = (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
    let share = ((to[0] * along[0] + to[1] * along[1]) / length).clamp(0.0, 1.0);
    (to[0] - share * along[0]).hypot(to[1] - share * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_from_a_curve_given_in_any_order() {
        let square = Curve::through(&[[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]]);
        assert_eq!(square.distance([0.0, 3.0]), 2.0);
        assert_eq!(square.distance([0.0, 0.5]), 0.5);
        assert_eq!(square.distance([4.0, 5.0]), 5.0);
    }
}
