//! Processes that are killed, and disks that are full.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use dvi_tests::Numbers;
use dvi_tests::zoo::regular::{RunTimeChain, RunTimeChainState};

use super::*;

/// In the process that is killed: the file of its archive.
const CHILD: &str = "DVI_ARCHIVE";
const EVERY: Every = Every::Steps(5);

/// Of many coordinates, so that a checkpoint takes a while to be written.
fn chain() -> Result<Integrator<RunTimeChain, Verlet>, StartError> {
    let n = 400;
    let start = RunTimeChainState {
        q: (0..n).map(|j| 0.1 * f64::from(j).sin()).collect(),
        wall: 0.4,
        dot_q: vec![0.0; n as usize],
        dot_wall: 0.0,
    };
    Integrator::new(
        RunTimeChain { mass: vec![1.0; n as usize], coupling: 0.2 },
        Variational::trapezoid(),
        0.05,
        start,
    )
}

/// The process that is killed, or that comes to the end of its disk. Without one, there is nothing to do.
#[test]
fn child() -> Outcome {
    let Some(path) = std::env::var_os(CHILD) else { return Ok(()) };
    let mut archive = Archive::new(path, chain()?, EVERY)?;
    loop {
        println!("\nsteps {}", archive.run().steps());
        match archive.take_steps(3) {
            Ok(()) => {}
            Err(ArchiveError::File { source, .. }) => {
                let (kept, steps) = (kept(&archive), archive.run().steps());
                assert_eq!(kept.last(), Some(&((steps - 1) / 5 * 5)), "the run goes on where it is");
                println!("\nfull {steps} {source}");
                return Ok(());
            }
            Err(other) => return Err(other.into()),
        }
    }
}

fn test() -> Outcome<[std::ffi::OsString; 4]> {
    let program = std::env::current_exe()?;
    Ok([program.into(), "--exact".into(), "archive::killed::child".into(), "--nocapture".into()])
}

#[test]
fn a_killed_process_leaves_what_was_complete() -> Outcome {
    let path = file("killed")?;
    let (mut numbers, mut before) = (Numbers(3), 0);
    for _ in 0..12 {
        let [program, arguments @ ..] = test()?;
        let mut child =
            Command::new(program).args(arguments).env(CHILD, &path).stdout(Stdio::piped()).spawn()?;
        let output = child.stdout.take().ok_or("it has an output")?;
        let count = 2 + (20.0 * (1.0 + numbers.next())) as usize;
        let said = BufReader::new(output).lines().map_while(Result::ok);
        let last = said.filter(|line| line.starts_with("steps ")).take(count).last().ok_or("nothing")?;
        child.kill()?;
        assert!(!child.wait()?.success(), "it was killed");
        let last: u64 = last["steps ".len()..].parse()?;

        let archive = Archive::new(&path, chain()?, EVERY)?;
        let kept = kept(&archive);
        assert_eq!(kept, (0..kept.len() as u64).map(|k| 5 * k).collect::<Vec<_>>());
        let steps = archive.run().steps();
        // It may have got on before it was killed.
        assert!(steps + 5 > last && steps >= before, "{before}, {steps}, {last}");
        assert_eq!(place(archive.run()), alone(chain()?, steps)?);
        before = steps;
    }
    assert!(before > 100, "{before}");
    Ok(())
}

/// Files of a process may be of a limited size, which is to it as if the disk were full.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_what_was_complete() -> Outcome {
    let path = file("full")?;
    let mut child = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 200; exec \"$0\" \"$@\""])
        .args(test()?)
        .env(CHILD, &path)
        .stdout(Stdio::piped())
        .spawn()?;
    let mut said = String::new();
    child.stdout.take().ok_or("it has an output")?.read_to_string(&mut said)?;
    assert!(child.wait()?.success(), "{said}");
    let full = said.lines().find_map(|line| line.strip_prefix("full ")).ok_or("it was not full")?;
    let steps: u64 = full.split(' ').next().ok_or("the number of steps")?.parse()?;
    let len = std::fs::metadata(&path)?.len();
    let mut archive = Archive::new(&path, chain()?, EVERY)?;
    assert_eq!(std::fs::metadata(&path)?.len(), len, "the part that was written is gone already");
    assert_eq!(archive.run().steps(), (steps - 1) / 5 * 5);
    archive.take_steps(20)?;
    assert_eq!(place(archive.run()), alone(chain()?, (steps - 1) / 5 * 5 + 20)?);
    Ok(())
}
