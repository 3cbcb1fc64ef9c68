//! Vectors: the names of their entries, and their number at run time.

use dvi_core::prelude::*;
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
