//! Splines of a table: they take its values, are smooth, have the derivatives that they say, and know where they end.

use dvi_core::Scalar;
use dvi_core::field::{Axis, AxisError, Expansion, ScalarField, Spline, SplineError};
use dvi_tests::larger;
use num_dual::{Dual64, HyperDual64};

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// Numbers in [0, 1), the same in each run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, [from, to]: [f64; 2]) -> f64 {
        from + (to - from) * self.next()
    }

    /// Points from `from` on whose distances differ by up to a factor of 2.
    fn points(&mut self, from: f64, count: usize, distance: f64) -> Vec<f64> {
        let mut at = from;
        let mut step = || {
            let here = at;
            at += distance * self.between([0.7, 1.4]);
            here
        };
        (0..count).map(|_| step()).collect()
    }
}

/// Axes from −1 to 2, uniform, uneven, and periodic, one of the periodic ones with both ends.
fn axes(count: usize) -> Result<[Axis; 4], AxisError> {
    let mut uneven = Numbers(7).points(0.0, count, 1.0);
    let last = uneven[count - 1];
    uneven.iter_mut().for_each(|x| *x = (3.0 * *x / last - 1.0).min(2.0));
    let uniform = Axis::uniform([-1.0, 2.0], count)?;
    Ok([
        Axis::periodic(uniform.points(), 3.0)?,
        Axis::periodic(&uneven[..count - 1], 3.0)?,
        uniform,
        Axis::new(&uneven)?,
    ])
}

/// A function of D variables, of period 3 in each, that treats none as the other.
fn smooth<const D: usize, T: Scalar>(at: [T; D]) -> T {
    let wave = |i: usize| (at[i] * T::lift(std::f64::consts::TAU / 3.0) + T::lift(0.3 + i as f64)).sin();
    let sum = (0..D).fold(T::lift(0.0), |sum, i| sum + wave(i) * T::lift(0.5 + 0.25 * i as f64));
    sum + wave(0) * wave(D - 1)
}

/// Value, gradient and Hessian of a function by dual numbers.
fn by_dual_numbers<const D: usize>(
    at: [f64; D],
    f: impl Fn([HyperDual64; D]) -> HyperDual64,
) -> Expansion<D> {
    let mut expansion = Expansion { value: 0.0, gradient: [0.0; D], hessian: [[0.0; D]; D] };
    for i in 0..D {
        for j in 0..D {
            let mut x = at.map(HyperDual64::from);
            x[i].eps1 = 1.0;
            x[j].eps2 = 1.0;
            let f = f(x);
            (expansion.value, expansion.gradient[i], expansion.hessian[i][j]) = (f.re, f.eps1, f.eps1eps2);
        }
    }
    expansion
}

/// What is said of what is refused; nothing of what is not.
fn refusal<T, E: core::fmt::Display>(result: Result<T, E>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

fn all<const D: usize, T: Copy>(expansion: &Expansion<D, T>) -> Vec<T> {
    let second = expansion.hessian.as_flattened();
    [&[expansion.value], &expansion.gradient[..], second].concat()
}

/// The largest difference of two lists, relative to the largest entry of the second, or to 1.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().map(|x| x.abs()).fold(1.0, larger);
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / size).fold(0.0, larger)
}

/// Calls `of` with splines in one, two and three variables on each kind of axis.
fn for_each_kind(
    mut one: impl FnMut(&Axis) -> Outcome,
    mut two: impl FnMut([&Axis; 2]) -> Outcome,
    mut three: impl FnMut([&Axis; 3]) -> Outcome,
) -> Outcome {
    let (long, short) = (axes(11)?, axes(8)?);
    for i in 0..4 {
        one(&long[i])?;
        two([&long[i], &short[(i + 1) % 4]])?;
        three([&short[i], &long[(i + 1) % 4], &short[(i + 2) % 4]])?;
    }
    Ok(())
}

macro_rules! for_each_kind {
    ($check:ident) => {
        for_each_kind(|axis| $check([axis]), |axes| $check(axes), |axes| $check(axes))
    };
}

/// Both degrees, as one type: the values of the checks below do not depend on it.
fn of_both_degrees<const D: usize>(
    axes: [&Axis; D],
    mut check: impl FnMut(
        &dyn Fn([f64; D]) -> Expansion<D>,
        &dyn Fn([HyperDual64; D]) -> Expansion<D, HyperDual64>,
    ),
) -> Outcome {
    let cubic = Spline::sample(axes.map(Axis::clone), smooth)?;
    check(&|at| cubic.expansion(at), &|at| cubic.expansion(at));
    let quintic = Spline::sample_quintic(axes.map(Axis::clone), smooth)?;
    check(&|at| quintic.expansion(at), &|at| quintic.expansion(at));
    Ok(())
}

