//! The same results, bit for bit, for every number of threads, of lanes and of shards, and with an
//! interruption at each look.

use std::fmt::Debug;
use std::time::Duration;

use dvi_core::ensemble::{Ensemble, EnsembleError, Results, Shard};
use dvi_core::prelude::*;
use dvi_tests::systems::{PointVortices, PointVorticesState};

use crate::ensemble::{Checked, HenonHeiles, LEFT, bytes, file, left, planets, wells};

/// An ensemble, or the same in lanes.
type Changed<'a, S, M> = fn(Ensemble<'a, S, M>) -> Ensemble<'a, S, M>;

/// The results of an ensemble, which are the same however they are computed.
fn same<'a, S, M>(
    name: &str,
    steps: u64,
    ensemble: impl Fn() -> Ensemble<'a, S, M> + Sync,
    in_lanes: &[Changed<'a, S, M>],
) -> Result<Results, Box<dyn std::error::Error>>
where
    S: Lagrangian + Debug + Sync + 'a,
    S::State<f64>: Sync,
    M: Method<S, f64> + Clone + Debug + Sync,
{
    let whole = ensemble().take_steps(steps)?;
    let expected = bytes(&whole)?;
    let is_same = |results: &Results| Ok::<_, Box<dyn std::error::Error>>(bytes(results)? == expected);
    let alone: Changed<'a, S, M> = |ensemble| ensemble;
    for (number, changed) in [&[alone], in_lanes].concat().into_iter().enumerate() {
        // In lanes it is one number of threads and one of shards after the other.
        let asked = |all: &[u64]| if number == 0 { all.to_vec() } else { vec![all[number % all.len()]] };
        for threads in asked(&[1, 2, 3, 7]) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build()?;
            let results = pool.install(|| changed(ensemble()).take_steps(steps))?;
            assert!(is_same(&results)?, "{name}: {threads} threads");
        }
        for of in asked(&[1, 3, 50]) {
            let shard = |index| Ok(changed(ensemble()).shard(Shard::new(index, of)?).take_steps(steps)?);
            // In any order.
            let shards = (0..of).rev().map(shard).collect::<Result<Vec<_>, Box<dyn std::error::Error>>>()?;
            assert!(is_same(&Results::merge(shards)?)?, "{name}: {of} shards");
        }
    }
    for changed in [Some(&alone), in_lanes.last()].into_iter().flatten() {
        let path = file(&format!("same-{name}.ckpt"));
        let interrupted = changed(ensemble()).checkpoints(&path, Duration::ZERO).take_steps(steps)?;
        assert!(is_same(&interrupted)?, "{name}: interrupted");
    }
    Ok(whole)
}

/// With limits members go alone, and without some fall without end, and fail where numbers end.
#[test]
fn of_wells_that_are_left() -> Checked {
    let free = || Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(45)).stride(149);
    let limited = same("limits", 1500, || free().until(LEFT, left), &[Ensemble::in_lanes::<8>])?;
    assert!(String::from_utf8_lossy(&bytes(&limited)?[0]).contains("left the well"));
    let lanes: [Changed<'_, _, _>; 3] =
        [Ensemble::in_lanes::<1>, Ensemble::in_lanes::<3>, Ensemble::in_lanes::<8>];
    let failing = same("failures", 1500, free, &lanes)?;
    assert!(String::from_utf8_lossy(&bytes(&failing)?[0]).contains("failed"));
    Ok(())
}

/// Implicit steps, with iterations that are counted.
#[test]
fn of_vortices() -> Checked {
    let system = PointVortices { gamma: [1.0, 2.0, -0.5] };
    let state = |k: u32| PointVorticesState { x: [-1.0, 0.01 * f64::from(k), 1.0], y: [0.0, 0.3, 0.1] };
    let lanes: [Changed<'_, _, _>; 1] = [Ensemble::in_lanes::<8>];
    for method in [Sigma::midpoint(), Sigma::leapfrog(), Sigma::new(0.3)] {
        let ensemble = || Ensemble::new(&system, method, 0.05, (0..21).map(state)).stride(23);
        let results = same("vortices", 100, ensemble, &lanes)?;
        assert!(results.members().iter().all(|member| member.momenta.len() == 3));
        let is_implicit = method != Sigma::leapfrog();
        assert!(results.members().iter().all(|member| (member.iterations > 0) == is_implicit));
    }
    Ok(())
}

/// Members of different systems, some of which fail: they are not packed, or packed with members that fail.
#[test]
fn beside_members_that_fail() -> Checked {
    let (systems, states) = planets(24);
    let mut equal = systems.clone();
    equal.fill(systems[0].clone());
    let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
    for systems in [&systems, &equal] {
        let of = || states.iter().cloned();
        let inner = || Ensemble::with_systems(systems, Variational::trapezoid(), 0.01, of());
        same("without a limit", 400, inner, &[Ensemble::in_lanes::<8>])?;
        same(
            "gauss",
            200,
            || Ensemble::with_systems(systems, Gauss::<3>::new(), 0.01, of()).stride(20),
            &[],
        )?;
        same("energy limit", 400, || Ensemble::with_systems(systems, method, 0.01, of()), &[])?;
    }
    Ok(())
}

/// Noise comes from the seed of each member.
#[test]
fn of_noise() -> Checked {
    let method = Langevin { friction: 1.0, temperature: 0.01, seed: 0 };
    let ensemble = || {
        let ensemble = Ensemble::new(&HenonHeiles, method, 0.05, [wells(1)[0]; 6]).stride(10);
        ensemble.vary_method(|number, method| method.seed = number)
    };
    let results = same("noise", 100, ensemble, &[])?;
    assert_ne!(results.members()[0].state, results.members()[1].state);
    let path = file("same-noise.ckpt");
    ensemble().checkpoints(&path, Duration::ZERO).take_steps(100)?;
    let others =
        ensemble().vary_method(|number, method| method.seed = number + 1).checkpoints(&path, Duration::ZERO);
    assert!(matches!(others.take_steps(100), Err(EnsembleError::Foreign { .. })));
    Ok(())
}

#[test]
fn the_stride_only_changes_what_is_looked_at() -> Checked {
    let ensemble = |stride| {
        let ensemble = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(10));
        ensemble.stride(stride).take_steps(500)
    };
    let expected = ensemble(1)?;
    for stride in [2, 499, 500, 501, u64::MAX] {
        for (member, expected) in ensemble(stride)?.members().iter().zip(expected.members()) {
            assert_eq!((&member.state, member.steps), (&expected.state, expected.steps));
            // Numbers that are none count as the largest.
            let [error, largest] = [member, expected].map(|member| member.energy.largest_error);
            assert!(error <= largest || largest.is_nan());
        }
    }
    Ok(())
}
