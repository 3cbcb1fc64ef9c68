//! Systems in which each part of the compiler has something to do.

/// Kind, attribute, struct.
pub(crate) const SYSTEMS: &[(&str, &str, &str)] = &[
    (
        "degenerate",
        "coordinates(x[N], y[N]),
         one_form = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
         hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
             * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
         momenta(angular = sum(0..N, |j| gamma[j] * (x[j].powi(2) + y[j].powi(2)))),
         events(passage = sum(0..N, |j| x[j] * y[j]) - t.sin())",
        "struct Vortices<const N: usize> { gamma: [f64; N] }",
    ),
    (
        "regular",
        "coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
         events(pericentre = x * dot(x) + y * dot(y))",
        "struct Kepler { mu: f64 }",
    ),
    (
        "regular",
        "coordinates(x[N]), lagrangian = sum(0..N, |j| (dot(x[j]) - 0.1 * sum(0..N, |k| dot(x[k]))).powi(2)) / 2.0
             - sum(0..N, |i| g[i]) * sum_pairs(0..N, |i, j| x[j].powi(2)) - sum_pairs(0..N, |i, j| g[i] * x[j].powi(2))",
        "struct Masses<const N: usize> { g: [f64; N] }",
    ),
    (
        "regular",
        "coordinates(x[3], u), lagrangian = sum(0..3, |j| dot(x[j]).powi(2)) + dot(u).powi(2)
             - sum_pairs(0..3, |i, j| k * (x[i] + x[j] - u).powi(2)) / 4 - sum(0..3, |i| 1 / (u + x[i])).powi(2)",
        "struct Springs { k: f64 }",
    ),
    (
        "regular",
        "coordinates(x, y), lagrangian = dot(x).powi(2) * (2.0 + y.cos()) + dot(y).powi(2) + (-x).sin() * y.tan()
             + x.powi(5) * y.powi(3) + if x > y * y { x.exp() } else { y * x } - 1.0 / (1.0 / (3.0 * x * y))",
        "struct Functions;",
    ),
    (
        "regular",
        "coordinates(x[4]), lagrangian = sum(0..4, |j| dot(x[j]).powi(2)) - product(0..4, |j| 2.0 + x[j] * x[(j + 1) % 4])
             - sum_ordered_pairs(0..4, |i, j| (x[i] * x[j]).atan())",
        "struct Ring;",
    ),
    (
        "degenerate",
        "coordinates(x, y), one_form = (y.ln() / x) * d(x) + t * x * d(y), hamiltonian = x + y - x.ln() - 2.0 * y.ln()",
        "struct Prey;",
    ),
    (
        "regular",
        "coordinates(x[N]), lagrangian = sum(0..N, |j| dot(x[j]).powi(2) / 2.0)
             + (sum(0..N, |j| x[j] * sum(0..j + 1, |k| x[k])).sqrt() * sum(0..N, |j| x[j] * g[j])).sin()",
        "struct Nested<const N: usize> { g: [f64; N] }",
    ),
    (
        "regular",
        "coordinates(x[N], y[M]), lagrangian = sum(0..N, |j| dot(x[j]).powi(2) * (1.0 + x[j] * x[j]))
             + sum(0..M, |j| dot(y[j]).powi(2) + y[j].sin())",
        "struct TwoSizes<const N: usize, const M: usize>;",
    ),
    (
        "regular",
        "coordinates(r[N][3], q[3]), lagrangian = {
             let gap = |i, j| r[i] - r[j];
             sum(0..N, |i| m[i] / 2.0 * dot(r[i]).norm_squared() + field.dot(r[i].cross(dot(r[i])))) + dot(q).norm_squared()
                 + sum_pairs(0..N, |i, j| m[i] * m[j] / gap(i, j).norm()) - sum(0..N, |i| (r[i] - q).norm_squared())
         },
         force(r) = |i| if t > 0.5 { -dot(r[i]) } else { field / m[i] }, force(q) = -2.0 * dot(q)",
        "struct Bodies<const N: usize> { m: [f64; N], field: [f64; 3] }",
    ),
    (
        "regular",
        "coordinates(x[4]), lagrangian = sum(0..4, |j| dot(x[j]).powi(2)),
         constraint(i in 0..2, j in i + 1..3) = x[i] * x[j] - x[3]",
        "struct Pairs;",
    ),
    // Powers that are differentiated as what they are.
    (
        "regular",
        "coordinates(x, y), lagrangian = {
             let r = (x * x + y * y).sqrt();
             dot(x).powi(2) + dot(y).powi(2) - k * (x * x + y * y).powf(2.5) - x * r - 3.0 * x.powi(2) * x.powf(1.5)
                 - y / (x * x + 2.0 * y * y).sqrt() - x / x.hypot(y) - y.hypot(3.0 * x).powi(3)
                 - ((1.0 - x) * (1.0 + x)).powi(3) * y.powi(40) - (x.powi(2) * 4.0).sqrt().powi(3) * r * r
         }",
        "struct Central { k: f64 }",
    ),
    (
        "degenerate",
        "coordinates(x, y), one_form = (x * x + 2.0 * y * y).sqrt() * d(y) - y.hypot(x) * x * d(x),
         hamiltonian = x.tanh() * y.abs() + x.atan2(y) * x.min(y * y) - x.max(2.0 * y).cosh() + (2.0 * x).erf()
             + 3.0f64.powf(y) * x.exp_m1() - (0.3 * x).asin() * y.cbrt()
             + ((x - 1.0) * (x + 1.0)).powi(2) * y + y.atan2(1.0) - x / (2.0 * x).hypot(y)",
        "struct Functions;",
    ),
    // Sums of constants, and over ranges that depend on one another.
    (
        "regular",
        "coordinates(x[N], u), lagrangian = sum(0..N, |j| dot(x[j]).powi(2) * (2.0 + sum(j..N, |k| x[k] * x[k - j])))
             + dot(u).powi(2) * sum(0..N, |j| 1.5) + sum(-1..2, |k| u.powi(2) * (k as f64))
             - product(0..N, |j| 1.0 + sum(0..N, |k| if x[k] > x[j] { x[j] * x[k] } else { u * x[j] }))
             - sum(0..N, |j| g[j] * u / (1.0 + x[j] * x[j])) / sum(0..N, |j| g[j] * x[j].exp())",
        "struct Ranges<const N: usize> { g: [f64; N] }",
    ),
    (
        "degenerate",
        "coordinates(q[n], p[n], w), one_form = sum(0..n, |j| (p[j] + t * q[j] * w) * d(q[j])) + w * q[0] * d(p[0]),
         hamiltonian = sum(0..n, |j| p[j] * p[j] / (2.0 * m[j]) + own(q[(j + 1) % n] - q[j]) * (w * t).cos())
             + sum_ordered_pairs(0..n, |j, k| own(q[j] * p[k]) / (w - 1.0)) + w.sqrt() * own(w),
         momenta(total = sum(0..n, |j| p[j]), product = w * sum(0..n, |j| q[j] * p[j])), functions(own = [f, df, d2f])",
        "struct Chain { n: usize, m: Vec<f64> }",
    ),
    (
        "degenerate",
        "coordinates(q[n], p[n]), one_form = sum(0..n, |j| 0.5 * (p[j] * d(q[j]) - q[j] * d(p[j]))),
         hamiltonian = sum(0..n, |j| p[j] * p[j] / (2.0 * m[j])) + sum(0..n, |j| q[j] * q[(j + 1) % n]),
         gauge = sum(0..n, |j| 0.5 * q[j] * p[j]) + sum(1..n, |j| q[j].powi(3) * t) + (q[0] * t).sin() * sum_pairs(0..n, |j, k| q[j] * p[k])",
        "struct Gauged { n: usize, m: Vec<f64> }",
    ),
    (
        "degenerate",
        "coordinates(x, y), one_form = y * (x * x + 1.0) * d(x) + (x * y).exp() * x.powi(2) * y * d(y) + x / y * d(y),
         hamiltonian = x * x + y * y, gauge = auto",
        "struct Sought {}",
    ),
    (
        "degenerate",
        "coordinates(x[n], y[n]), one_form = sum(0..n, |j| psi(x[j], y[j], t) * d(x[j])),
         hamiltonian = sum(0..n, |j| psi(y[j], x[j] * x[j], 1.0).powi(2)) + sum_pairs(0..n, |j, k| well(x[j] - x[k], y[k])),
         functions(well = some::WELL)",
        "struct Tables<F> { n: usize, psi: F }",
    ),
    (
        "degenerate",
        "coordinates(x, y), lagrangian = y * (1.0 + y * y) * dot(x) - (x * x + y * y) / 2.0 - x * t.sin(),
         gauge = x * x * y * t, time_transform = 1.0 / (1.0 + x * x + t * t * y * y)",
        "struct Extended;",
    ),
    // Forces, in lists and one by one.
    (
        "regular",
        "coordinates(x[n], y), lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0) + (1.0 + y * y) * dot(y).powi(2),
         force = [|i| -c[i] * dot(x[i]) * (1.0 + dot(y).powi(2)) + x[(i + 1) % n] * t, sum(0..n, |j| dot(x[j]) * x[j] * y)]",
        "struct Dragged { n: usize, c: Vec<f64> }",
    ),
    (
        "regular",
        "coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - x * x * y, force(y) = -c * dot(y) * x",
        "struct Friction { c: f64 }",
    ),
    (
        "degenerate",
        "coordinates(q[N], p[N]), one_form = sum(0..N, |j| p[j] * d(q[j])), hamiltonian = sum(0..N, |j| p[j].powi(2) + q[j].cos()),
         force(p) = |k| q[k] * q[(k + 1) % N], force(q) = |j| -g * p[j] * q[j].exp() + t.sin()",
        "struct Driven<const N: usize> { g: f64 }",
    ),
    // Constraints: with the time, a list, and families whose sums stand inside of their loops.
    (
        "regular",
        "coordinates(x, y, z), lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - y,
         constraint = [x * x + (y - t.sin()).powi(2) - l * l, x * y.exp() * z * t * t]",
        "struct Pendulum { l: f64 }",
    ),
    (
        "regular",
        "coordinates(x[n], y[n], w), lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0 + dot(w).powi(2),
         constraint = w - sum(0..n, |j| x[j] * y[j]),
         constraint(i in 0..n - 1) = (x[i + 1] - x[i]).powi(2) + y[i].powi(3) * y[i + 1] * t - l[i],
         constraint(k in 1..n) = sum(k..n, |j| x[j] * (y[k] * w).sin() * t)",
        "struct Chain { n: usize, l: Vec<f64> }",
    ),
    // Constraints of the velocities, alike.
    (
        "regular",
        "coordinates(x[n], y[n], w), lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0 + dot(w).powi(2),
         nonholonomic = [dot(w) - sum(0..n, |j| x[j] * dot(y[j])), w * t.sin() * dot(w) + x[0]],
         nonholonomic(i in 1..n) = dot(x[i]) * (l[i] + w * t).sin() - dot(y[i - 1]) * (l[i] + w * t).cos()",
        "struct Train { n: usize, l: Vec<f64> }",
    ),
];