#[test]
fn a_spline_takes_the_values_of_the_table() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        of_both_degrees(axes, |spline, _| {
            let count: usize = axes.iter().map(|axis| axis.points().len()).product();
            for mut index in 0..count {
                let at = axes.map(|axis| {
                    let points = axis.points();
                    let x = points[index % points.len()];
                    index /= points.len();
                    x
                });
                let (found, expected) = (spline(at).value, smooth(at));
                assert!((found - expected).abs() < 1e-13, "{at:?}: {found} {expected}");
            }
        })
    }
    for_each_kind!(check)
}

#[test]
fn the_smallest_tables() -> Outcome {
    let values = [1.0, -2.0, 0.5, 4.0, -1.0, 0.25];
    for count in 4..=6 {
        let uneven = [-1.0, -0.25, 0.0, 1.0, 1.5, 2.0];
        let points = &uneven[..count];
        for axis in [Axis::new(points)?, Axis::periodic(points, 3.75)?, Axis::uniform([0.0, 2.0], count)?] {
            let cubic = Spline::new([axis.clone()], &values[..count])?;
            let quintic = Spline::quintic([axis.clone()], &values[..count]);
            assert_eq!(quintic.is_ok(), count == 6);
            for (&x, expected) in axis.points().iter().zip(values) {
                let found = cubic.expansion([x]).value;
                assert!((found - expected).abs() < 1e-13, "{axis:?} {x}: {found}");
                let found = quintic.as_ref().map_or(expected, |quintic| quintic.expansion([x]).value);
                assert!((found - expected).abs() < 1e-13, "{axis:?} {x}: {found}");
            }
        }
    }
    Ok(())
}

/// The equations are solved to rounding on any axis. Where neighbouring distances differ by up to a factor of 10, splines
/// become large, and their size is what rounding is measured by.
#[test]
fn very_uneven_points() -> Outcome {
    let mut numbers = Numbers(19);
    for k in 0..200 {
        let values: Vec<f64> = (0..20).map(|_| numbers.next()).collect();
        let (mut at, mut points) = (0.0, Vec::new());
        for _ in 0..20 {
            points.push(at);
            at += 10_f64.powf(numbers.between([-0.5, 0.5]));
        }
        let axis = if k % 2 == 0 { Axis::new(&points)? } else { Axis::periodic(&points, at)? };
        let (cubic, quintic) = (Spline::new([axis.clone()], &values)?, Spline::quintic([axis], &values)?);
        let residual = |value: &dyn Fn(f64) -> f64| {
            let at_points = points.iter().zip(&values).map(|(x, f)| (value(*x) - f).abs()).fold(0.0, larger);
            let size = (0..200).map(|i| value(at * f64::from(i) / 200.0).abs());
            // Beyond the last point there is no value, and it does not count.
            at_points / size.filter(|value| value.is_finite()).fold(0.0, larger)
        };
        let cubic = residual(&|x| cubic.expansion([x]).value);
        let quintic = residual(&|x| quintic.expansion([x]).value);
        assert!(cubic < 1e-13 && quintic < 1e-12, "{cubic:e} {quintic:e}");
    }
    Ok(())
}

/// What the documentation says of grids whose distances grow.
#[test]
fn growing_distances() -> Outcome {
    let mut numbers = Numbers(17);
    let values: Vec<f64> = (0..40).map(|_| numbers.next()).collect();
    let mut largest = |factor: f64, is_cubic: bool| -> Result<f64, Box<dyn core::error::Error>> {
        let distances = core::iter::successors(Some(1.0), |distance| Some(distance * factor));
        let sum = |at: &mut f64, distance: f64| Some(core::mem::replace(at, *at + distance));
        let points: Vec<f64> = distances.scan(0.0, sum).take(40).collect();
        let axes = [Axis::new(&points)?];
        let value: Box<dyn Fn(f64) -> f64> = if is_cubic {
            let spline = Spline::new(axes, &values)?;
            Box::new(move |x| spline.expansion([x]).value)
        } else {
            let spline = Spline::quintic(axes, &values)?;
            Box::new(move |x| spline.expansion([x]).value)
        };
        let mut size = |pair: &[f64]| value(numbers.between([pair[0], pair[1]])).abs();
        Ok(points.windows(2).flat_map(|pair| [pair; 10]).map(&mut size).fold(0.0, larger))
    };
    assert!(largest(2.0, true)? < 4.0 && largest(3.0, true)? > 100.0);
    assert!(largest(1.2, false)? < 4.0 && largest(1.5, false)? > 100.0);
    Ok(())
}

