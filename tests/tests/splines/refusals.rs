//! What is refused, and what is outside: whatever the table, there is a spline or an error.

use dvi_core::field::{Axis, ScalarField, Spline};
use num_dual::Dual64;

use super::{Numbers, Outcome, all, for_each_kind, refusal, smooth};

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
            "the period {period} does not go with points from 0 to 3: the last point is expected clearly \
             before the first one plus the period, which is left out"
        )
    };
    let points = [0.0, 1.0, 2.0, 3.0];
    for period in [2.9, 3.0, 3.005, 0.0, -4.0, f64::NAN, f64::INFINITY] {
        assert_eq!(periodic(&points, period), of(&period.to_string()));
    }
    assert_eq!(Axis::periodic(&points, 3.5)?.period(), Some(3.5));
    // Nor may the distance from the last point to the end of the period be out of range.
    assert!(Axis::periodic(&points, 1e170).is_err());
    let tiny = points.map(|x| x * 1e-153);
    assert!(Axis::periodic(&tiny, 4e-153).is_ok() && Axis::periodic(&tiny, 3.02e-153).is_err());

    let said = |axes: [Axis; 2], values: &[f64]| refusal(Spline::new(axes, values));
    let (four, three) = (Axis::new(&points)?, Axis::new(&points[..3])?);
    let two = "axis 1 has 3 points, and at least 4 are expected";
    assert_eq!(said([four.clone(), three], &[0.0; 12]), two);
    assert_eq!(
        refusal(Spline::quintic([four.clone()], &[0.0; 4])),
        "axis 0 has 4 points, and at least 6 are expected"
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
    let alternating: Vec<f64> = (0..16).map(|k| if k % 3 == 0 { 1.7e308 } else { -1.7e308 }).collect();
    assert_eq!(
        said([four.clone(), four], &alternating),
        "a coefficient of the spline is not finite: the values are too large or the distances on an axis \
         too unequal"
    );
    let many = Axis::uniform([0.0, 1.0], 100_000)?;
    let huge = Spline::sample([many.clone(), many.clone(), many.clone(), many], |_| 0.0);
    assert_eq!(refusal(huge), "the grid has more points than there can be memory for");
    Ok(())
}

/// Whether a number in [0, 1) is below this one.
fn rarely(numbers: &mut Numbers, part: f64) -> bool {
    numbers.between([0.0, 1.0]) < part
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
    let odd_one = |numbers: &mut Numbers| odd[numbers.between([0.0, 14.0]) as usize];
    for _ in 0..4000 {
        let mut any_axis = || {
            let count = numbers.between([0.0, 12.0]) as usize;
            let size = 10_f64.powf(numbers.between([-20.0, 20.0]));
            let ratio = 10_f64.powf(numbers.between([-2.0, 2.0]));
            let mut at = numbers.next() * size * numbers.between([0.0, 1.0]);
            let mut step = numbers.between([0.0, size]);
            let mut points = Vec::new();
            for _ in 0..count {
                points.push(if rarely(&mut numbers, 0.002) { odd_one(&mut numbers) } else { at });
                at += step;
                step *= if rarely(&mut numbers, 0.5) { 1.0 } else { ratio };
            }
            let period =
                if rarely(&mut numbers, 0.1) { 1.0 } else { (at - points.first().unwrap_or(&0.0)).abs() };
            if rarely(&mut numbers, 0.5) { Axis::new(&points) } else { Axis::periodic(&points, period) }
        };
        let (Ok(first), Ok(second)) = (any_axis(), any_axis()) else {
            refused += 1;
            continue;
        };
        let mut numbers = Numbers(made + refused);
        let mut value = |_: [f64; 2]| {
            if rarely(&mut numbers, 0.001) { odd_one(&mut numbers) } else { numbers.between([0.0, 1.0]) }
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

/// Evaluates a spline at many places, among them all lines of its grid and their neighbours. Inside, the
/// value is known.
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
        let inside =
            [x, y].iter().zip(domain).all(|(x, (from, to))| x.is_finite() && from <= *x && *x <= to);
        assert_eq!(there.value.is_nan(), !inside, "{x} {y} {domain:?} {there:?}");
    }
}
