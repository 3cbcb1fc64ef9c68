//! Elimination beside nalgebra, of singular matrices, and in other units.

use super::{eliminate, eliminate_two, factor, factor_with_care, solve};
use crate::error::StepFailure;
use crate::space::linear::set_scales;
use crate::space::numbers;
use alloc::{vec, vec::Vec};
use nalgebra::{DMatrix, DVector};

/// So many entries in (−1, 1).
fn entries(count: usize, seed: u64) -> Vec<f64> {
    core::iter::repeat_with(numbers(seed)).take(count).collect()
}

#[test]
fn solutions_agree_with_nalgebra() {
    for n in 1..=12 {
        for seed in 0..20 {
            let matrix = entries(n * n, seed);
            let rhs = entries(n, seed + 1000);
            let reference = DMatrix::from_row_slice(n, n, &matrix);
            let expected = reference.clone().lu().solve(&DVector::from_column_slice(&rhs));
            let Some(expected) = expected else { panic!("nalgebra found no solution") };
            let condition = reference.clone().svd(false, false);
            let condition = condition.singular_values.max() / condition.singular_values.min();
            let (mut factors, mut permutation, mut x) = (matrix.clone(), vec![0; n], rhs.clone());
            assert_eq!(factor(&mut factors, &mut permutation), Ok(()));
            solve(&factors, &permutation, &mut x);
            let (mut consumed, mut y) = (matrix, rhs);
            assert_eq!(eliminate(&mut consumed, &mut [], &mut y), Ok(()));
            for found in [x, y] {
                let error = (DVector::from_column_slice(&found) - &expected).amax() / expected.amax();
                assert!(error < 1e-15 * n as f64 * condition, "n = {n}, seed {seed}: {error:e}");
            }
        }
    }
}

#[test]
fn two_equations_are_solved_alike() {
    for seed in 0..200 {
        let (matrix, rhs) = (entries(4, seed), entries(2, seed + 1000));
        // Some determinants vanish but for rounding, some products leave the range of numbers.
        let scale = [1.0, 1e-160, 1e160][seed as usize % 3];
        let matrix = if seed % 5 == 0 {
            [matrix[0], matrix[1], matrix[0] * (1.0 + 1e-9), matrix[1]]
        } else {
            [matrix[0], matrix[1], matrix[2], matrix[3]]
        };
        let scaled = matrix.map(|a| a * scale);
        let (mut consumed, mut x, mut y) = (scaled, [rhs[0], rhs[1]], [rhs[0], rhs[1]]);
        assert_eq!(eliminate(&mut consumed, &mut [], &mut x), Ok(()));
        assert_eq!(eliminate_two(&scaled, &[1.0; 2], &mut y), Some(Ok(())));
        let reference = DMatrix::from_row_slice(2, 2, &matrix).svd(false, false).singular_values;
        let (condition, size) = (reference.max() / reference.min(), x[0].abs().max(x[1].abs()));
        let error = (x[0] - y[0]).abs().max((x[1] - y[1]).abs()) / size;
        assert!(error < 4e-16 * condition, "seed {seed}: {x:?} and {y:?}");
    }
    assert_eq!(eliminate_two(&[1.0; 9], &[1.0; 3], &mut [1.0; 3]), None);
    let singular = eliminate_two(&[1.0, 2.0, 2.0, 4.0], &[1.0; 2], &mut [1.0; 2]);
    assert!(matches!(singular, Some(Err(StepFailure::Singular { column: 1, .. }))), "{singular:?}");
    let none = eliminate_two(&[f64::NAN, 1.0, 1.0, 1.0], &[1.0; 2], &mut [1.0, f64::NAN]);
    assert!(matches!(none, Some(Err(StepFailure::NotFinite { coordinate: 1, .. }))), "{none:?}");
}