/// Nearly uniform points from −1 on, two of which, at `index` − 1 and `index`, have the distance `gap`.
fn with_a_gap(numbers: &mut Numbers, count: usize, index: usize, gap: f64) -> Vec<f64> {
    let mut points = numbers.points(-1.0, count, 0.4);
    let before = points[index - 1];
    let closer = points[index] - before - gap;
    points[index] = if before + gap > before { before + gap } else { before.next_up() };
    points[index + 1..].iter_mut().for_each(|x| *x -= closer);
    points
}

/// The function 1 + Σ x²/10 and its derivatives, which splines have but for rounding errors.
fn bowl<const D: usize>(at: [f64; D]) -> Expansion<D> {
    let hessian = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 0.2 } else { 0.0 }));
    Expansion {
        value: 1.0 + at.iter().map(|x| x * x / 10.0).sum::<f64>(),
        gradient: at.map(|x| x / 5.0),
        hessian,
    }
}

/// Two points that are too close are named; where they are not, the values that are known are met, with
/// half of the digits at least.
#[test]
fn close_points_are_met_or_refused() -> Outcome {
    fn check<const D: usize>(
        gap: f64,
        numbers: &mut Numbers,
    ) -> Result<[bool; 2], Box<dyn core::error::Error>> {
        let count = if D == 1 { 14 } else { 8 };
        let (index, close) =
            (1 + (numbers.next() * (count - 1) as f64) as usize, (numbers.next() * D as f64) as usize);
        let points: [Vec<f64>; D] = core::array::from_fn(|axis| {
            let gap = if axis == close { gap } else { 0.4 };
            with_a_gap(numbers, count, index, gap)
        });
        let mut axes = Vec::new();
        for points in &points {
            axes.push(Axis::new(points)?);
        }
        let axes: [Axis; D] = axes.try_into().map_err(|_| "there are D of them")?;
        let (cubic, quintic) = (
            Spline::sample(axes.clone(), |at| bowl(at).value),
            Spline::sample_quintic(axes, |at| bowl(at).value),
        );
        let [before, after] = [points[close][index - 1], points[close][index]];
        let is_named = |error: SplineError| match error {
            SplineError::Unequal { axis, index: at, before: one, after: other, growth } => {
                growth > 1e8 && (axis, at, one, other) == (close, index, before, after)
            }
            _ => false,
        };
        let mut accepted = [true; 2];
        let ends: Vec<[f64; 2]> = points.iter().map(|points| [points[0], points[count - 1]]).collect();
        let largest =
            bowl(core::array::from_fn::<f64, D, _>(|axis| larger(-ends[axis][0], ends[axis][1]))).value;
        for _ in 0..100 {
            let at: [f64; D] = core::array::from_fn(|axis| numbers.between(ends[axis]));
            let there = [
                cubic.as_ref().map(|spline| spline.expansion(at)),
                quintic.as_ref().map(|spline| spline.expansion(at)),
            ];
            for (accepted, there) in accepted.iter_mut().zip(there) {
                let there: Expansion<D> = match there {
                    Ok(there) => there,
                    Err(&error) => {
                        assert!(is_named(error), "{error}");
                        *accepted = false;
                        continue;
                    }
                };
                let exact = bowl(at);
                let rounding = 1e8 * f64::EPSILON * largest;
                assert!((there.value - exact.value).abs() < rounding, "{at:?}, {gap:e}");
                let off = difference(&all(&there), &all(&exact));
                assert!(off < 200.0 * rounding, "{at:?}, {gap:e}: {off:e}");
            }
        }
        Ok(accepted)
    }
    let mut numbers = Numbers(43);
    for exponent in 1..=17 {
        // The larger distance beside it is between 0.28 and 0.56.
        let gap = 10_f64.powi(-exponent);
        for _ in 0..20 {
            let accepted = check::<1>(gap, &mut numbers)?;
            assert!(accepted[0] || gap < 1e-7 * 0.56, "{gap:e}");
            assert!(accepted[1] || gap < 1e-6 * 0.56, "{gap:e}");
            assert!(accepted == [false; 2] || gap > 1e-9 * 0.28, "{gap:e}");
        }
        check::<2>(gap, &mut numbers)?;
        check::<3>(gap, &mut numbers)?;
    }
    // The figures of the documentation.
    let points = [-0.6, 0.0, 0.31, 0.62, 1.2, 1.2 + 1e-7, 1.5, 2.0, 2.9];
    let spline = Spline::sample([Axis::new(&points)?], |at| bowl(at).value)?;
    let mut largest = [0.0; 3];
    for k in 0..=1000 {
        let at = [-0.6 + 3.5 * f64::from(k) / 1000.0];
        let (there, exact) = (all(&spline.expansion(at)), all(&bowl(at)));
        largest = core::array::from_fn(|i| larger(largest[i], (there[i] - exact[i]).abs()));
    }
    assert!(largest[0] < 1e-9 && largest[2] < 1e-7, "{largest:?}");
    // Two gaps are each allowed, and both together are not.
    let points = with_a_gap(&mut numbers, 8, 3, 1e-5);
    let axis = Axis::new(&points)?;
    assert!(Spline::sample([axis.clone()], |at| bowl(at).value).is_ok());
    let both = Spline::sample([axis.clone(), axis], |at| bowl(at).value);
    assert!(matches!(both, Err(SplineError::Unequal { index: 3, .. })), "{both:?}");
    // As the two last points of a periodic axis.
    let points = [0.0, 0.25, 0.5, 0.75, 0.75_f64.next_up()];
    let said = refusal(Spline::new([Axis::periodic(&points, 1.0)?], &[0.0; 5]));
    assert!(
        said.starts_with("points 3 and 4 of axis 0, 7.5e-1 and 7.500000000000001e-1, are too close"),
        "{said}"
    );
    // Where all points are neighbouring numbers, none is closer than the others.
    let next = |x: &f64| Some(x.next_up());
    let points: Vec<f64> = core::iter::successors(Some(1.0), next).take(6).collect();
    let spline = Spline::sample([Axis::new(&points)?], |at| bowl(at).value)?;
    points.iter().for_each(|&x| assert!((spline.expansion([x]).value - bowl([x]).value).abs() < 1e-14));
    Ok(())
}

