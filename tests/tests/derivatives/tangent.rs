//! Derivatives along rotations: each body and each unit vector is turned by two angles, dual numbers in a
//! formula written in components, against what gradient and second derivatives of the generated functions
//! make of the curve.

// Rotations are called R.
#![allow(non_snake_case)]

use dvi_core::prelude::*;
use dvi_core::{Lagrangian, Space, System, Weights};
use dvi_tests::filling;
use num_dual::HyperDual64;

use crate::derivatives::oracle::{Number, Random, expanded};

/// The bodies, and the unit vectors.
const N: usize = 2;

/// Bodies and unit vectors that turn each other, beside a number.
#[lagrangian(
    coordinates(x, R[2]: SO3, s[2]: S2, P: SO3),
    lagrangian = sum(0..2, |i| m[i] * omega(R[i]).norm_squared() + dot(s[i]).norm_squared()) / 2.0
        + (dot(x).powi(2) + omega(P).norm_squared()) / 2.0
        + sum(0..2, |i| sum(0..2, |j| (R[i].column(1).dot(s[j]) + x).powi(3) * omega(R[i])[2]))
        - sum_pairs(0..2, |i, j| R[i].column(0).dot(R[j].column(2)) / (2.0 + s[i].dot(s[j])))
        - sum(0..2, |i| s[i].cross(P.column(0)).norm_squared() * dot(s[i]).dot(P.column(2)) + x * R[i][2][2]),
)]
#[derive(Debug)]
struct Turning {
    m: [f64; 2],
}

type Vector<D> = [D; 3];

fn dot<D: Number>(a: Vector<D>, b: Vector<D>) -> D {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A matrix, row by row.
type Matrix<D> = [[D; 3]; 3];

fn column<D: Number>(matrix: &Matrix<D>, number: usize) -> Vector<D> {
    matrix.map(|row| row[number])
}

fn product<D: Number>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    a.map(|row| [0, 1, 2].map(|k| dot(row, column(b, k))))
}

/// The rotation by an angle about a coordinate axis.
fn about<D: Number>(axis: usize, angle: D) -> Matrix<D> {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = [[D::zero(); 3]; 3];
    matrix[axis][axis] = D::one();
    (matrix[j][j], matrix[k][k]) = (angle.cos(), angle.cos());
    (matrix[k][j], matrix[j][k]) = (angle.sin(), -angle.sin());
    matrix
}

/// A point, each kind of coordinate by itself.
#[derive(Clone, Copy)]
struct Point<D> {
    x: D,
    bodies: [Matrix<D>; N],
    vectors: [Vector<D>; N],
    single: Matrix<D>,
}

impl<D: Number> Point<D> {
    /// Each turned about two axes, one after the other: bodies in their own axes, vectors in those of space.
    fn turned(self, [first, second]: [(usize, D); 2]) -> Self {
        let turn = product(&about(first.0, first.1), &about(second.0, second.1));
        Self {
            x: self.x + first.1,
            bodies: self.bodies.map(|body| product(&body, &turn)),
            vectors: self.vectors.map(|vector| turn.map(|row| dot(row, vector))),
            single: product(&self.single, &turn),
        }
    }

    /// In the order of the flat state: arrays entry by entry of a matrix or vector.
    fn flat(&self) -> Vec<D> {
        let bodies = (0..9).flat_map(|entry| self.bodies.map(|body| body[entry / 3][entry % 3]));
        let vectors = (0..3).flat_map(|entry| self.vectors.map(|vector| vector[entry]));
        let single = self.single.into_iter().flatten();
        [self.x].into_iter().chain(bodies).chain(vectors).chain(single).collect()
    }

    fn of(point: Point<f64>) -> Self {
        let lift = |matrix: Matrix<f64>| matrix.map(|row| row.map(D::from));
        Self {
            x: D::from(point.x),
            bodies: point.bodies.map(lift),
            vectors: point.vectors.map(|vector| vector.map(D::from)),
            single: lift(point.single),
        }
    }
}