/// An unknown times 2ᵘ, and its equation over 2ᵘ: the same rows are chosen, and the solution has the
/// same bits.
#[test]
fn units_change_no_bit() {
    let mut exchanged = 0;
    for seed in 0..400 {
        let n = [2, 2, 3, 5][seed as usize % 4];
        let (matrix, rhs, sizes) = (entries(n * n, seed), entries(n, seed + 1000), entries(n, seed + 2000));
        let units = entries(n, seed + 3000).iter().map(|u| (u * 60.0).round().exp2()).collect::<Vec<_>>();
        let solution = |units: &[f64]| {
            let mut matrix = matrix.clone();
            for (k, entry) in matrix.iter_mut().enumerate() {
                *entry /= units[k / n] * units[k % n];
            }
            let mut x: Vec<_> = rhs.iter().zip(units).map(|(b, u)| b / u).collect();
            let weights: Vec<_> = sizes.iter().zip(units).map(|(size, u)| 1.0 / (size.abs() * u)).collect();
            let mut scales = weights.clone();
            set_scales(&mut scales, &weights);
            let two = eliminate_two(&matrix, &weights, &mut x);
            let solved = two.unwrap_or_else(|| eliminate(&mut matrix, &mut scales, &mut x));
            assert_eq!(solved, Ok(()));
            x.iter().zip(units).map(|(x, u)| x / u).collect::<Vec<_>>()
        };
        assert_eq!(solution(&units), solution(&vec![1.0; n]), "{n} equations, seed {seed}, units {units:?}");
        let without = &mut rhs.clone();
        assert_eq!(eliminate(&mut matrix.clone(), &mut [], without), Ok(()));
        exchanged += usize::from(*without != solution(&units));
    }
    assert!(exchanged > 100, "{exchanged} of 400 are another sum in units of their own");
}

#[test]
fn singular_matrices_are_found_at_every_scale() {
    for scale in [1e-200, 1.0, 1e200] {
        let mut rank_two = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0].map(|a: f64| a * scale / 3.0);
        let by_elimination = eliminate(&mut rank_two.clone(), &mut [], &mut [1.0; 3]);
        let result = factor(&mut rank_two, &mut [0; 3]);
        assert_eq!(result, by_elimination);
        assert!(matches!(result, Err(StepFailure::Singular { column: 2, .. })), "{scale:e}: {result:?}");
        let mut regular = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0].map(|a: f64| a * scale / 3.0);
        assert_eq!(factor(&mut regular, &mut [0; 3]), Ok(()), "{scale:e}");
    }
}

#[test]
fn ranks_are_found_in_any_units() {
    let mut wrong = [0; 2];
    let mut kinds = [0; 2];
    for seed in 0..2000_u64 {
        let n = [2, 3, 4, 6, 10][seed as usize % 5];
        let rank = n - seed as usize / 5 % 2;
        // Bᵀ S B with rank rows and signs S, in units of powers of two.
        let (b, signs) = (entries(rank * n, seed), entries(rank, seed + 5000));
        let units: Vec<f64> = entries(n, seed + 9000).iter().map(|u| (u * 300.0).round().exp2()).collect();
        let mut matrix = vec![0.0; n * n];
        for (i, row) in matrix.chunks_exact_mut(n).enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let terms = (0..rank).map(|r| b[r * n + i] * b[r * n + j] * signs[r].signum());
                *entry = terms.sum::<f64>() * units[i] * units[j];
            }
        }
        let (mut x, mut y) = (vec![0.0; n], vec![0.0; n]);
        let found = factor_with_care(&mut matrix, &mut vec![0; n], [&mut x, &mut y]);
        let deficient = n - rank;
        kinds[deficient] += 1;
        wrong[deficient] += usize::from(found.is_ok() == (deficient == 1));
    }
    assert_eq!(wrong, [0, 0], "of {kinds:?} regular and singular matrices");
}

#[test]
fn a_matrix_that_is_not_finite_is_singular_and_not_an_answer() {
    let mut matrix = [f64::NAN, 1.0, 1.0, 1.0];
    assert!(matches!(factor(&mut matrix, &mut [0; 2]), Err(StepFailure::Singular { .. })));
}