#[test]
fn derivatives_are_those_of_the_value() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        let mut numbers = Numbers(D as u64);
        of_both_degrees(axes, |spline, in_dual_numbers| {
            for _ in 0..40 {
                let at = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
                let found = spline(at);
                let expected = by_dual_numbers(at, |x| in_dual_numbers(x).value);
                let error = difference(&all(&found), &all(&expected));
                assert!(error < 1e-13, "{at:?}: {error:e}");
                // The gradient on dual numbers has the Hessian.
                for i in 0..D {
                    let mut x = at.map(HyperDual64::from);
                    x[i].eps1 = 1.0;
                    let gradient = in_dual_numbers(x).gradient.map(|g| g.eps1);
                    assert!(difference(&gradient, &found.hessian[i]) < 1e-13, "{at:?}");
                }
                // Differences of the value, of fourth order, where the polynomial has no jump of higher derivatives.
                for i in 0..D {
                    let h = 1e-3;
                    let f = |steps: f64| {
                        let mut x = at;
                        x[i] = (x[i] + steps * h).clamp(-1.0, 2.0);
                        spline(x).value
                    };
                    if (at[i] - 0.5).abs() < 1.49 {
                        let slope = (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / (12.0 * h);
                        assert!(
                            (slope - found.gradient[i]).abs() < 1e-4,
                            "{at:?}: {slope} {:?}",
                            found.gradient
                        );
                    }
                }
            }
        })
    }
    for_each_kind!(check)
}

