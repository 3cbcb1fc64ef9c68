//! The energy of a nonholonomic run may drift, however regular its steps are.

use dvi_core::prelude::*;

use dvi_tests::Outcome;

/// A sleigh on a blade that stands off its axis, in a valley: the blade turns as it slides.
#[lagrangian(
    coordinates(x, y, th),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 0.25 * dot(th).powi(2)
        - (x * x + 2.0 * y * y) / 2.0
        - 0.5 * (th - 0.3 * x).cos(),
    nonholonomic = dot(y) * th.cos() - dot(x) * th.sin() - 0.4 * dot(th),
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh;

const NEAR: SleighState = SleighState { x: 0.8, y: 0.3, th: 0.4, dot_x: 0.5, dot_y: 0.2, dot_th: 0.3 };

/// What the energy has lost after a time of 2500 and of 5000, on the average of four motions: rounding
/// errors decide what one of them loses.
fn lost(h: f64) -> Outcome<[f64; 2]> {
    const MOTIONS: u32 = 4;
    let mut mean = [0.0; 2];
    for k in 0..MOTIONS {
        let near = SleighState { x: NEAR.x + 0.05 * f64::from(k), ..NEAR };
        let start = Sleigh.projected(0.0, &near)?;
        let mut run = Integrator::new(&Sleigh, Constrained::new(Midpoint), h, start)?;
        let begin = run.energy();
        assert!(k > 0 || (begin - 1.0647).abs() < 1e-4, "{begin}");
        for mean in &mut mean {
            run.take_steps((2500.0 / h).round() as u64)?;
            *mean += (begin - run.energy()) / f64::from(MOTIONS);
        }
    }
    Ok(mean)
}

#[test]
fn the_energy_of_a_chaotic_motion_drifts() -> Outcome {
    let [rough, fine] = [lost(0.1)?, lost(0.05)?];
    assert!(rough[0] > 0.02 && rough[1] > 1.5 * rough[0] && rough[1] < 0.2, "{rough:?}");
    assert!(fine[0] > 0.005 && fine[1] < 0.5 * rough[1], "{fine:?} {rough:?}");
    Ok(())
}

/// Two runs that begin 10⁻¹⁰ apart.
#[test]
fn the_motion_is_chaotic() -> Outcome {
    let method = Constrained::new(Midpoint);
    let start = Sleigh.projected(0.0, &NEAR)?;
    let near = Sleigh.projected(0.0, &SleighState { x: NEAR.x + 1e-10, ..NEAR })?;
    let mut one = Integrator::new(&Sleigh, method, 0.1, start)?;
    let mut other = Integrator::new(&Sleigh, method, 0.1, near)?;
    one.take_steps(20_000)?;
    other.take_steps(20_000)?;
    let apart = (one.state().x - other.state().x).hypot(one.state().y - other.state().y);
    assert!(apart > 0.01, "{apart}");
    Ok(())
}
