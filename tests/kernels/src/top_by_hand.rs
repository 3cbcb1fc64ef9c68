//! The trapezoidal rule on SO(3) for a symmetric top, L = (A(ω₁² + ω₂²) + C ω₃²)/2 − weight R₃₃, by hand,
//! with the criterion of the library. Forces are those of the two ends: the equations for the rotation
//! vector u, J(−u)⁻¹ 𝕀u/h = p0 + (h/2)f0, hold none.

use super::predators_by_hand::Tolerance;

type Vector = [f64; 3];

pub(crate) struct Top {
    h: f64,
    inertia: Vector,
    weight: f64,
    /// A quaternion of the rotation.
    attitude: [f64; 4],
    p: Vector,
    torque: Vector,
    /// The rotation vectors of the last two steps.
    last: [Vector; 2],
}

impl Top {
    pub(crate) fn new(h: f64, (inertia, weight): (Vector, f64), attitude: [f64; 4], omega: Vector) -> Self {
        let p = [0, 1, 2].map(|k| inertia[k] * omega[k]);
        let torque = torque(weight, attitude);
        Self { h, inertia, weight, attitude, p, torque, last: [omega.map(|omega| h * omega); 2] }
    }

    /// R₃₃
    pub(crate) fn height(&self) -> f64 {
        third_row(self.attitude)[2]
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let Self { h, inertia, weight, attitude, p, torque: f, last: [last, before] } = *self;
        let p = add(p, 0.5 * h, f);
        let mut u = [0, 1, 2].map(|k| 2.0 * last[k] - before[k]);
        let mut tolerance = Tolerance::new(1.0 + largest(u));
        loop {
            let g = [0, 1, 2].map(|k| inertia[k] * u[k] / h);
            let (residual, matrix) = equations(u, g, inertia.map(|moment| moment / h));
            let change = solve(matrix, [0, 1, 2].map(|k| residual[k] - p[k]));
            u = add(u, -1.0, change);
            if tolerance.is_met(largest(change)) {
                break;
            }
        }
        let attitude = turned(attitude, u);
        let torque = torque(weight, attitude);
        let p = add(carried(p, u), 0.5 * h, torque);
        *self = Self { attitude, p, torque, last: [u, last], ..*self };
    }
}

/// J(−u)⁻¹g with its derivative by u, where g is a diagonal matrix `moments` times u.
#[inline(always)]
fn equations(u: Vector, g: Vector, moments: Vector) -> (Vector, [Vector; 3]) {
    let square = dot(u, u);
    // (1 − (θ/2) cot(θ/2))/θ² and its derivative by θ².
    let (mut b, mut slope) = (0.0, 0.0);
    for coefficient in COTANGENT {
        slope = b + square * slope;
        b = coefficient + square * b;
    }
    let once = cross(u, g);
    let twice = cross(u, once);
    let value = [0, 1, 2].map(|k| g[k] + 0.5 * once[k] + b * twice[k]);
    let along = dot(u, g);
    let (g_hat, u_hat) = (hat(g), hat(u));
    let matrix = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let identity = if i == j { 1.0 } else { 0.0 };
            let by_g = identity + 0.5 * u_hat[i][j] + b * (u[i] * u[j] - square * identity);
            let by_u = -0.5 * g_hat[i][j]
                + b * (u[i] * g[j] + along * identity - 2.0 * g[i] * u[j])
                + 2.0 * slope * twice[i] * u[j];
            by_g * moments[j] + by_u
        })
    });
    (value, matrix)
}

/// |B₂ₖ|/(2k)!, the last first: enough for θ² ≤ 1.
const COTANGENT: [f64; 11] = [
    77683.0 / 14_101_100_039_391_805_440_000.0,
    174_611.0 / 802_857_662_698_291_200_000.0,
    43867.0 / 5_109_094_217_170_944_000.0,
    3617.0 / 10_670_622_842_880_000.0,
    1.0 / 74_724_249_600.0,
    691.0 / 1_307_674_368_000.0,
    1.0 / 47_900_160.0,
    1.0 / 1_209_600.0,
    1.0 / 30240.0,
    1.0 / 720.0,
    1.0 / 12.0,
];

/// exp(−û) p
#[inline(always)]
fn carried(p: Vector, u: Vector) -> Vector {
    let theta = dot(u, u).sqrt();
    let (sine, cosine) = theta.sin_cos();
    let (a, b) = if theta > 0.0 { (sine / theta, (1.0 - cosine) / (theta * theta)) } else { (1.0, 0.5) };
    let once = cross(u, p);
    let twice = cross(u, once);
    [0, 1, 2].map(|k| p[k] - a * once[k] + b * twice[k])
}

/// The product with the quaternion of exp(û).
#[inline(always)]
fn turned([w, x, y, z]: [f64; 4], u: Vector) -> [f64; 4] {
    let half = 0.5 * dot(u, u).sqrt();
    let (sine, cosine) = half.sin_cos();
    let factor = if half > 0.0 { 0.5 * sine / half } else { 0.5 };
    let [a, b, c] = u.map(|u| factor * u);
    [
        w * cosine - x * a - y * b - z * c,
        w * a + x * cosine + y * c - z * b,
        w * b + y * cosine + z * a - x * c,
        w * c + z * cosine + x * b - y * a,
    ]
}

#[inline(always)]
fn third_row([w, x, y, z]: [f64; 4]) -> Vector {
    let scale = 2.0 / (w * w + x * x + y * y + z * z);
    [scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y)]
}

/// −weight (∂R₃₃ by a turn in the body)
#[inline(always)]
fn torque(weight: f64, attitude: [f64; 4]) -> Vector {
    let [x, y, _] = third_row(attitude);
    [weight * y, -weight * x, 0.0]
}

#[inline(always)]
fn solve([a, b, c]: [Vector; 3], right: Vector) -> Vector {
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, columns[0]);
    [0, 1, 2].map(|k| (0..3).map(|row| right[row] * columns[row][k]).sum::<f64>() / determinant)
}

#[inline(always)]
fn hat([x, y, z]: Vector) -> [Vector; 3] {
    [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
}

#[inline(always)]
fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn add(a: Vector, factor: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + factor * b[k])
}

#[inline(always)]
fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn largest(a: Vector) -> f64 {
    a.into_iter().map(f64::abs).fold(0.0, f64::max)
}
