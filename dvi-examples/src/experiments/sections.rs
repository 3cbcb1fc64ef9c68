//! What Figs. 4 and 5 show of Poincaré sections, and what is said of them.

use super::crossings::{Crossings, LABELS, Scheme};
use crate::vocabulary::*;

pub const CAVEAT: &str = "*R*₁ + i*P*₁ = *Q*₂e^(−iφ), *R*₂ = Im *Q*₁e^(−iφ), φ = arg *Q*₃, *Q*ₙ = ½Σ*z*ₐ \
                          e^(−2πi*n*(*a*−1)/4); not necessarily the paper's axes.";

/// More crossings than these make files larger, and no clearer.
const SHOWN: usize = 15_000;

impl Crossings {
    pub fn name(&self) -> String {
        format!("{} at h = {}", self.scheme.name(), self.h)
    }

    pub fn growth_name(&self) -> String {
        format!("max|ΔH| over all / over the first tenth, {}", self.name())
    }

    fn title(&self) -> String {
        format!("{}, *h* = {}", self.scheme.name(), self.h)
    }

    /// Says so if the vortices are not in their given order.
    pub fn relabelling(&self) -> Option<String> {
        let [a, b, c, d] = self.labels.map(|j| j + 1);
        (self.labels != LABELS[0]).then(|| format!("*a* = 1, 2, 3, 4 are vortices {a}, {b}, {c}, {d}"))
    }

    pub fn panel(&self, r1: [f64; 2], p1: [f64; 2], radius: f64) -> Panel {
        let shown = thin(&self.points, SHOWN);
        let interval = |t: f64| (t / self.end * SEQUENCE.len() as f64) as usize;
        let colours = SEQUENCE.into_iter().enumerate();
        Panel::window(self.title(), ("*R*₁", r1), ("*P*₁", p1)).each(colours, |panel, (i, colour)| {
            let places = shown.iter().filter(|[t, ..]| interval(*t) == i).map(|&[_, r1, p1]| [r1, p1]);
            panel.dots(places.collect(), radius, colour)
        })
    }
}

/// What the paper says of the energy in both figures, with the checks for VI2.
pub fn stays_close(vi2: &[Crossings]) -> Claim {
    let text = "with VI2 the Hamiltonian stays close to its original value, with RK4 it drifts";
    says("section 5", text).each(vi2, |all, run| all.at_most(run.growth_name(), run.error.growth(), 1.1))
}

/// The sections of VI2, those of RK4, and |H − H(0)| of all runs over time.
pub fn figure(
    [title, subtitle]: [&str; 2],
    all: &[Crossings; 6],
    end: f64,
    panel: impl Fn(&Crossings) -> Panel,
) -> Figure {
    let time = Axis::linear("time *t*   [*L*²/Γ]").within([0.0, end]);
    let largest = "Largest error of the Hamiltonian in each interval of time";
    let lines = all.iter().zip([BLUE, GREEN, VERMILLION].into_iter().cycle()).map(|(run, colour)| {
        let stroke = if run.scheme == Scheme::Vi2 { solid(colour) } else { dashed(colour) };
        (run.title(), stroke, run.error.magnitude())
    });
    let energy = Panel::new(largest, time, Axis::logarithmic("|*H*(*t*) − *H*(0)|   [Γ²]")).lines(lines);
    Figure::of(subtitle)
        .titled(title)
        .sequence_key("colour: *t* = 0", format!("*t* = {}", scientific(end)))
        .row(370.0, all[..3].iter().map(&panel).collect())
        .row(370.0, all[3..].iter().map(&panel).collect())
        .row(330.0, vec![energy.legend_at(Corner::Beside)])
}

/// The section coordinates, and the runs that were relabelled or ended early.
pub fn notes(all: &[Crossings]) -> Vec<String> {
    let relabelled = all.iter().filter_map(|run| Some(format!("{}: {}.", run.name(), run.relabelling()?)));
    let relabelled = relabelled.map(|note| note.replace('*', ""));
    let ended = |run: &Crossings| run.failure.map(|error| format!("{} ended early: {error}.", run.name()));
    [CAVEAT.replace('*', "")].into_iter().chain(relabelled).chain(all.iter().filter_map(ended)).collect()
}

pub fn table(all: &[Crossings]) -> Result<Table> {
    let curves = all.iter().map(|run| ([run.scheme.name()], [run.h], thin(&run.points, SHOWN)));
    curve_table("scheme,h,t,R1,P1", curves)
}
