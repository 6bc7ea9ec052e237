use crate::step_error::StepError;

/// Why a snapshot cannot be restored into a damper.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The snapshot was written by a version of this library that lays it out otherwise.
    #[error("the snapshot has layout {found}, this version of the library reads {expected}")]
    Version {
        /// The layout that this version reads.
        expected: u32,
        /// The layout of the snapshot.
        found: u32,
    },
    /// The snapshot is of a damper with another number of something.
    #[error("the snapshot has {found} {quantity}, the damper {expected}")]
    Mismatch {
        /// What was counted.
        quantity: &'static str,
        /// How many the damper has.
        expected: usize,
        /// How many the snapshot has.
        found: usize,
    },
    /// The snapshot is of a damper that is set up otherwise.
    #[error("the snapshot is of a damper with another {quantity}")]
    OtherSetup {
        /// What differs.
        quantity: &'static str,
    },
    /// The snapshot was damaged: no damper has such a state.
    #[error("the snapshot is damaged: its {quantity} cannot be")]
    Damaged {
        /// What is wrong in it.
        quantity: &'static str,
    },
    /// The snapshot is not what was taken: it was changed on the way, by a format that does not keep every
    /// bit of a number, for instance.
    #[error(
        "the snapshot was changed on the way: its digest does not fit (a text format has to keep every bit of a number, serde_json with `float_roundtrip`)"
    )]
    Changed,
    /// The contacts cannot be taken up again. The damper has to be restored from another snapshot.
    #[error(transparent)]
    State(#[from] StepError),
}

impl RestoreError {
    /// `Ok` if the damper and the snapshot have as many of a `quantity`.
    pub(super) const fn count(
        quantity: &'static str,
        expected: usize,
        found: usize,
    ) -> Result<(), Self> {
        if expected == found {
            return Ok(());
        }
        Err(Self::Mismatch {
            quantity,
            expected,
            found,
        })
    }

    /// `Ok` if a `quantity` of the snapshot is `sound`.
    pub(super) const fn sound(quantity: &'static str, sound: bool) -> Result<(), Self> {
        if sound {
            return Ok(());
        }
        Err(Self::Damaged { quantity })
    }
}
