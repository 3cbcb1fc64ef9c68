//! Vectors beside the same in components: the same numbers, under other names.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::record::Record;
use dvi_core::rotations;
use dvi_tests::Outcome;

/// Bodies in space that attract each other.
#[lagrangian(
    coordinates(r[N][3]),
    lagrangian = sum(0..N, |i| m[i] / 2.0 * dot(r[i]).norm_squared())
        + sum_pairs(0..N, |i, j| m[i] * m[j] / (r[i] - r[j]).norm()),
    momenta(l_z = sum(0..N, |i| m[i] * r[i].cross(dot(r[i])))[2]),
)]
struct Bodies<const N: usize> {
    m: [f64; N],
}

/// The same in components.
#[lagrangian(
    coordinates(x[N], y[N], z[N]),
    lagrangian = sum(0..N, |i| m[i] / 2.0 * (dot(x[i]).powi(2) + dot(y[i]).powi(2) + dot(z[i]).powi(2)))
        + sum_pairs(0..N, |i, j| m[i] * m[j]
            / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + (z[i] - z[j]).powi(2)).sqrt()),
    momenta(l_z = sum(0..N, |i| m[i] * (x[i] * dot(y[i]) - y[i] * dot(x[i])))),
)]
struct InComponents<const N: usize> {
    m: [f64; N],
}

/// The same with a number of bodies that the run knows, in a field along the third axis.
#[lagrangian(
    coordinates(r[m.len()][3]),
    lagrangian = sum(0..m.len(), |i| m[i] / 2.0 * dot(r[i]).norm_squared() + field.dot(r[i].cross(dot(r[i]))))
        + sum_pairs(0..m.len(), |i, j| m[i] * m[j] / (r[i] - r[j]).norm()),
    force(r) = |i| drag[i] / m[i] - dot(r[i]),
)]
struct InField {
    m: Vec<f64>,
    field: [f64; 3],
    drag: Vec<[f64; 3]>,
}

const MASSES: [f64; 3] = [1.0, 0.5, 0.25];

fn start() -> BodiesState<3> {
    BodiesState {
        r: [[0.0, 0.1, 0.2], [2.0, 0.3, -0.4], [-1.5, 1.0, 0.7]],
        dot_r: [[0.0, 0.01, 0.02], [0.1, 0.5, 0.2], [-0.3, -0.4, 0.1]],
    }
}

fn column(vectors: &[[f64; 3]; 3], axis: usize) -> [f64; 3] {
    vectors.map(|vector| vector[axis])
}

#[test]
fn bodies_move_as_their_components_do() -> Outcome {
    let BodiesState { r, dot_r } = start();
    let [x, y, z] = [0, 1, 2].map(|axis| column(&r, axis));
    let [dot_x, dot_y, dot_z] = [0, 1, 2].map(|axis| column(&dot_r, axis));
    let components = InComponentsState { x, y, z, dot_x, dot_y, dot_z };
    let (of_vectors, of_components) = (Bodies { m: MASSES }, InComponents { m: MASSES });
    let mut run = Integrator::new(&of_vectors, Variational::trapezoid(), 0.01, start())?;
    let mut other = Integrator::new(&of_components, Variational::trapezoid(), 0.01, components)?;
    run.take_steps(500)?;
    other.take_steps(500)?;
    assert_eq!(run.q(), other.q());
    let (found, expected) = (run.state(), other.state());
    assert_eq!(column(&found.r, 1), expected.y);
    assert_eq!(column(&found.dot_r, 2), expected.dot_z);
    assert_eq!(run.momentum(0), other.momentum(0));
    Ok(())
}

#[test]
fn entries_have_names_body_by_body() -> Outcome {
    let system = Bodies { m: MASSES };
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    assert_eq!(names[..4], ["r[0].x", "r[0].y", "r[0].z", "r[1].x"]);
    assert_eq!(names[17], "dot_r[2].z");
    let values: Vec<f64> = system.values(&start())?.collect();
    let BodiesState { r, dot_r } = start();
    assert_eq!(values, [r.as_flattened(), dot_r.as_flattened()].concat());
    assert_eq!(Bodies::<3>::REPORT.coordinates[2].name, "r");
    assert!(Bodies::<3>::REPORT.to_string().contains("r[N][3]"));
    Ok(())
}

#[test]
fn a_table_of_bodies_is_read_body_by_body() -> Outcome {
    let system = Bodies { m: MASSES };
    let head: Vec<String> = system.names().map(|name| name.to_string()).collect();
    let row: Vec<String> = system.values(&start())?.map(|value: f64| value.to_string()).collect();
    let table = Record::read_csv(format!("{}\n{}\n", head.join(","), row.join(",")).as_bytes())?;
    assert_eq!(table.states(&system)?, [start()]);
    Ok(())
}

/// A spin in a field that its body holds.
#[lagrangian(
    coordinates(R: SO3, s: S2),
    lagrangian = inertia.dot([omega(R)[0].powi(2), omega(R)[1].powi(2), omega(R)[2].powi(2)]) / 2.0
        + dot(s).norm_squared() / 2.0 + s.dot(R.column(2)) + omega(R).dot(bias),
)]
struct Spin {
    inertia: [f64; 3],
    bias: [f64; 3],
}

