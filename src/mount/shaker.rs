use glam::DVec3;

use super::{Motion, Mount};
use crate::error::{Bound, ValueError};
use crate::excitation::{Jump, Signal};

/// A container that is moved along an axis by a signal: its displacement in m, whatever the particles do.
///
/// ```
/// use particle_damper::Shaker;
/// use particle_damper::excitation::Harmonic;
/// use particle_damper::glam::DVec3;
///
/// // Upwards, by 2 mm at 30 Hz.
/// let shaker = Shaker::new(DVec3::Y, Harmonic::new(2e-3, 30.0)?)?;
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaker<S> {
    axis: DVec3,
    displacement: S,
}

impl<S: Signal> Shaker<S> {
    /// Motion along `axis` (of any length) by `displacement` (m), from the origin.
    ///
    /// # Errors
    /// If the axis is zero or not finite.
    pub fn new(axis: DVec3, displacement: S) -> Result<Self, ValueError> {
        let length = Bound::Positive.check("length of the axis", axis.length())?;
        Ok(Self {
            axis: axis / length,
            displacement,
        })
    }

    /// Unit vector along which the container moves.
    #[must_use]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The displacement.
    #[must_use]
    pub const fn displacement(&self) -> &S {
        &self.displacement
    }
}

impl<S: Signal> Mount for Shaker<S> {
    #[inline]
    fn motion(&self, time: f64, _x: &[f64], _v: &[f64], _cavity: usize) -> Motion {
        let [displacement, velocity] = self.displacement.at(time);
        Motion::at(self.axis * displacement, self.axis * velocity)
    }

    fn shortest_feature(&self) -> f64 {
        self.displacement.shortest_feature()
    }

    fn jump(&self) -> Option<Jump> {
        self.displacement.jump()
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::excitation::Harmonic;

    #[test]
    fn the_container_follows_the_signal_along_the_axis() {
        let shaker = Shaker::new(dvec3(3.0, 0.0, 4.0), Harmonic::new(0.01, 5.0).unwrap()).unwrap();
        let [x, v] = shaker.displacement().at(0.013);
        let motion = shaker.motion(0.013, &[], &[], 0);
        assert!((motion.position - dvec3(0.6, 0.0, 0.8) * x).length() < 1e-17);
        assert!((motion.velocity - dvec3(0.6, 0.0, 0.8) * v).length() < 1e-15);
        assert!((shaker.shortest_feature() - 0.1).abs() < 1e-15);
        assert!(Shaker::new(DVec3::ZERO, |_: f64| [0.0; 2]).is_err());
    }
}
