//! Checkpoints that are damaged, or those of another ensemble: errors that say what is wrong, and the file
//! is left as it is.

use std::time::Duration;

use dvi_core::ensemble::{Ensemble, EnsembleError, Results, Shard};
use dvi_core::prelude::*;

use crate::ensemble::{Checked, HenonHeiles, Kepler, LEFT, Verlet, file, left, planets, said, wells};

fn ensemble(system: &HenonHeiles) -> Ensemble<'_, HenonHeiles, Verlet> {
    Ensemble::new(system, Variational::trapezoid(), 0.05, wells(3))
}

const RARELY: Duration = Duration::from_secs(3600);

#[test]
fn every_damage_is_seen() -> Checked {
    let path = file("damaged.ckpt");
    ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10)?;
    let whole = std::fs::read(&path)?;
    let mut damaged: Vec<Vec<u8>> = (0..whole.len()).map(|len| whole[..len].to_vec()).collect();
    for place in 0..whole.len() {
        let mut other = whole.clone();
        other[place] ^= 1 << (place % 8);
        damaged.push(other);
    }
    damaged.push([&whole[..], b"\0"].concat());
    damaged.push(b"x,y\n1,2\n".to_vec());
    for bytes in damaged {
        std::fs::write(&path, &bytes)?;
        let result = ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10);
        assert!(matches!(result, Err(EnsembleError::Damaged { .. })), "{result:?}");
        assert!(matches!(Results::read(&path), Err(EnsembleError::Damaged { .. })));
        assert_eq!(std::fs::read(&path)?, bytes, "the file is left alone");
    }
    Ok(())
}

#[test]
fn another_ensemble_is_told_from_this_one() -> Checked {
    let path = file("foreign.ckpt");
    let this = || ensemble(&HenonHeiles).checkpoints(&path, RARELY);
    this().take_steps(10)?;
    let kept = std::fs::read(&path)?;
    let differs =
        |text: String, what: &str| assert!(text.contains(&format!("its {what} is")), "{what}: {text}");
    let mut moved = wells(3);
    moved[2].dot_y += 1e-16;
    moved[2].dot_y = moved[2].dot_y.next_up();
    let trapezoid = Variational::trapezoid;
    let of = |method, h, states| Ensemble::new(&HenonHeiles, method, h, states).checkpoints(&path, RARELY);
    differs(said(this().take_steps(11)), "number of steps");
    differs(said(this().stride(7).take_steps(10)), "stride");
    differs(said(of(trapezoid(), 0.05, moved).take_steps(10)), "fingerprint of the initial states");
    differs(said(of(trapezoid(), 0.05, wells(4)).take_steps(10)), "number of members");
    differs(said(of(trapezoid(), 0.051, wells(3)).take_steps(10)), "step h");
    let gauss = Ensemble::new(&HenonHeiles, Gauss::<2>::new(), 0.05, wells(3)).checkpoints(&path, RARELY);
    differs(said(gauss.take_steps(10)), "method");
    differs(said(this().until(LEFT, left).take_steps(10)), "exit condition");
    assert_eq!(said(this().take_steps(10)), "no error");
    assert!(std::fs::read(&path)? == kept);

    let path = file("foreign-parameters.ckpt");
    let (mut systems, states) = planets(3);
    let of = |systems: &[Kepler]| {
        let ensemble =
            Ensemble::with_systems(systems, Variational::trapezoid(), 0.05, states.iter().cloned());
        ensemble.checkpoints(&path, RARELY).take_steps(10)
    };
    of(&systems)?;
    systems[1].mu = systems[1].mu.next_up();
    differs(said(of(&systems)), "fingerprint of the parameters");
    // Another system altogether.
    let foreign = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(3));
    differs(said(foreign.checkpoints(&path, RARELY).take_steps(10)), "system");
    // The file of another shard.
    let path = file("foreign-shard.ckpt");
    let shards = [Shard::new(0, 3)?, Shard::new(1, 3)?];
    ensemble(&HenonHeiles).checkpoints(&path, RARELY).shard(shards[0]).take_steps(10)?;
    std::fs::rename(shards[0].path(&path), shards[1].path(&path))?;
    let other = ensemble(&HenonHeiles).checkpoints(&path, RARELY).shard(shards[1]);
    differs(said(other.take_steps(10)), "shard");
    Ok(())
}

#[test]
fn files_that_cannot_be_written_or_read() -> Checked {
    let nowhere = file("no-such-folder").join("run.ckpt");
    let mut begun = false;
    let result =
        ensemble(&HenonHeiles).checkpoints(&nowhere, RARELY).on_progress(|_| begun = true).take_steps(10);
    assert!(matches!(result, Err(EnsembleError::File { .. })), "{result:?}");
    assert!(!begun, "it shows before the work is done");
    let folder = env!("CARGO_TARGET_TMPDIR");
    let result = ensemble(&HenonHeiles).checkpoints(folder, RARELY).take_steps(10);
    assert!(matches!(result, Err(EnsembleError::File { .. })), "{result:?}");
    assert!(matches!(Results::read(&nowhere), Err(EnsembleError::File { .. })));
    Ok(())
}