/// L in components.
fn by_hand<D: Number>(m: [f64; N], point: &Point<D>, v: &[f64]) -> D {
    let Point { x, bodies, vectors, single } = point;
    let number = |value: f64| D::from(value);
    let omega = |i: usize| [v[1 + i], v[3 + i], v[5 + i]].map(number);
    let rate = |i: usize| [v[19 + i], v[21 + i], v[23 + i]].map(number);
    let spin = [v[25], v[26], v[27]].map(number);
    let mut sum = (number(v[0] * v[0]) + dot(spin, spin)) / 2.0;
    for i in 0..N {
        sum += (dot(omega(i), omega(i)) * m[i] + dot(rate(i), rate(i))) / 2.0;
        for j in 0..N {
            let pull = dot(column(&bodies[i], 1), vectors[j]) + *x;
            sum += pull * pull * pull * omega(i)[2];
        }
        let ([a, b, c], [d, e, f]) = (vectors[i], column(single, 0));
        let cross = [b * f - c * e, c * d - a * f, a * e - b * d];
        sum -= dot(cross, cross) * dot(rate(i), column(single, 2)) + *x * bodies[i][2][2];
    }
    let between = dot(vectors[0], vectors[1]) + 2.0;
    sum - dot(column(&bodies[0], 0), column(&bodies[1], 2)) / between
}

fn random_point(random: &mut Random) -> Point<f64> {
    let mut rotation = || {
        let [a, b, c] = [0; 3].map(|_| random.between(-3.0, 3.0));
        product(&product(&about(2, a), &about(0, b)), &about(2, c))
    };
    let (bodies, single) = ([rotation(), rotation()], rotation());
    let vectors = [column(&rotation(), 0), column(&rotation(), 1)];
    Point { x: random.between(-1.0, 1.0), bodies, vectors, single }
}

#[test]
fn derivatives_by_angles_are_those_of_the_entries() {
    let system = Turning { m: [1.3, 0.7] };
    assert_eq!(system.check(), Ok(()));
    let n = system.space().dimension();
    let mut random = Random::new(4);
    for axes in (0..45).map(|trial| [trial % 3, (trial / 3) % 3]) {
        let point = random_point(&mut random);
        let (q, v) = (point.flat(), random.several(n, -1.0, 1.0));
        let turned =
            |angles: &[HyperDual64]| Point::of(point).turned([(axes[0], angles[0]), (axes[1], angles[1])]);
        let wanted = expanded(&[0.0; 2], &|angles| by_hand(system.m, &turned(angles), &v));

        let (mut l_q, mut l_v, mut matrix) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * n]);
        let weights = Weights { qq: 1.0, qv: 0.0, vq: 0.0, vv: 0.0 };
        system.linearize(&q, &v, 0.0, weights, &mut l_q, &mut l_v, &mut filling(&mut matrix, n));
        // The entries along the curve, with their derivatives.
        let [one, zero] = [1.0, 0.0];
        let curve =
            turned(&[HyperDual64::new(0.0, one, zero, zero), HyperDual64::new(0.0, zero, one, zero)]).flat();
        let along = |of: fn(&HyperDual64) -> f64| curve.iter().map(of).collect::<Vec<f64>>();
        let [first, second, both] = [along(|x| x.eps1), along(|x| x.eps2), along(|x| x.eps1eps2)];
        let contracted = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let rows: Vec<f64> = matrix.chunks(n).map(|row| contracted(row, &second)).collect();
        let mixed = contracted(&first, &rows) + contracted(&l_q, &both);
        let found =
            [system.lagrangian(&q, &v, 0.0), contracted(&l_q, &first), contracted(&l_q, &second), mixed];
        let wanted = [wanted.value, wanted.gradient[0], wanted.gradient[1], wanted.hessian[1]];
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12 * (10.0 + wanted.abs()), "{found} for {wanted}");
        }
    }
}
