//! Files that are cut, changed, or those of other runs.

use super::*;

const EVERY: Every = Every::Steps(7);
const STEPS: u64 = 30;

/// The bytes of an archive, and where each of its checkpoints ends.
fn whole(path: &std::path::Path) -> Outcome<(Vec<u8>, Vec<usize>)> {
    let mut archive = Archive::new(path, planet()?, EVERY)?;
    let mut ends = vec![std::fs::read(path)?.len()];
    for _ in 0..STEPS / 7 {
        archive.take_steps(7)?;
        ends.push(std::fs::read(path)?.len());
    }
    Ok((std::fs::read(path)?, ends))
}

/// Goes on to the end, whatever the archive has, and says what it had.
fn goes_on(
    path: &std::path::Path,
    (whole, ends): &(Vec<u8>, Vec<usize>),
) -> Outcome<Result<usize, ArchiveError>> {
    let mut archive = match Archive::new(path, planet()?, EVERY) {
        Ok(archive) => archive,
        Err(error) => return Ok(Err(error)),
    };
    let checkpoints = kept(&archive);
    assert_eq!(checkpoints, (0..checkpoints.len() as u64).map(|k| 7 * k).collect::<Vec<_>>());
    assert_eq!(std::fs::metadata(path)?.len(), ends[checkpoints.len() - 1] as u64, "the rest is cut off");
    let step = archive.run().steps();
    assert_eq!(place(archive.run()), alone(planet()?, step)?);
    archive.take_steps(STEPS / 7 * 7 - step)?;
    assert!(std::fs::read(path)? == *whole, "the file is as if nothing had happened");
    Ok(Ok(checkpoints.len()))
}

#[test]
fn a_file_that_is_cut_anywhere_has_what_was_complete() -> Outcome {
    let path = file("cut")?;
    let of = whole(&path)?;
    let (whole, ends) = &of;
    for len in 0..=whole.len() {
        std::fs::write(&path, &whole[..len])?;
        let complete = ends.iter().filter(|end| **end <= len).count();
        match goes_on(&path, &of)? {
            Ok(found) => assert_eq!(found, complete, "{len} bytes"),
            Err(ArchiveError::Damaged { .. }) if complete == 0 => {
                assert!(std::fs::read(&path)? == whole[..len], "it is left as it is");
            }
            Err(error) => return Err(format!("{len} bytes: {error}").into()),
        }
    }
    Ok(())
}

#[test]
fn no_bit_changes_unseen() -> Outcome {
    let path = file("changed")?;
    let of = whole(&path)?;
    let (whole, ends) = &of;
    let last = ends[ends.len() - 2];
    for place in 0..whole.len() {
        let mut changed = whole.clone();
        changed[place] ^= 1 << (place % 8);
        std::fs::write(&path, &changed)?;
        match goes_on(&path, &of)? {
            // As if the last checkpoint had not been completed.
            Ok(found) => assert!(place >= last && found == ends.len() - 1, "byte {place}: {found}"),
            Err(ArchiveError::Damaged { .. }) => {
                assert!(std::fs::read(&path)? == changed, "it is left as it is");
            }
            Err(error) => return Err(format!("byte {place}: {error}").into()),
        }
    }
    Ok(())
}

/// What changes after the archive has been opened is seen when it is asked for.
#[test]
fn what_changes_later_is_seen() -> Outcome {
    let path = file("later")?;
    let (mut bytes, ends) = whole(&path)?;
    let archive = Archive::new(&path, planet()?, EVERY)?;
    bytes[ends[1] + 20] ^= 1;
    std::fs::write(&path, &bytes)?;
    assert!(matches!(archive.run_after(15), Err(ArchiveError::Damaged { .. })));
    assert_eq!(place(&archive.run_after(8)?), alone(planet()?, 8)?);
    Ok(())
}

#[test]
fn another_run_is_told_from_this_one() -> Outcome {
    fn differs<H, M, C>(
        path: &std::path::Path,
        run: Result<Integrator<H, M, f64, C>, StartError>,
        what: &str,
    ) -> Outcome
    where
        H: Held<System: Lagrangian> + Clone,
        M: Method<H::System, f64> + Clone + core::fmt::Debug,
        C: StepControl<H::System, f64> + Clone,
    {
        match Archive::new(path, run?, EVERY).err() {
            Some(ArchiveError::Foreign { difference, .. }) if difference.what == what => Ok(()),
            other => Err(format!("{what}: {other:?}").into()),
        }
    }
    let path = file("foreign")?;
    let (whole, _) = whole(&path)?;
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };
    let (verlet, one) = (Variational::trapezoid(), Kepler { mu: 1.0 });
    differs(&path, Integrator::new(&one, Variational::midpoint(), 0.05, start), "method")?;
    let limited = EnergyLimit { method: verlet, limit: 0.1 };
    differs(&path, Integrator::new(&one, limited, 0.05, start), "method")?;
    let other = Kepler { mu: 1.0_f64.next_up() };
    differs(
        &path,
        Integrator::new(other, verlet, 0.05, start),
        "fingerprint of the parameters and the start",
    )?;
    differs(&path, Integrator::new(&one, verlet, 0.06, start), "start")?;
    differs(&path, Integrator::new_at(&one, verlet, 0.1, 0.05, start), "start")?;
    let control = Reversible::power(0.05, 1.5);
    differs(&path, Integrator::controlled(&one, verlet, control, start), "step control")?;
    let (vortices, start) = dvi_tests::configurations::leapfrogging();
    differs(&path, Integrator::new(vortices, Sigma::midpoint(), 0.05, start), "system")?;
    assert!(std::fs::read(&path)? == whole, "it is left as it is");
    // A run that borrows is the run that owns.
    assert_eq!(Archive::new(&path, planet()?, EVERY)?.run().steps(), 28);
    Ok(())
}

#[test]
fn what_is_no_file_of_its_own_is_an_error() -> Outcome {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    assert!(matches!(Archive::new(&folder, planet()?, EVERY), Err(ArchiveError::File { .. })));
    let nowhere = folder.join("no such folder").join("archive");
    assert!(matches!(Archive::new(nowhere, planet()?, EVERY), Err(ArchiveError::File { .. })));
    let path = file("taken")?;
    let first = Archive::new(&path, planet()?, EVERY)?;
    assert!(matches!(Archive::new(&path, planet()?, EVERY), Err(ArchiveError::Taken { .. })));
    drop(first);
    Archive::new(&path, planet()?, EVERY)?;
    Ok(())
}