#[test]
fn unit_vectors_and_axes_of_bodies_are_vectors() -> Outcome {
    let system = Spin { inertia: [2.0, 3.0, 4.0], bias: [0.5, 0.0, 1.0] };
    let (omega, s, v) = ([0.1, 0.2, 0.3], [0.6, 0.0, 0.8], [0.0, 0.5, 0.0]);
    let state = SpinState { R: rotations::exp([0.4, 0.0, 0.0]), s, omega_R: omega, dot_s: v };
    let axis = [0.0, -0.4_f64.sin(), 0.4_f64.cos()];
    let product = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let kinetic = product(system.inertia, omega.map(|entry| entry * entry)) / 2.0 + product(v, v) / 2.0;
    let expected = kinetic + product(s, axis) + product(omega, system.bias);
    let (mut q, mut v) = (vec![0.0; 12], vec![0.0; 12]);
    state.write(|block| system.block_len(block), &mut q, &mut v)?;
    assert!((system.lagrangian(&q, &v, 0.0) - expected).abs() < 1e-14);
    Ok(())
}

#[test]
fn the_number_of_bodies_may_be_known_late() -> Outcome {
    let system = InField { m: MASSES.into(), field: [0.0, 0.0, 2.0], drag: vec![[0.1, 0.2, 0.3]; 3] };
    let BodiesState { r, dot_r } = start();
    let state = InFieldState { r: r.into(), dot_r: dot_r.into() };
    // v · (b × r), with the field b.
    let potential: f64 = r.iter().zip(&dot_r).map(|(r, v)| 2.0 * (r[0] * v[1] - r[1] * v[0])).sum();
    let without = Bodies { m: MASSES }.lagrangian_at(0.0, &start())?;
    assert!((system.lagrangian_at(0.0, &state)? - without - potential).abs() < 1e-14);
    let run = Integrator::new(&system, Variational::midpoint(), 0.01, state.clone())?;
    assert_eq!(run.state(), state);
    let short = InFieldState { r: state.r[1..].to_vec(), ..state };
    let error = Integrator::new(&system, Variational::midpoint(), 0.01, short).map(|_| ());
    assert!(error.is_err_and(|error| error.to_string().contains("`r`")));
    Ok(())
}

/// Bodies in a field, axis by axis.
#[lagrangian(
    coordinates(r[n][3]),
    lagrangian = sum(0..n, |i| sum(0..3, |k| m[k] / 2.0 * dot(r[i][k]).powi(2) + b[k] * dot(r[i])[k])
        - product(0..=2, |k| 1.0 + r[i][k].powi(2))
        - sum(0..3, |k| sum(0..3, |l| h[k][l] * r[i][k] * r[i][l]))),
)]
struct AxisByAxis {
    n: usize,
    m: [f64; 3],
    b: [f64; 3],
    h: [[f64; 3]; 3],
}

/// The same with its terms written out.
#[lagrangian(
    coordinates(r[n][3]),
    lagrangian = sum(0..n, |i| m[0] / 2.0 * dot(r[i][0]).powi(2) + b[0] * dot(r[i])[0]
        + (m[1] / 2.0 * dot(r[i][1]).powi(2) + b[1] * dot(r[i])[1])
        + (m[2] / 2.0 * dot(r[i][2]).powi(2) + b[2] * dot(r[i])[2])
        - (1.0 + r[i][0].powi(2)) * (1.0 + r[i][1].powi(2)) * (1.0 + r[i][2].powi(2))
        - ([h[0][0], h[0][1], h[0][2]].dot(r[i]) * r[i][0] + [h[1][0], h[1][1], h[1][2]].dot(r[i]) * r[i][1]
            + [h[2][0], h[2][1], h[2][2]].dot(r[i]) * r[i][2])),
)]
struct TermByTerm {
    n: usize,
    m: [f64; 3],
    b: [f64; 3],
    h: [[f64; 3]; 3],
}

#[test]
fn sums_run_over_components() -> Outcome {
    let (m, b, h) =
        ([1.0, 2.0, 0.5], [0.3, -0.2, 0.1], [[1.0, 0.2, 0.1], [0.2, 2.0, -0.3], [0.1, -0.3, 0.7]]);
    let (r, dot_r) = (vec![[0.1, 0.4, -0.3], [0.7, 0.2, 0.5]], vec![[0.2, 0.0, 0.5], [-0.1, 0.3, 0.4]]);
    let start = AxisByAxisState { r: r.clone(), dot_r: dot_r.clone() };
    let mut run = Integrator::new(AxisByAxis { n: 2, m, b, h }, Gauss::<2>::new(), 0.05, start)?;
    let start = TermByTermState { r, dot_r };
    let mut other = Integrator::new(TermByTerm { n: 2, m, b, h }, Gauss::<2>::new(), 0.05, start)?;
    run.take_steps(200)?;
    other.take_steps(200)?;
    assert_abs_diff_eq!(run.q(), other.q(), epsilon = 1e-11);
    assert_abs_diff_eq!(&*run.v(), &*other.v(), epsilon = 1e-11);
    Ok(())
}
