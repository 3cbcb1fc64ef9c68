//! Runs that are killed, and go on where they were.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use dvi_core::ensemble::{Ensemble, EnsembleError, Outcome, Results, Shard};
use dvi_core::prelude::*;

use crate::ensemble::{Checked, HenonHeiles, HenonHeilesState, LEFT, Verlet, bytes, file, left, wells};

const STEPS: u64 = 2000;

/// In the process that is killed: the file of its checkpoint.
const CHILD: &str = "DVI_ENSEMBLE_CHECKPOINT";

fn ensemble(system: &HenonHeiles) -> Ensemble<'_, HenonHeiles, Verlet> {
    Ensemble::new(system, Variational::trapezoid(), 0.05, wells(30)).until(LEFT, left).stride(100)
}

/// The process that is killed. Without one, there is nothing to do.
#[test]
fn child() -> Checked {
    let Some(path) = std::env::var_os(CHILD) else { return Ok(()) };
    let ensemble = ensemble(&HenonHeiles).checkpoints(path, Duration::ZERO);
    ensemble.on_progress(|progress| println!("\nsteps {}", progress.steps)).take_steps(STEPS)?;
    Ok(())
}

/// Runs the child until it has said `lines` times how far it is, and kills it. Returns how far it was at the
/// first and at the last.
fn killed_after(lines: usize, path: &Path) -> Result<Option<[u128; 2]>, Box<dyn std::error::Error>> {
    let mut child = Command::new(std::env::current_exe()?)
        .args(["--exact", "ensemble::resumed::child", "--nocapture"])
        .env(CHILD, path)
        .stdout(Stdio::piped())
        .spawn()?;
    let Some(output) = child.stdout.take() else { return Err("it has an output".into()) };
    let mut steps = Vec::new();
    for line in BufReader::new(output).lines() {
        if let Some(("steps", count)) = line?.split_once(' ') {
            steps.push(count.parse()?);
        }
        if steps.len() == lines {
            child.kill()?;
            break;
        }
    }
    let has_succeeded = child.wait()?.success();
    let (Some(&first), Some(&last)) = (steps.first(), steps.last()) else {
        return Err("it said nothing".into());
    };
    Ok((!has_succeeded).then_some([first, last]))
}

#[test]
fn a_killed_process_goes_on_where_it_was() -> Checked {
    let path = file("killed.ckpt");
    let mut before = 0;
    for lines in [2, 11, 40, 63] {
        let Some([first, last]) = killed_after(lines, &path)? else {
            return Err("it was not killed".into());
        };
        assert!(first >= before && last > first, "{first} to {last}, after {before}");
        before = last;
        assert!(matches!(Results::read(&path), Err(EnsembleError::UnderWay { .. })));
    }
    // What a process leaves that is killed while it writes.
    std::fs::write(path.with_extension("ckpt.new"), "dvi ens")?;
    let resumed = ensemble(&HenonHeiles).checkpoints(&path, Duration::from_secs(60)).take_steps(STEPS)?;
    let whole = ensemble(&HenonHeiles).take_steps(STEPS)?;
    assert!(bytes(&resumed)? == bytes(&whole)?);
    // The file has the results now, and to run it again changes nothing.
    assert!(bytes(&Results::read(&path)?)? == bytes(&whole)?);
    let again = ensemble(&HenonHeiles).checkpoints(&path, Duration::from_secs(60)).take_steps(STEPS)?;
    assert!(bytes(&again)? == bytes(&whole)?);
    Ok(())
}

/// A run that was begun with some lanes goes on with others, or without.
#[test]
fn lanes_may_change_on_the_way() -> Checked {
    let plain = || Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(30)).stride(50);
    let expected = bytes(&plain().take_steps(STEPS)?)?;
    let (path, kept) = (file("lanes.ckpt"), file("lanes-kept.ckpt"));
    // Copies of the checkpoint of a run that is under way.
    let mut rounds = 0;
    let keep = |_: &dvi_core::ensemble::Progress| {
        rounds += 1;
        if rounds == 25 {
            assert!(std::fs::copy(&path, &kept).is_ok());
        }
    };
    plain().checkpoints(&path, Duration::ZERO).on_progress(keep).take_steps(STEPS)?;
    assert!(matches!(Results::read(&kept), Err(EnsembleError::UnderWay { .. })));
    let begun = std::fs::read(&kept)?;
    let resumed = plain().in_lanes::<8>().checkpoints(&kept, Duration::ZERO).take_steps(STEPS)?;
    assert_eq!(bytes(&resumed)?, expected);
    std::fs::write(&kept, begun)?;
    let resumed = plain().in_lanes::<3>().checkpoints(&kept, Duration::from_secs(9)).take_steps(STEPS)?;
    assert_eq!(bytes(&resumed)?, expected);
    Ok(())
}

/// Where what a run carries has just overflown, no other goes on from there: a member is left a step later,
/// when it has failed.
#[test]
fn members_are_not_left_where_they_cannot_go_on() -> Checked {
    let start = HenonHeilesState { x: 0.0, y: -1.3e17, dot_x: 0.0, dot_y: 0.0 };
    let method = Galerkin::<3>::new();
    let mut run = Integrator::new(&HenonHeiles, method, 0.05, start)?;
    run.take_steps(1)?;
    assert!(Integrator::resume(&HenonHeiles, method, &run.checkpoint()).is_err());

    let ensemble = || Ensemble::new(&HenonHeiles, method, 0.05, [start]).stride(1);
    let (plain, path) = (ensemble().take_steps(9)?, file("overflown.ckpt"));
    let interrupted = ensemble().checkpoints(&path, Duration::ZERO).take_steps(9)?;
    assert_eq!(bytes(&interrupted)?, bytes(&plain)?);
    let member = &plain.members()[0];
    assert!(matches!(member.outcome, Outcome::Failed { .. }) && member.steps == 1, "{member:?}");
    Ok(())
}

#[test]
fn shards_have_files_of_their_own() -> Checked {
    let path = file("sharded.ckpt");
    let mut shards = Vec::new();
    for index in 0..3 {
        let shard = Shard::new(index, 3)?;
        ensemble(&HenonHeiles).checkpoints(&path, Duration::ZERO).shard(shard).take_steps(300)?;
        shards.push(Results::read(shard.path(&path))?);
    }
    assert!(!path.exists());
    // Neither checkpoints nor shards are part of what is computed.
    let whole = ensemble(&HenonHeiles).checkpoints(&path, Duration::ZERO).take_steps(300)?;
    assert_eq!(bytes(&Results::merge(shards)?)?, bytes(&whole)?);
    Ok(())
}