/// On both sides of each line of the grid the value and all derivatives that are continuous agree. Those above the second are
/// derivatives of the Hessian on dual numbers.
#[test]
fn derivatives_are_continuous() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        let (mut numbers, mut degree) = (Numbers(3), 3);
        of_both_degrees(axes, |spline, in_dual_numbers| {
            for (i, axis) in axes.iter().enumerate() {
                let points = axis.points();
                for &line in &points[1..points.len() - 1] {
                    let mut at: [f64; D] = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
                    let side = |x: f64| {
                        let mut at = at;
                        at[i] = x;
                        at
                    };
                    let (below, above) = (side(line.next_down()), side(line));
                    let error = difference(&all(&spline(below)), &all(&spline(above)));
                    assert!(error < 1e-12, "{at:?} {i} {line}: {error:e}");
                    // The third and fourth derivatives across the line.
                    let higher = |at: [f64; D]| {
                        let mut at = at.map(HyperDual64::from);
                        (at[i].eps1, at[i].eps2) = (1.0, 1.0);
                        let second = in_dual_numbers(at).hessian[i][i];
                        [second.eps1, second.eps1eps2]
                    };
                    let error = difference(&higher(below), &higher(above));
                    if degree == 5 {
                        assert!(error < 1e-10, "{at:?} {i} {line}: {error:e}");
                    } else if axis.period().is_none() && [points[1], points[points.len() - 2]].contains(&line)
                    {
                        assert!(error < 1e-10, "not a knot: {at:?} {i} {line}: {error:e}");
                    } else {
                        assert!(error > 1e-6, "a cubic spline has jumps of the third derivative: {error:e}");
                    }
                    at[i] = line;
                    assert!(spline(at).value.is_finite());
                }
            }
            degree = 5;
        })
    }
    for_each_kind!(check)
}

/// Across the end of a period too.
#[test]
fn a_period_has_no_ends() -> Outcome {
    for axis in &axes(9)?[..2] {
        of_both_degrees([axis], |spline, _| {
            let first = axis.points()[0];
            for end in [first, first + 3.0, first - 6.0] {
                let error = difference(&all(&spline([end.next_down()])), &all(&spline([end.next_up()])));
                assert!(error < 1e-12, "{error:e}");
            }
            // Steps of 3 · 2ᵏ and binary fractions are added without rounding.
            for (x, periods) in
                [(0.625, 1.0), (-0.875, -1.0), (1.5, 1e9), (0.25, -1e9), (-0.5, 2_f64.powi(45))]
            {
                let (near, far) = (spline([x]), spline([x + 3.0 * periods]));
                assert!(difference(&all(&far), &all(&near)) < 1e-14, "{x} {periods}: {far:?} {near:?}");
            }
            assert!([1e300, f64::MAX, f64::MIN].iter().all(|x| spline([*x]).value.is_finite()));
        })?;
    }
    Ok(())
}

/// Any period and any first point: what is far away is in its place in the first period, to the rounding of the argument.
#[test]
fn periods_are_taken_off() -> Outcome {
    let mut numbers = Numbers(23);
    for _ in 0..200 {
        let (first, period) = (numbers.between([-5.0, 5.0]), numbers.between([0.1, 10.0]));
        let points: Vec<f64> = (0..7).map(|i| first + period * f64::from(i) / 7.0).collect();
        let wave = |x: f64| (std::f64::consts::TAU * (x - first) / period).sin();
        let spline = Spline::sample([Axis::periodic(&points, period)?], |[x]| wave(x))?;
        for turns in [0, 1, -1, 3, -1000, 1_000_000_000] {
            let x = numbers.between([first, first + period]);
            let far = x + f64::from(turns) * period;
            let (near, found): (Expansion<1>, Expansion<1>) =
                (spline.expansion([x]), spline.expansion([far]));
            let rounding = 1e-14 + 4.0 * f64::EPSILON * far.abs() * std::f64::consts::TAU / period;
            assert!((near.value - found.value).abs() < rounding, "{first} {period} {x} {turns}");
        }
        for end in [first, first + period, first - period, first + 5.0 * period] {
            for x in [end.next_down(), end, end.next_up()] {
                let there: Expansion<1> = spline.expansion([x]);
                assert!((there.value - wave(x)).abs() < 1e-13, "{first} {period} {x}: {there:?}");
            }
        }
    }
    Ok(())
}

/// x₀ᵃ x₁ᵇ x₂ᶜ with exponents up to the degree, on axes without a period.
#[test]
fn polynomials_are_reproduced() -> Outcome {
    let powers =
        |degree: i32, term: i32| [term % degree + 1, (3 * term + 1) % (degree + 1), degree - term % degree];
    let exact = |at: [HyperDual64; 3], powers: [i32; 3]| {
        (0..3).fold(HyperDual64::from(1.0), |product, i| product * Scalar::powi(at[i], powers[i]))
    };
    let value = |at: [f64; 3], powers: [i32; 3]| exact(at.map(HyperDual64::from), powers).re;
    let [_, _, uniform, uneven] = axes(9)?;
    let short = Axis::new(&[-1.0, -0.75, 0.0, 0.5, 1.0, 2.0])?;
    let axes = [uneven, short, uniform];
    let mut numbers = Numbers(5);
    for term in 0..5 {
        let (three, five) = (powers(3, term), powers(5, term));
        let cubic = Spline::sample(axes.clone(), |at| value(at, three))?;
        let quintic = Spline::sample_quintic(axes.clone(), |at| value(at, five))?;
        for _ in 0..50 {
            let at = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
            let error =
                difference(&all(&cubic.expansion(at)), &all(&by_dual_numbers(at, |x| exact(x, three))));
            assert!(error < 1e-12, "{three:?} {at:?}: {error:e}");
            let error =
                difference(&all(&quintic.expansion(at)), &all(&by_dual_numbers(at, |x| exact(x, five))));
            assert!(error < 1e-11, "{five:?} {at:?}: {error:e}");
        }
    }
    Ok(())
}

