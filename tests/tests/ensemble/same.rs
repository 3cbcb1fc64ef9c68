//! The same results, bit for bit, for every number of threads, of lanes and of shards.

use dvi_core::ensemble::{Ensemble, Results, Shard};
use dvi_core::prelude::*;
use dvi_tests::systems::{PointVortices, PointVorticesState};

use crate::ensemble::{Checked, HenonHeiles, LEFT, Verlet, bytes, left, planets, wells};

const STEPS: u64 = 1500;

fn on_threads<T: Send>(
    threads: usize,
    of: impl FnOnce() -> T + Send,
) -> Result<T, rayon::ThreadPoolBuildError> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(of))
}

/// Some members fall without end, and fail where numbers end.
fn without_limits(system: &HenonHeiles) -> Ensemble<'_, HenonHeiles, Verlet> {
    Ensemble::new(system, Variational::trapezoid(), 0.05, wells(45)).stride(7)
}

fn ensemble(system: &HenonHeiles) -> Ensemble<'_, HenonHeiles, Verlet> {
    without_limits(system).until(LEFT, left)
}

#[test]
fn for_every_number_of_threads() -> Checked {
    let expected = bytes(&ensemble(&HenonHeiles).take_steps(STEPS)?)?;
    assert!(String::from_utf8_lossy(&expected[0]).contains("left the well"));
    for threads in [1, 2, 3, 7] {
        assert_eq!(bytes(&on_threads(threads, || ensemble(&HenonHeiles).take_steps(STEPS))??)?, expected);
        let in_lanes = on_threads(threads, || ensemble(&HenonHeiles).in_lanes::<4>().take_steps(STEPS))??;
        assert_eq!(bytes(&in_lanes)?, expected);
    }
    let expected = bytes(&without_limits(&HenonHeiles).take_steps(STEPS)?)?;
    assert!(String::from_utf8_lossy(&expected[0]).contains("failed"));
    for threads in [1, 3] {
        let in_lanes =
            on_threads(threads, || without_limits(&HenonHeiles).in_lanes::<4>().take_steps(STEPS))??;
        assert_eq!(bytes(&in_lanes)?, expected);
    }
    Ok(())
}

#[test]
fn for_every_number_of_lanes() -> Checked {
    let expected = bytes(&without_limits(&HenonHeiles).take_steps(STEPS)?)?;
    assert_eq!(bytes(&without_limits(&HenonHeiles).in_lanes::<1>().take_steps(STEPS)?)?, expected);
    assert_eq!(bytes(&without_limits(&HenonHeiles).in_lanes::<2>().take_steps(STEPS)?)?, expected);
    assert_eq!(bytes(&without_limits(&HenonHeiles).in_lanes::<3>().take_steps(STEPS)?)?, expected);
    assert_eq!(bytes(&without_limits(&HenonHeiles).in_lanes::<8>().take_steps(STEPS)?)?, expected);
    assert_eq!(bytes(&without_limits(&HenonHeiles).in_lanes::<16>().take_steps(STEPS)?)?, expected);
    Ok(())
}

/// Implicit steps, with iterations that are counted.
#[test]
fn of_vortices_in_lanes() -> Checked {
    let system = PointVortices { gamma: [1.0, 2.0, -0.5] };
    let state = |k: u32| PointVorticesState { x: [-1.0, 0.01 * f64::from(k), 1.0], y: [0.0, 0.3, 0.1] };
    let ensemble = || Ensemble::new(&system, Sigma::midpoint(), 0.05, (0..21).map(state)).stride(13);
    let alone = ensemble().take_steps(300)?;
    assert!(alone.members().iter().all(|member| member.iterations > 0 && member.momenta.len() == 3));
    assert_eq!(bytes(&ensemble().in_lanes::<4>().take_steps(300)?)?, bytes(&alone)?);
    assert_eq!(bytes(&ensemble().in_lanes::<8>().take_steps(300)?)?, bytes(&alone)?);
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
        let ensemble = || Ensemble::with_systems(systems, method, 0.01, states.iter().cloned());
        let expected = bytes(&ensemble().take_steps(400)?)?;
        let inner =
            || Ensemble::with_systems(systems, Variational::trapezoid(), 0.01, states.iter().cloned());
        let unlimited = bytes(&inner().take_steps(400)?)?;
        assert_eq!(bytes(&on_threads(3, || ensemble().take_steps(400))??)?, expected);
        assert_eq!(bytes(&on_threads(3, || inner().in_lanes::<8>().take_steps(400))??)?, unlimited);
        // Without those that fail, the others are what they were.
        let all = ensemble().take_steps(400)?;
        for (member, state) in all.members().iter().zip(&states).filter(|(_, state)| state.dot_y > 0.0) {
            let system = &systems[member.number as usize..][..1];
            let alone = Ensemble::with_systems(system, method, 0.01, [*state]).take_steps(400)?;
            let [a, b] =
                [member, &alone.members()[0]].map(|member| member.state.iter().map(|x| x.to_bits()));
            assert!(a.eq(b) && member.outcome == alone.members()[0].outcome);
        }
    }
    Ok(())
}

#[test]
fn from_shards() -> Checked {
    for ensemble in [ensemble, without_limits] {
        let whole = ensemble(&HenonHeiles).take_steps(STEPS)?;
        for of in [1, 2, 3, 50] {
            let shard = |index| {
                let shard = Shard::new(index, of)?;
                let results = ensemble(&HenonHeiles).shard(shard).in_lanes::<4>().take_steps(STEPS)?;
                assert_eq!(results.shard(), shard);
                Ok(results)
            };
            // In any order.
            let shards = (0..of).rev().map(shard).collect::<Result<Vec<_>, Box<dyn std::error::Error>>>()?;
            let merged = Results::merge(shards)?;
            assert_eq!(bytes(&merged)?, bytes(&whole)?);
        }
    }
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