/// Of what is no checkpoint no more is read than its head, if so much: a file of a terabyte, with the mark
/// of a checkpoint and without, devices without an end, and a pipe that nobody writes to.
#[cfg(unix)]
#[test]
fn what_is_no_checkpoint_is_left_alone() -> Checked {
    let path = file("large.ckpt");
    ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10)?;
    let refused = |path: &std::path::Path| {
        let result = ensemble(&HenonHeiles).checkpoints(path, RARELY).take_steps(10);
        (result.map(drop), Results::read(path).map(drop))
    };
    const TERABYTE: u64 = 1 << 40;
    for content in [std::fs::read(&path)?, vec![]] {
        std::fs::write(&path, content)?;
        std::fs::OpenOptions::new().write(true).open(&path)?.set_len(TERABYTE)?;
        let (run, read) = refused(&path);
        assert!(matches!(run, Err(EnsembleError::Damaged { .. })), "{run:?}");
        assert!(matches!(read, Err(EnsembleError::Damaged { .. })), "{read:?}");
        assert_eq!(std::fs::metadata(&path)?.len(), TERABYTE);
    }
    let pipe = file("pipe.ckpt");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status()?.success());
    let devices = ["/dev/full", "/dev/zero", "/dev/null"].map(std::path::PathBuf::from);
    for path in devices.into_iter().chain([pipe]).filter(|path| path.exists()) {
        let (run, read) = refused(&path);
        assert!(matches!(run, Err(EnsembleError::File { .. })), "{run:?}");
        assert!(matches!(read, Err(EnsembleError::File { .. })), "{read:?}");
        assert!(path.exists(), "it is left where it is");
    }
    Ok(())
}

/// A disk without space: what is written beside the checkpoint goes to a device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_good_checkpoint_alone() -> Checked {
    let path = file("full.ckpt");
    ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10)?;
    let kept = std::fs::read(&path)?;
    let beside = path.with_extension("ckpt.new");
    std::os::unix::fs::symlink("/dev/full", &beside)?;
    let result = ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10);
    let Err(EnsembleError::File { source, .. }) = result else { return Err(format!("{result:?}").into()) };
    assert_eq!(source.kind(), std::io::ErrorKind::StorageFull);
    assert!(std::fs::symlink_metadata(&beside).is_err(), "nothing is left beside it");
    assert_eq!(std::fs::read(&path)?, kept);
    assert_eq!(said(ensemble(&HenonHeiles).checkpoints(&path, RARELY).take_steps(10)), "no error");
    Ok(())
}

#[test]
fn shards_that_do_not_go_together() -> Checked {
    let shard = |index, of, steps| -> Result<Results, Box<dyn std::error::Error>> {
        Ok(ensemble(&HenonHeiles).shard(Shard::new(index, of)?).take_steps(steps)?)
    };
    assert!(matches!(Results::merge(vec![]), Err(EnsembleError::Nothing)));
    let twice = Results::merge([shard(0, 2, 10)?, shard(1, 2, 10)?, shard(0, 2, 10)?]);
    assert!(matches!(twice, Err(EnsembleError::Twice { member: 0 })));
    let overlapping = Results::merge([shard(0, 2, 10)?, shard(1, 2, 10)?, shard(1, 3, 10)?]);
    assert!(matches!(overlapping, Err(EnsembleError::Twice { member: 1 })));
    let missing = |shards: Vec<Results>| match Results::merge(shards) {
        Err(EnsembleError::Missing { member, members: 3 }) => Ok(member),
        other => Err(format!("{other:?}")),
    };
    assert_eq!(missing(vec![shard(0, 3, 10)?, shard(2, 3, 10)?])?, 1);
    assert_eq!(missing(vec![shard(0, 3, 10)?, shard(1, 3, 10)?])?, 2);
    assert_eq!(missing(vec![shard(4, 5, 10)?])?, 0);
    let foreign = Results::merge([shard(0, 2, 10)?, shard(1, 2, 11)?]);
    let Err(EnsembleError::ForeignShard { shard, difference }) = foreign else {
        return Err("they differ".into());
    };
    assert_eq!(
        (shard.to_string(), difference.what, difference.found),
        ("1/2".into(), "number of steps".into(), "11".into())
    );
    Ok(())
}

/// The number of stages is in the type of a method alone.
#[test]
fn a_method_with_other_stages_is_another_ensemble() -> Checked {
    let path = file("stages.ckpt");
    Ensemble::new(&HenonHeiles, Gauss::<2>::new(), 0.5, wells(4))
        .checkpoints(&path, Duration::ZERO)
        .take_steps(20)?;
    let other =
        Ensemble::new(&HenonHeiles, Gauss::<3>::new(), 0.5, wells(4)).checkpoints(&path, Duration::ZERO);
    assert!(matches!(other.take_steps(20), Err(EnsembleError::Foreign { .. })));
    let shard = |index| Shard::new(index, 2);
    let by_verlet = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(4)).shard(shard(0)?);
    let by_midpoint = Ensemble::new(&HenonHeiles, Variational::midpoint(), 0.05, wells(4)).shard(shard(1)?);
    let merged = Results::merge([by_verlet.take_steps(20)?, by_midpoint.take_steps(20)?]);
    assert!(matches!(merged, Err(EnsembleError::ForeignShard { .. })));
    // What a checkpoint asks beyond that does not keep shards of one ensemble apart.
    let verlet = |index| {
        Ok::<_, Box<dyn std::error::Error>>(
            Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(4)).shard(shard(index)?),
        )
    };
    let with = verlet(0)?.checkpoints(file("asked.ckpt"), Duration::ZERO).take_steps(20)?;
    assert_eq!(Results::merge([with, verlet(1)?.take_steps(20)?])?.members().len(), 4);
    Ok(())
}