#[test]
fn outside_nothing_is_known() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        let spline = Spline::sample(axes.map(Axis::clone), smooth)?;
        let inside = [0.3; D];
        for (i, (axis, domain)) in axes.iter().zip(spline.domain()).enumerate() {
            let of = |x: f64| {
                let mut at = inside;
                at[i] = x;
                all(&spline.expansion(at))
            };
            let is_nan = |x: f64| of(x).iter().all(|part| part.is_nan());
            let is_finite = |x: f64| of(x).iter().all(|part| part.is_finite());
            let periodic = axis.period().is_some();
            let bounds = if periodic { (f64::NEG_INFINITY, f64::INFINITY) } else { (-1.0, 2.0) };
            assert_eq!(domain, bounds);
            assert!(is_finite(-1.0) && is_finite(2.0) && is_finite(-0.0), "{i}");
            for x in [(-1.0_f64).next_down(), 2.0_f64.next_up(), 3.0, -1e9, f64::MAX, f64::MIN] {
                assert!(if periodic { is_finite(x) } else { is_nan(x) }, "{i} {x}");
            }
            for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(is_nan(x), "{i} {x}");
                let mut at = inside.map(Dual64::from);
                at[i] = Dual64::from(x).derivative();
                assert!(all(&spline.expansion(at)).iter().all(|part| part.re.is_nan()));
            }
        }
        Ok(())
    }
    for_each_kind!(check)
}

/// The errors, and what they say.
#[test]
fn what_cannot_be_a_spline() -> Outcome {
    let axis = |points: &[f64]| refusal(Axis::new(points));
    assert_eq!(axis(&[0.0, f64::NAN]), "point 1 of the axis is NaN, and a finite number is expected");
    assert_eq!(
        axis(&[0.0, 1.0, 0.5]),
        "point 2 of the axis is 0.5 and the one before it is 1, and an increase is expected"
    );
    assert_eq!(
        axis(&[1.0, 1.0]),
        "point 1 of the axis is 1 and the one before it is 1, and an increase is expected"
    );
    assert_eq!(
        axis(&[0.0, 1e-200]),
        "point 1 of the axis is 1e-200 after 0e0, a distance whose square is out of range"
    );
    let periodic = |points: &[f64], period: f64| refusal(Axis::periodic(points, period));
    let of = |period: &str| {
        format!(
            "the period {period} does not go with points from 0 to 3: the last point is expected at the first one plus the \
             period, or clearly before it"
        )
    };
    let points = [0.0, 1.0, 2.0, 3.0];
    for period in [2.9, 3.005, 0.0, -4.0, f64::NAN, f64::INFINITY] {
        assert_eq!(periodic(&points, period), of(&period.to_string()));
    }
    assert_eq!(Axis::periodic(&points, 3.5)?.period(), Some(3.5));
    // Nor may the distance from the last point to the end of the period be out of range.
    assert!(Axis::periodic(&points, 1e170).is_err());
    let tiny = points.map(|x| x * 1e-153);
    assert!(Axis::periodic(&tiny, 4e-153).is_ok() && Axis::periodic(&tiny, 3.02e-153).is_err());
    // An end of the period that is written with six digits is the end; one with three digits is refused.
    let rounded = |end: f64| (0..=100).map(|i| end * f64::from(i) / 100.0).collect::<Vec<f64>>();
    let written = Axis::periodic(&rounded(0.666667), 2.0 / 3.0)?;
    let [(from, to)] = Spline::sample([written], |_| 1.0)?.domain();
    assert_eq!((from, to), (f64::NEG_INFINITY, f64::INFINITY));
    assert!(Axis::periodic(&rounded(0.667), 2.0 / 3.0).is_err());

    let said = |axes: [Axis; 2], values: &[f64]| refusal(Spline::new(axes, values));
    let (four, three) = (Axis::new(&points)?, Axis::new(&points[..3])?);
    let closed = Axis::periodic(&points, 3.0)?;
    let two = "axis 1 has 3 different points, and at least 4 are expected";
    assert_eq!(said([four.clone(), three], &[0.0; 12]), two);
    assert_eq!(said([four.clone(), closed], &[0.0; 16]), two);
    assert_eq!(
        refusal(Spline::quintic([four.clone()], &[0.0; 4])),
        "axis 0 has 4 different points, and at least 6 are expected"
    );
    assert_eq!(
        said([four.clone(), four.clone()], &[0.0; 15]),
        "the table has 15 values, and the grid has 16 points"
    );
    let mut values = [0.0; 16];
    values[5] = f64::INFINITY;
    assert_eq!(
        said([four.clone(), four.clone()], &values),
        "value 5 of the table is inf, and a finite number is expected"
    );
    let closed = Axis::periodic(&[0.0, 1.0, 2.0, 3.0, 4.0], 4.0)?;
    let mut values: Vec<f64> = (0..20).map(|k| f64::from(k % 5 % 4)).collect();
    assert!(Spline::new([four.clone(), closed.clone()], &values).is_ok());
    values[14] = 0.25;
    assert_eq!(
        said([four.clone(), closed], &values),
        "value 14 of the table is 0.25 at the end of the period of axis 1, and 0 is expected, as value 10 is at its start"
    );
    let alternating: Vec<f64> = (0..16).map(|k| if k % 3 == 0 { 1.7e308 } else { -1.7e308 }).collect();
    assert_eq!(
        said([four.clone(), four], &alternating),
        "a coefficient of the spline is not finite: the values are too large or the distances on an axis too unequal"
    );
    let many = Axis::uniform([0.0, 1.0], 100_000)?;
    let huge = Spline::sample([many.clone(), many.clone(), many.clone(), many], |_| 0.0);
    assert_eq!(refusal(huge), "the grid has more points than there can be memory for");
    Ok(())
}

