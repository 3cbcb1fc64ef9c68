//! Input that makes no sense: errors with the numbers in them, or results without members, and never a
//! panic.

use dvi_core::ensemble::{Ensemble, EnsembleError, Outcome, Shard};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{Springs, SpringsState};

use crate::ensemble::{Checked, HenonHeiles, bytes, planets, said, wells};
use crate::records::sizes::Lattice;

#[test]
fn no_steps_and_no_members() -> Checked {
    let states = wells(3);
    let still = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, states.clone()).take_steps(0)?;
    for (member, state) in still.members().iter().zip(&states) {
        assert_eq!((member.steps, member.time, &member.outcome), (0, 0.0, &Outcome::Finished));
        assert_eq!(member.state, HenonHeiles.values(state)?.collect::<Vec<f64>>());
    }
    let none = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, []).take_steps(10)?;
    let [csv, _] = bytes(&none)?;
    assert_eq!((none.members().len(), csv.iter().filter(|&&byte| byte == b'\n').count()), (0, 1));
    let none =
        Ensemble::<HenonHeiles, _>::with_systems(&[], Variational::trapezoid(), 0.05, []).take_steps(10)?;
    assert!(none.members().is_empty() && bytes(&none).is_ok());
    Ok(())
}

#[test]
fn numbers_out_of_range() {
    for h in [0.0, -0.0, f64::NAN, f64::INFINITY] {
        let result = Ensemble::new(&HenonHeiles, Variational::trapezoid(), h, wells(2)).take_steps(10);
        assert!(matches!(result, Err(EnsembleError::Step { .. })), "{result:?}");
    }
    let result =
        Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.1, wells(2)).stride(0).take_steps(10);
    assert_eq!(said(result), "the stride must be at least one step");
    let (systems, states) = planets(3);
    let result = Ensemble::with_systems(&systems[..2], Variational::trapezoid(), 0.1, states).take_steps(10);
    assert_eq!(said(result), "there are 2 systems for 3 states");
}

/// Systems whose arrays have a length at run time.
#[test]
fn shapes_that_differ() -> Checked {
    let springs = |n: usize| Springs { k: vec![1.0; n] };
    let state = |n: usize| SpringsState { x: vec![1.0; n], dot_x: vec![0.0; n] };
    let take = |systems: &[Springs], states: [SpringsState; 2]| {
        Ensemble::with_systems(systems, Variational::trapezoid(), 0.1, states).take_steps(10)
    };
    let result = take(&[springs(2), springs(3)], [state(2), state(3)]);
    let differ = "the arrays of the system of member 1 have other lengths than those of member 0";
    assert_eq!(said(result), differ);
    // As many coordinates, in rows of other lengths.
    let [wide, tall] = [[2, 3], [3, 2]].map(|[n, m]| Lattice { n, m, k: vec![1.0; n] });
    let states = [&wide, &tall].map(|system| system.state_of([]));
    let result = Ensemble::with_systems(&[wide, tall], Variational::trapezoid(), 0.1, states).take_steps(10);
    assert_eq!(said(result), differ);
    // A state of another length is a member that fails.
    let results = take(&[springs(2), springs(2)], [state(2), state(3)])?;
    let [good, bad] = results.members() else { return Err("there are two".into()) };
    assert_eq!(good.outcome, Outcome::Finished);
    let error = "`x` has length 3, but the system declares 2".into();
    assert_eq!(bad.outcome, Outcome::Failed { error });
    assert!(bad.state.len() == 4 && bad.state.iter().all(|x| x.is_nan()));
    Ok(())
}

#[test]
fn texts_that_are_no_shards() -> Checked {
    let said =
        |text: &str| text.parse::<Shard>().map_or_else(|error| error.to_string(), |shard| shard.to_string());
    assert_eq!([said("0/1"), said(" 2/8 ")], ["0/1", "2/8"]);
    assert_eq!(said("3/3"), "there is no shard 3 of 3: they count from 0 to n − 1");
    assert_eq!(said("0/0"), "there is no shard 0 of 0: they count from 0 to n − 1");
    for text in ["", "/", "1", "1/", "/2", "-1/2", "1/2/3", "a/b", "1.0/2", "99999999999999999999/3"] {
        assert_eq!(
            said(text),
            format!("`{text}` is no shard: write i/n, such as 0/4 for the first of four")
        );
    }
    let whole = Shard::WHOLE.path("run.ckpt");
    assert_eq!(
        [whole, Shard::new(2, 8)?.path("run.ckpt")],
        ["run.ckpt", "run.ckpt.2-of-8"].map(std::path::PathBuf::from)
    );
    Ok(())
}
