//! Rowley & Marsden 2002, Fig. 5: Poincaré sections of a chaotic motion, 0 ≤ t ≤ 10⁶.
//!
//! Orbits fill a region with sharp borders. A run is *blurred* to the extent that its crossings lie
//! outside of the region that accurate orbits of the same energy fill.

use std::collections::HashMap;

use super::crossings::{self, Scheme, *};
use super::sections::{self, CAVEAT};
use crate::vocabulary::*;

const RUNS: [(Scheme, f64); 6] = crossings::runs([0.2, 0.5, 1.0]);

/// Displacements grow less than this in 2000 units of time on tori, and to 1e10 on chaotic orbits.
const REGULAR: f64 = 1e5;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e6, 1e5);
    let (exact, accurate) = ([(Scheme::Gauss6, 0.4)], job.choose(1e6, 4e5));
    job.expect(cost(&RUNS, end) + cost(&exact, accurate) + LYAPUNOV_STEPS);
    let motion = Motion { job, case: &models::chaotic(), end };
    let all = each(motion.compare(RUNS)?, |run| to_the_end(motion, run))?;
    let [exact] = Motion { end: accurate, ..motion }.compare(exact)?;
    let region = Region::around(&exact.places());
    let exponent = motion.lyapunov_exponent()?;
    let titles = [
        "Chaotic motion of four equal vortices: Poincaré sections of VI2 and RK4",
        "*R*₂ = 0, d*R*₂/d*t* > 0; stray: the share of crossings outside of the region of accurate orbits",
    ];
    let figure = sections::figure(titles, &all, end, |run| panel(run, &region))
        .footer(format!("After Rowley & Marsden 2002, Fig. 5. {CAVEAT}"));
    job.publish(figure, sections::table(&all))?;
    // Brackets around what earlier runs have found.
    let error = |run: &Crossings, largest: Option<f64>, bound| {
        Check::new(format!("max|ΔH|, {}", run.name()), largest, bound)
    };
    let [_, vi_middle, vi_large, _, rk_middle, rk_large] = &all;
    let full = |run: &Crossings| job.only_full(run.error.largest);
    let references = vec![
        error(vi_middle, Some(vi_middle.error.largest), Bound::AtMost(4.3e-4)),
        error(vi_large, Some(vi_large.error.largest), Bound::AtMost(1.8e-3)),
        error(rk_middle, full(rk_middle), Bound::Within(0.03, 0.05)),
        error(rk_large, full(rk_large), Bound::Within(0.1, 0.2)),
    ];
    let mut notes = sections::notes(&all);
    let rounding = "Chaotic runs depend on rounding: which island a run visits, and when RK4 becomes \
                    regular, differ between machines, and so do the last digits above.";
    notes.push(rounding.to_owned());
    Ok(Outcome { claims: claims(job, &all, &region, exponent), references, notes })
}

/// A run that has become regular may never meet the section again; with the equal vortices in another
/// order in Q₁, Q₂, Q₃ it may.
fn to_the_end(motion: Motion<'_>, mut run: Crossings) -> Result<Crossings> {
    for labels in LABELS {
        if run.last() > 0.9 * run.end {
            break;
        }
        motion.job.expect(cost(&[(run.scheme, run.h)], run.end));
        let other = motion.crossings((run.scheme, run.h), labels)?;
        if other.last() > run.last() {
            run = other;
        }
    }
    Ok(run)
}

fn claims(job: &Job<'_>, all: &[Crossings; 6], region: &Region, exponent: Option<f64>) -> Vec<Claim> {
    let [vi_small, vi_middle, vi_large, rk_small, rk_middle, rk_large] = all;
    let outside = |run: &Crossings| region.share_outside(run);
    let share = |run: &Crossings| format!("share of crossings outside of the exact region, {}", run.name());
    let inside = |claim: Claim, run: &Crossings| claim.at_most(share(run), outside(run), 2e-3);
    let growth = |run: &Crossings| format!("late growth of a displacement, {}", run.name());
    let chaotic = "the motion is chaotic";
    let drift = rk_small.error.last / rk_small.error.largest;
    vec![
        says("section 5", chaotic).at_least("largest Lyapunov exponent up to t = 2·10⁴", exponent, 0.03),
        says("Fig. 5", "both schemes produce clear sections for h = 0.2").each([vi_small, rk_small], inside),
        says("Fig. 5", "for h = 0.5 the section of RK4 is blurred")
            .at_least(share(rk_middle), job.only_full(outside(rk_middle)), 8e-3)
            .at_least(rk_middle.growth_name(), rk_middle.error.growth(), 5.0),
        says("Fig. 5", "the section of VI2 remains crisp for h = 1").each([vi_middle, vi_large], inside),
        says("Fig. 5", "for h = 1 RK4 deviates completely and becomes quasi-periodic")
            .at_most(growth(rk_large), job.only_full(rk_large.growth), REGULAR)
            .at_least(growth(vi_large), vi_large.growth, 1e8),
        sections::stays_close(&all[..3]).at_least("ΔH at the end / max|ΔH|, RK4 at h = 0.2", drift, 0.98),
    ]
}

fn panel(run: &Crossings, region: &Region) -> Panel {
    let stray = || format!("{:.1} % stray", 100.0 * region.share_outside(run));
    let caption = if run.growth < REGULAR { "regular at the end".to_owned() } else { stray() };
    let panel = run.panel([-2.6, 2.6], [-2.6, 2.6], 0.7).caption(Corner::TopRight, caption);
    match run.relabelling() {
        Some(text) => panel.note([0.0, -2.53], Anchor::Middle, INK, text),
        None => panel,
    }
}

/// The region that an orbit fills: all places within a short distance of one of its crossings.
struct Region(HashMap<[i64; 2], Points>);

impl Region {
    const DISTANCE: f64 = 0.05;

    /// The section is its own mirror image in both axes: relabelling the vortices turns it by 180°, and
    /// complex conjugation with reversed time and order turns P₁ around. So each crossing counts four times.
    fn around(places: &[[f64; 2]]) -> Self {
        let mut cells: HashMap<_, Vec<_>> = HashMap::new();
        for place in places.iter().flat_map(|&[r1, p1]| [[r1, p1], [-r1, p1], [r1, -p1], [-r1, -p1]]) {
            cells.entry(Self::cell(place)).or_default().push(place);
        }
        Self(cells)
    }

    fn cell(place: [f64; 2]) -> [i64; 2] {
        place.map(|x| (x / Self::DISTANCE).floor() as i64)
    }

    fn contains(&self, place: [f64; 2]) -> bool {
        let [i, j] = Self::cell(place);
        let neighbours = (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| [i, j]));
        let close = |&other: &[f64; 2]| distance(other, place) <= Self::DISTANCE;
        neighbours.filter_map(|cell| self.0.get(&cell)).flatten().any(close)
    }

    fn share_outside(&self, run: &Crossings) -> f64 {
        let outside = run.places().into_iter().filter(|&place| !self.contains(place));
        outside.count() as f64 / run.points.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_reaches_as_far_as_its_distance_and_is_symmetric() {
        let region = Region::around(&[[1.0, 0.5]]);
        assert!(region.contains([1.04, 0.5]) && region.contains([-1.0, -0.54]));
        assert!(!region.contains([1.06, 0.5]) && !region.contains([0.0, 0.0]));
    }
}
