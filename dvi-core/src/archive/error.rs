//! What keeps a run from its archive.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::error::{StartError, StepError};

pub use crate::ensemble::error::Difference;

crate::error::said!(ArchiveError);

/// A run that cannot be kept, or not be found again.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::archive::{Archive, ArchiveError, Every};
///
/// # let path = std::env::temp_dir().join(format!("dvi-error-{}", std::process::id()));
/// # let _ = std::fs::remove_file(&path);
/// let begin = || Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start.clone());
/// let mut archive = Archive::new(&path, begin()?, Every::Steps(1000))?;
/// archive.take_steps(100)?;
/// let error = archive.run_at(2.0).unwrap_err();
/// assert!(matches!(error, ArchiveError::Time { t: 2.0, reached: 1.0, .. }));
/// # drop(archive);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Error)]
#[non_exhaustive]
pub enum ArchiveError {
    /// The file cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// Another process has the file.
    #[error("{} is the archive of another process that runs", .path.display())]
    Taken {
        /// The file.
        path: PathBuf,
    },
    /// The file is no archive, or has changed since it was written.
    #[error("{} is no whole archive: {reason}", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: &'static str,
    },
    /// The file is the archive of another run. To begin anew, remove it.
    #[error("{} is the archive of another run: {difference}", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What differs: `what` it is, what is `expected` and what is `found`.
        difference: Difference,
    },
    /// A run cannot go on from a checkpoint of the archive.
    #[error("no run goes on from a checkpoint of the archive: {0}")]
    Start(#[from] StartError),
    /// A step has failed.
    #[error("{0}")]
    Step(#[from] StepError),
    /// The run was never after so many steps.
    #[error("the archive does not have the run after {steps} steps: it has come to {reached}")]
    Steps {
        /// The number that was asked for.
        steps: u64,
        /// How far it has come.
        reached: u64,
    },
    /// The run was never at that time.
    #[error("the archive does not have the run at t = {t}: it has come to t = {reached}")]
    Time {
        /// The time that was asked for.
        t: f64,
        /// How far it has come.
        reached: f64,
    },
}
