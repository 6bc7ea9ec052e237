use super::{Excitation, Jump, Signal};
use crate::error::{Bound, ValueError};

/// A signal or excitation of one's own that states its shortest feature, which a closure cannot:
/// a damper then refuses steps that would pass over it.
///
/// ```
/// use particle_damper::excitation::{Excitation, Featured};
///
/// // A square pulse of 50 N and half a millisecond.
/// let blow = |t: f64| if (0.1..0.1005).contains(&t) { 50.0 } else { 0.0 };
/// let blow = Featured::new(5e-4, blow)?;
/// assert_eq!(blow.shortest_feature(), 5e-4);
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Featured<E> {
    shortest: f64,
    own: E,
}

impl<E> Featured<E> {
    /// `own`, of which the shortest feature lasts `shortest` (s); see
    /// [`Excitation::shortest_feature`].
    ///
    /// # Errors
    /// If the time is not positive and finite.
    pub fn new(shortest: f64, own: E) -> Result<Self, ValueError> {
        Ok(Self {
            shortest: Bound::Positive.check("shortest feature (s)", shortest)?,
            own,
        })
    }
}

impl<E: Excitation> Excitation for Featured<E> {
    #[inline]
    fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64 {
        self.own.force(time, damping, stiffness)
    }

    fn shortest_feature(&self) -> f64 {
        self.shortest
    }

    fn jump(&self) -> Option<Jump> {
        self.own.jump()
    }
}

impl<S: Signal> Signal for Featured<S> {
    #[inline]
    fn at(&self, time: f64) -> [f64; 2] {
        self.own.at(time)
    }

    #[inline]
    fn value(&self, time: f64) -> f64 {
        self.own.value(time)
    }

    fn shortest_feature(&self) -> f64 {
        self.shortest
    }

    fn jump(&self) -> Option<Jump> {
        self.own.jump()
    }
}