/// Far from zero, in tiny units, with one cell: the scale of an axis does not show.
#[test]
fn scales_of_axes() -> Outcome {
    let f = |x: f64| (3.0 * x).sin() + x * x;
    let points = |count: usize| (0..count).map(|i| i as f64 / (count - 1) as f64).collect::<Vec<f64>>();
    for count in [4, 5, 9, 33] {
        let values: Vec<f64> = points(count).into_iter().map(f).collect();
        let reference = Spline::new([Axis::new(&points(count))?], &values)?;
        // Powers of two and sums with few digits, so that the axes are the same but for their scale.
        for (origin, scale) in [
            (0.0, 2_f64.powi(-500)),
            (0.0, 2_f64.powi(500)),
            (-7.0, 1.0),
            (-1048576.0, 1.0),
            (1e6, 0.03125),
            (2_f64.powi(40), 1.0),
        ] {
            let axis: Vec<f64> = points(count).iter().map(|x| origin + scale * x).collect();
            let spline = Spline::new([Axis::new(&axis)?], &values)?;
            for k in 0..=64 {
                let x = f64::from(k) / 64.0;
                let at = origin + scale * x;
                let (found, expected) = (spline.expansion([at]), reference.expansion([x]));
                let found = [found.value, found.gradient[0] * scale, found.hessian[0][0] * scale * scale];
                // The points of the axis are rounded where it is far from zero.
                let rounding = 1e-13 + 1e3 * f64::EPSILON * origin.abs() / scale;
                assert!(difference(&found, &all(&expected)) < rounding, "{count} {origin} {scale:e} {x}");
            }
        }
    }
    // Values at the end of the range of numbers.
    for size in [f64::from_bits(1), 1e-310, 1e300] {
        let values: Vec<f64> = points(9).into_iter().map(|x| size * f(x)).collect();
        let spline = Spline::new([Axis::new(&points(9))?], &values)?;
        for k in 0..=64 {
            let there: Expansion<1> = spline.expansion([f64::from(k) / 64.0]);
            assert!(all(&there).iter().all(|part| part.is_finite()));
        }
    }
    Ok(())
}

