//! The state between two points of a run is that of the method begun anew at the first of them; those at the
//! points, and the points themselves, stay what they are.

use dvi_laws::Case;
use dvi_laws::equations::apart;
use dvi_tests::bits;

use super::{Outcome, below, of_every_kind};

/// Steps, and parts of the one behind them.
const ASKED: [(u64, f64); 7] = [(0, 0.4), (0, 0.7), (0, 0.1), (1, 0.0), (3, 0.5), (3, 1.0), (5, 0.999)];

pub(super) fn states_between_are_those_of_a_run_begun_anew(case: &Case) -> Outcome {
    let h = case.subject.h;
    let (mut plain, mut asked) = (case.run()?, case.run()?);
    let mut points = vec![(plain.time(), plain.values())];
    for _ in 0..7 {
        plain.advance()?;
        points.push((plain.time(), plain.values()));
    }
    let time = |(step, part): (u64, f64)| match part {
        0.0 => points[step as usize].0,
        1.0 => points[step as usize + 1].0,
        _ => points[step as usize].0 + part * h,
    };
    let states = asked.values_at(&ASKED.map(time))?;
    for ((step, part), found) in ASKED.into_iter().zip(&states) {
        let (begin, end) = (&points[step as usize], &points[step as usize + 1]);
        let at_a_point = [(0.0, begin), (1.0, end)].into_iter().find(|&(at, _)| at == part);
        if let Some((_, point)) = at_a_point {
            if bits(found) != bits(&point.1) {
                return Err(format!("after {step} steps: {found:?} is not {:?}", point.1).into());
            }
        } else if !case.has_hidden_state() {
            let mut anew = case.begin([begin.0, part * h], &begin.1)?;
            anew.advance()?;
            below(apart(&anew.values(), found), 1e-12, &format!("{part} of a step after {step}"))?;
        }
    }
    while asked.time() < plain.time() {
        asked.advance()?;
    }
    if bits(&asked.values()) == bits(&plain.values()) { Ok(()) } else { Err("the run has moved".into()) }
}

of_every_kind!(states_between_are_those_of_a_run_begun_anew);
