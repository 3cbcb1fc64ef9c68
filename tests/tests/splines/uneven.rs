//! Splines on axes whose points are at very different distances.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::field::{Axis, Expansion, ScalarField, Spline, SplineError};
use dvi_tests::larger;

use super::{Numbers, Outcome, all, difference, points, refusal};

/// The equations are solved to rounding on any axis. Where neighbouring distances differ by up to a factor
/// of 10, splines become large, and their size is what rounding is measured by.
#[test]
fn very_uneven_points() -> Outcome {
    let mut numbers = Numbers(19);
    for k in 0..200 {
        let values: Vec<f64> = (0..20).map(|_| numbers.between([0.0, 1.0])).collect();
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
    let values: Vec<f64> = (0..40).map(|_| numbers.between([0.0, 1.0])).collect();
    let mut largest = |factor: f64, is_cubic: bool| -> Outcome<f64> {
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
    let mut points = points(numbers, -1.0, count, 0.4);
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
    fn check<const D: usize>(gap: f64, numbers: &mut Numbers) -> Outcome<[bool; 2]> {
        let count = if D == 1 { 14 } else { 8 };
        let (index, close) =
            (numbers.between([1.0, count as f64]) as usize, numbers.between([0.0, D as f64]) as usize);
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
                assert!(abs_diff_eq!(there.value, exact.value, epsilon = rounding), "{at:?}, {gap:e}");
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
    points
        .iter()
        .for_each(|&x| assert_abs_diff_eq!(spline.expansion([x]).value, bowl([x]).value, epsilon = 1e-14));
    Ok(())
}
