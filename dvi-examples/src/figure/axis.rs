//! Axes: ranges, ticks at round numbers, and their labels.

/// An axis with its label, linear or logarithmic.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    pub(super) label: String,
    pub(super) range: Option<[f64; 2]>,
    pub(super) logarithmic: bool,
    pub(super) names: Vec<String>,
}

impl Axis {
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { logarithmic: true, ..Self::linear(label) }
    }

    /// The time from 0 to `end`.
    pub fn time(end: f64) -> Self {
        Self::linear("time *t*").within([0.0, end])
    }

    /// An axis on which 0, 1, 2, … have names.
    pub fn names(label: impl Into<String>, names: Vec<String>) -> Self {
        let range = Some([-0.6, names.len() as f64 - 0.4]);
        Self { range, names, ..Self::linear(label) }
    }

    /// Fixes the range; without it the data decide.
    pub fn within(self, range: [f64; 2]) -> Self {
        Self { range: Some(range), ..self }
    }

    /// The range to draw for data that span `data`: fixed, or a little wider than the data.
    pub(super) fn fit(&self, data: Option<[f64; 2]>) -> [f64; 2] {
        if let Some(range) = self.range {
            return range;
        }
        let [low, high] = data.unwrap_or([1.0, 1.0]);
        if self.logarithmic {
            return [low / 1.5, high * 1.5];
        }
        let width = if high > low { high - low } else { low.abs().max(1.0) };
        [low - 0.05 * width, high + 0.05 * width]
    }

    /// The ticks on `scale`, about `wanted` of them.
    pub(super) fn ticks(&self, scale: &Scale, wanted: f64) -> Ticks {
        if self.names.is_empty() {
            return if self.logarithmic { decades(scale.range) } else { round_numbers(scale.range, wanted) };
        }
        let marks = self.names.iter().enumerate().map(|(i, name)| (i as f64, name.clone()));
        Ticks { marks: marks.collect(), factor: String::new() }
    }

    /// The number of letters of the longest name.
    pub(super) fn longest_name(&self) -> usize {
        self.names.iter().map(|name| name.chars().count()).max().unwrap_or(0)
    }

    pub(super) fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }
}

/// The map from values of an axis to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    pub(super) range: [f64; 2],
    pub(super) pixels: [f64; 2],
    pub(super) logarithmic: bool,
}

impl Scale {
    pub(super) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let [from, to] = self.pixels;
        let fraction = if self.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        from + fraction * (to - from)
    }
}

/// The ticks of an axis; an empty label is a minor tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    pub(super) marks: Vec<(f64, String)>,
    /// The power of ten that the labels leave out, as in “×10⁻³”; empty if none.
    pub(super) factor: String,
}

/// Multiples of 1, 2 or 5 times a power of ten, about `wanted` of them.
fn round_numbers([low, high]: [f64; 2], wanted: f64) -> Ticks {
    let raw = (high - low) / wanted;
    let decade = 10f64.powf(raw.log10().floor());
    let step = decade * [1.0, 2.0, 5.0].into_iter().find(|m| m * decade >= raw * 0.75).unwrap_or(10.0);
    let exponent = low.abs().max(high.abs()).log10().floor() as i32;
    let exponent = if (-2..=3).contains(&exponent) { 0 } else { exponent };
    let unit = 10f64.powi(exponent);
    let decimals = (-(step / unit * 1.001).log10().floor()).max(0.0) as usize;
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let marks = (first..=last).map(|k| (k as f64 * step, signed(k as f64 * step / unit, decimals)));
    let factor = if exponent == 0 { String::new() } else { format!("×{}", power_of_ten(exponent)) };
    Ticks { marks: marks.collect(), factor }
}

