//! Snapshots in which memories are numbers.

use std::sync::Arc;

use serde::de::{Deserialize, Deserializer};
use serde::ser::{Error, Serialize, Serializer};

use super::{AnySnapshot, Form};
use crate::damper::Damper;
use crate::damper::neighbours::ContactRecord;
use crate::damper::snapshot::{BareSnapshot, RestoreError, Snapshot};
use crate::law::{ContactLaw, ContactMemory, LawKind};

#[derive(serde::Serialize, serde::Deserialize)]
pub(super) struct Written {
    state: BareSnapshot,
    contacts: [Vec<[u32; 2]>; 2],
    /// What they remember, one after the other.
    told: Vec<f64>,
}

impl Written {
    pub(super) fn new<Memory>(snapshot: &Snapshot<Memory>, told: Vec<f64>) -> Self {
        let bodies = |contact: &ContactRecord<Memory>| [contact.first, contact.second];
        let contacts = snapshot.memory.each_ref();
        Self {
            state: snapshot.state.clone(),
            contacts: contacts.map(|own| own.iter().map(bodies).collect()),
            told,
        }
    }

    pub(super) const fn time(&self) -> f64 {
        self.state.clock.time()
    }

    /// The snapshot, with the memories of which the law of `damper` has told.
    pub(super) fn recalled<C, L: ContactLaw, M, D, I>(
        &self,
        damper: &Damper<C, L, M, D, I>,
    ) -> Result<Snapshot<ContactMemory<L>>, RestoreError> {
        let engine = &damper.engine;
        self.state.check_fit(&engine.state, &damper.setup)?;
        let law = &engine.model.law;
        let mut told = self.told.iter().copied();
        let mut recalled = |[first, second]: [u32; 2]| {
            let memory = L::Kind::recall_memory(law, &mut told)?;
            Some(ContactRecord {
                first,
                second,
                memory,
            })
        };
        let [pairs, walls] = self.contacts.each_ref();
        let pairs = pairs.iter().map(|own| recalled(*own)).collect();
        let walls = walls.iter().map(|own| recalled(*own)).collect();
        let memory: (Option<_>, Option<_>) = (pairs, walls);
        match memory {
            (Some(pairs), Some(walls)) if told.next().is_none() => Ok(Snapshot {
                state: self.state.clone(),
                memory: [pairs, walls],
            }),
            _ => Err(RestoreError::Damaged {
                quantity: "contacts",
            }),
        }
    }
}

/// The numbers of all that contacts remember, if `law` can have them back.
pub(super) fn told<L: ContactLaw>(
    snapshot: &Snapshot<ContactMemory<L>>,
    law: &L,
) -> Option<Vec<f64>> {
    let mut told = Vec::new();
    for contact in snapshot.memory.iter().flatten() {
        let before = told.len();
        L::Kind::tell_memory(law, &contact.memory, &mut |number| told.push(number));
        let mut own = told[before..].iter().copied();
        let same = L::Kind::recall_memory(law, &mut own)? == contact.memory;
        (same && own.next().is_none()).then_some(())?;
    }
    Some(told)
}

impl Serialize for AnySnapshot {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let taken = match &self.0 {
            Form::Taken(taken) => taken,
            Form::Read(written) => return written.serialize(serializer),
        };
        let unwritable = "what contacts remember under this law cannot be had back from the numbers that it tells: see ForceLaw::recall_memory";
        let written = taken
            .written()
            .ok_or_else(|| S::Error::custom(unwritable))?;
        written.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for AnySnapshot {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let written = Written::deserialize(deserializer)?;
        Ok(Self(Form::Read(Arc::new(written))))
    }
}