/// On an axis from a million to a million and one, a table of exact values is met to the rounding of the argument.
#[test]
fn accuracy_far_from_zero() -> Outcome {
    let f = |x: f64| (x - 1e6).sin();
    let spline = Spline::sample([Axis::uniform([1e6, 1e6 + 1.0], 1001)?], |[x]| f(x))?;
    let mut numbers = Numbers(9);
    for _ in 0..1000 {
        let x = numbers.between([1e6, 1e6 + 1.0]);
        let there = spline.expansion([x]);
        let y = x - 1e6;
        assert!((there.value - y.sin()).abs() < 1e-13, "{x}: {:e}", there.value - y.sin());
        assert!((there.gradient[0] - y.cos()).abs() < 1e-9, "{x}: {:e}", there.gradient[0] - y.cos());
        assert!((there.hessian[0][0] + y.sin()).abs() < 2e-6, "{x}: {:e}", there.hessian[0][0] + y.sin());
    }
    Ok(())
}

/// Whatever the axes and the values, there is a spline or an error, and what it is asked is answered.
#[test]
fn any_table() -> Outcome {
    let mut numbers = Numbers(11);
    let odd = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e-308,
        5e-324,
        1e-160,
        1e-150,
        1e150,
        1e308,
        -1e308,
        1e16,
        f64::NAN,
        f64::INFINITY,
    ];
    let (mut made, mut refused) = (0, 0);
    for _ in 0..4000 {
        let mut any_axis = || {
            let count = (numbers.next() * 12.0) as usize;
            let size = 10_f64.powf(numbers.between([-20.0, 20.0]));
            let ratio = 10_f64.powf(numbers.between([-2.0, 2.0]));
            let mut at = numbers.between([-1.0, 1.0]) * size * numbers.next();
            let mut step = size * numbers.next();
            let mut points = Vec::new();
            for _ in 0..count {
                points.push(if numbers.next() < 0.002 { odd[(numbers.next() * 14.0) as usize] } else { at });
                at += step;
                step *= if numbers.next() < 0.5 { 1.0 } else { ratio };
            }
            let period = if numbers.next() < 0.1 { 1.0 } else { (at - points.first().unwrap_or(&0.0)).abs() };
            if numbers.next() < 0.5 { Axis::new(&points) } else { Axis::periodic(&points, period) }
        };
        let (Ok(first), Ok(second)) = (any_axis(), any_axis()) else {
            refused += 1;
            continue;
        };
        let mut numbers = Numbers(made + refused);
        let mut value = |_: [f64; 2]| {
            if numbers.next() < 0.001 { odd[(numbers.next() * 14.0) as usize] } else { numbers.next() }
        };
        let axes = [first, second];
        let (cubic, quintic) =
            (Spline::sample(axes.clone(), &mut value), Spline::sample_quintic(axes.clone(), &mut value));
        for spline in [cubic.map(|s| ask(&s, &axes)), quintic.map(|s| ask(&s, &axes))] {
            match spline {
                Ok(()) => made += 1,
                Err(_) => refused += 1,
            }
        }
    }
    assert!(made > 1000 && refused > 1000, "{made} {refused}");
    Ok(())
}

/// Evaluates a spline at many places, among them all lines of its grid and their neighbours. Inside, the value is known.
fn ask<F: ScalarField<2>>(spline: &F, axes: &[Axis; 2]) {
    let domain = spline.domain();
    let odd =
        [0.0, -0.0, 5e-324, 1e-310, -1e300, f64::MAX, f64::MIN, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let places = |axis: &Axis| {
        let near = |x: &f64| [x.next_down(), *x, x.next_up()];
        axis.points().iter().flat_map(near).chain(odd).collect::<Vec<f64>>()
    };
    let (first, second) = (places(&axes[0]), places(&axes[1]));
    for (i, &x) in first.iter().enumerate() {
        let y = second[(7 * i + 3) % second.len()];
        let there = spline.expansion([x, y]);
        let inside = [x, y].iter().zip(domain).all(|(x, (from, to))| x.is_finite() && from <= *x && *x <= to);
        assert_eq!(there.value.is_nan(), !inside, "{x} {y} {domain:?} {there:?}");
    }
}

/// In single precision the spline is the same to its rounding.
#[test]
fn single_precision() -> Outcome {
    let [_, periodic, uniform, _] = axes(9)?;
    let spline = Spline::sample([periodic, uniform], smooth)?;
    let mut numbers = Numbers(13);
    for _ in 0..100 {
        let at: [f32; 2] = core::array::from_fn(|_| numbers.between([-1.0, 2.0]) as f32);
        let single: Vec<f64> = all(&spline.expansion(at)).into_iter().map(f64::from).collect();
        let error = difference(&single, &all(&spline.expansion(at.map(f64::from))));
        assert!(error < 1e-5, "{at:?}: {error:e}");
    }
    Ok(())
}