/// Powers of ten, thinned out where there are many; minor ticks at 2…9 where there are few, with labels at 2
/// and 5 on an axis of one decade or with fewer than two powers.
fn decades([low, high]: [f64; 2]) -> Ticks {
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let span = last - first;
    let is_inside = |value: f64| (low * 0.999..=high * 1.001).contains(&value);
    let is_short = span <= 1 || (first..=last).filter(|&k| is_inside(10f64.powi(k))).count() < 2;
    let every = match span {
        0..=7 => 1,
        8..=15 => 2,
        _ => 4,
    };
    let label = |m: i32, exponent: i32| match m {
        1 if exponent % every == 0 => power_of_ten(exponent),
        2 | 5 if is_short && exponent == 0 => m.to_string(),
        2 | 5 if is_short => format!("{m}·{}", power_of_ten(exponent)),
        _ => String::new(),
    };
    let multiples = if span <= 4 { 1..10 } else { 1..2 };
    let all = (first..=last).flat_map(|exponent| multiples.clone().map(move |m| (m, exponent)));
    let marks = all.map(|(m, exponent)| (f64::from(m) * 10f64.powi(exponent), label(m, exponent)));
    Ticks { marks: marks.filter(|(value, _)| is_inside(*value)).collect(), factor: String::new() }
}

/// A number with a proper minus sign, and none on zero.
fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.chars().all(|c| "-0.".contains(c));
    text.replace('-', if is_zero { "" } else { "−" })
}

/// A number with one decimal and a power of ten, as in “3.8·10⁻⁵”.
pub fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    match text.split_once('e') {
        None => text,
        Some((mantissa, "0")) => mantissa.replace('-', "−"),
        Some((mantissa, exponent)) => format!("{}·10{}", mantissa.replace('-', "−"), raised(exponent)),
    }
}

/// The same, never less than the value: for bounds.
pub fn at_most(value: f64) -> String {
    let rounded = scientific(value);
    if !value.is_finite() || value <= 0.0 {
        return rounded;
    }
    let unit = 10f64.powi(value.log10().floor() as i32 - 1);
    // What is a multiple of the unit up to rounding is one.
    scientific((value / unit - 1e-9).ceil() * unit)
}

fn power_of_ten(exponent: i32) -> String {
    format!("10{}", raised(&exponent.to_string()))
}

/// An integer in raised digits.
fn raised(digits: &str) -> String {
    let raise = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10)? as usize);
    digits.chars().map(|c| raise(c).unwrap_or('⁻')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.marks.iter().map(|(_, label)| label.as_str()).filter(|label| !label.is_empty()).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_inside_the_range() {
        let shown = |range, wanted| {
            let ticks = round_numbers(range, wanted);
            labels(&ticks).join(" ") + &ticks.factor
        };
        assert_eq!(shown([-0.31, 1.04], 5.0), "0.0 0.5 1.0");
        assert_eq!(shown([0.0, 2e5], 4.0), "0.0 0.5 1.0 1.5 2.0×10⁵");
        assert_eq!(shown([-3.2e-3, 3.2e-3], 6.0), "−3 −2 −1 0 1 2 3×10⁻³");
    }

    #[test]
    fn scientific_numbers_are_typeset() {
        let shown = [3.847e-5, -0.2, 1e6, 0.0, f64::NAN].map(scientific);
        assert_eq!(shown, ["3.8·10⁻⁵", "−2.0·10⁻¹", "1.0·10⁶", "0.0", "NaN"]);
    }

    #[test]
    fn bounds_are_rounded_up() {
        let shown = [9.527e-8, 9.5e-8, 1.0, 9.99e-3, 0.0].map(at_most);
        assert_eq!(shown, ["9.6·10⁻⁸", "9.5·10⁻⁸", "1.0", "1.0·10⁻²", "0.0"]);
    }

    #[test]
    fn logarithmic_ticks_are_decades() {
        assert_eq!(labels(&decades([0.5e-4, 2.0])), ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert_eq!(labels(&decades([1.1, 22.0])), ["2", "5", "10¹", "2·10¹"]);
    }

    #[test]
    fn data_without_width_or_without_points_still_give_a_range() {
        for data in [None, Some([3.0, 3.0]), Some([0.0, 0.0])] {
            let [low, high] = Axis::linear("x").fit(data);
            assert!(low < high && low.is_finite() && high.is_finite());
        }
    }
}
