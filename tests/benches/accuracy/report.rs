//! The tables that are printed.

use crate::measure::Point;
use crate::problem::Problem;
use crate::problems::REFERENCE;

/// Bounds of the error for which the table has the smallest cost.
const BOUNDS: [f64; 3] = [1e-6, 1e-10, 1e-13];

/// The points of a problem, in the order of their methods.
pub(crate) struct Measured<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) points: Vec<Point>,
}

impl Measured<'_> {
    /// The names of the methods, in order.
    fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.points.iter().map(|point| point.method.as_str()).collect();
        names.dedup();
        names
    }

    /// The fastest run of a method that keeps the energy to `bound`.
    pub(crate) fn fastest(&self, method: &str, bound: f64) -> Option<&Point> {
        let within = self.points.iter().filter(|point| point.method == method && point.error <= bound);
        within.min_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds))
    }

    /// How long `method` takes in units of `other`.
    pub(crate) fn ratio(&self, method: &str, other: &str, bound: f64) -> Option<f64> {
        let [time, of] =
            [method, other].map(|name| self.fastest(name, bound).map(|point| point.milliseconds));
        Some(time? / of?)
    }

    /// Milliseconds to hold each bound, in brackets in units of the reference, and evaluations.
    pub(crate) fn print(&self) {
        let Problem { title, error, .. } = self.problem;
        let bounds = BOUNDS.map(|bound| format!("{bound:e}")).join(" | ");
        println!("\n| {title}: ms to hold max {error} (× {REFERENCE}); evaluations | {bounds} |");
        println!("|---|---|---|---|");
        for method in self.methods() {
            let cells = BOUNDS.map(|bound| self.cell(method, bound)).join(" | ");
            println!("| {method} | {cells} |");
        }
    }

    fn cell(&self, method: &str, bound: f64) -> String {
        let Some(point) = self.fastest(method, bound) else { return "–".into() };
        let ratio = self.ratio(method, REFERENCE, bound).map(|ratio| format!(" (×{ratio:.2})"));
        let evaluations = point.evaluations.map(|count| format!("; {:.0}k", count as f64 / 1e3));
        let [ratio, evaluations] = [ratio, evaluations].map(|text| text.unwrap_or_default());
        format!("{:.3}{ratio}{evaluations}", point.milliseconds)
    }
}
