use super::structure::Complex;
use super::{Effect, Field, ModalStructure};
use crate::error::{Bound, ValueError};

/// The bed's part of the structure's mass beyond which a solution is doubtful.
const HEAVY: f64 = 0.05;
/// The third harmonic's part of the motion beyond which it is.
const NO_SINE: f64 = 0.02;
/// Amplitudes at which solutions are sought, evenly over the logarithm; between two of them at most one may
/// begin.
const SCAN: usize = 600;

/// A field put on a structure.
#[derive(Debug, Clone)]
pub struct EquivalentDamper<F> {
    structure: ModalStructure,
    field: F,
}

/// A steady motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// Amplitude at the damper in m.
    pub amplitude: f64,
    /// Amplitude at the point that is watched in m.
    pub watched: f64,
    /// What the damper does there.
    pub effect: Effect,
    /// Whether the amplitude grows with the force. Of several solutions those that do not are never seen. (One
    /// that does may still be unstable in another way.)
    pub stable: bool,
    /// Mass of the bed over that of the structure: the least modal mass at the damper.
    pub mass_ratio: f64,
    /// Third harmonic of the motion at the damper over its amplitude, where the field knows it.
    pub distortion: Option<f64>,
}

impl Solution {
    /// Whether the [limits](super#what-it-is-worth) of the shortcut are passed: a bed above a twentieth of the
    /// structure's mass, or a third harmonic above a fiftieth of the motion.
    #[must_use]
    pub fn doubtful(&self) -> bool {
        self.mass_ratio > HEAVY || self.distortion.is_some_and(|part| part > NO_SINE)
    }
}

/// A resonance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BackbonePoint {
    /// Amplitude at the damper in m.
    pub amplitude: f64,
    /// Angular frequency in rad/s at which the structure resonates with the damper's apparent mass.
    pub angular_frequency: f64,
    /// Amplitude in N of the force that keeps it there.
    pub force: f64,
    /// What the damper does there.
    pub effect: Effect,
}

impl<F: Field> EquivalentDamper<F> {
    /// A field on a structure.
    #[must_use]
    pub const fn new(structure: ModalStructure, field: F) -> Self {
        Self { structure, field }
    }

    /// The field.
    #[must_use]
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// 1 + H_dd D: by how much the damper reduces its own motion.
    fn reduction(&self, effect: &Effect, w: f64) -> Complex {
        let inertia = -w * w * effect.apparent_mass;
        let damping = w * effect.viscous_coefficient;
        Complex::new(1.0, 0.0) + self.structure.at_damper(w) * Complex::new(inertia, damping)
    }

    /// The amplitude in m that an amplitude at the damper would have been without it.
    fn undamped(&self, amplitude: f64, w: f64) -> Result<f64, ValueError> {
        let effect = self.field.at(amplitude, w)?;
        Ok(amplitude * self.reduction(&effect, w).abs())
    }

    /// All steady motions under a force of amplitude `force` (N) at `angular_frequency` (rad/s), by rising
    /// amplitude. None if the field has no amplitude at which forces balance: then it is outside what the
    /// field knows, or, of a field that is a closed form, what happens is not what the form describes.
    ///
    /// # Errors
    /// If the force is negative, the frequency is not positive, or the field has no answer at it.
    pub fn solutions(
        &self,
        force: f64,
        angular_frequency: f64,
    ) -> Result<Vec<Solution>, ValueError> {
        let force = Bound::NonNegative.check("amplitude of the force (N)", force)?;
        let w = Bound::Positive.check("angular frequency (rad/s)", angular_frequency)?;
        let asked = force * self.structure.to_damper(w).abs();
        Bound::Finite.check("amplitude of the structure without the damper (m)", asked)?;
        let excess = |amplitude: f64| Ok(self.undamped(amplitude, w)? - asked);
        let mut solutions = Vec::new();
        for (amplitude, stable) in roots(self.field.amplitudes(w), excess)? {
            solutions.push(self.solution(amplitude, stable, force, w)?);
        }
        if solutions.is_empty() {
            // Says so if it is for want of an answer at this frequency.
            let [low, high] = self.field.amplitudes(w);
            self.field.at(low.min(high), w)?;
        }
        Ok(solutions)
    }

    fn solution(
        &self,
        amplitude: f64,
        stable: bool,
        force: f64,
        w: f64,
    ) -> Result<Solution, ValueError> {
        let effect = self.field.at(amplitude, w)?;
        let structure = &self.structure;
        // The damper's motion and force, over those of the driving force.
        let moved = structure.to_damper(w) / self.reduction(&effect, w);
        let inertia = w * w * effect.apparent_mass;
        let pushed = moved * Complex::new(inertia, -w * effect.viscous_coefficient);
        let watched = structure.to_watch(w) + structure.damper_to_watch(w) * pushed;
        let distortion = |third: f64| third * structure.at_damper(3.0 * w).abs() / amplitude;
        Ok(Solution {
            amplitude,
            watched: force * watched.abs(),
            effect,
            stable,
            mass_ratio: self.field.bed_mass() / structure.mass_at_damper(),
            distortion: effect.third_harmonic.map(distortion),
        })
    }

    /// The lowest resonance of the structure with the damper's apparent mass at each of `amplitudes` (m): where
    /// force and velocity at the damper are in phase but for damping. Amplitudes at which the field has no
    /// answer, or none at the resonance, are left out.
    ///
    /// # Errors
    /// If an amplitude is not positive.
    pub fn backbone(&self, amplitudes: &[f64]) -> Result<Vec<BackbonePoint>, ValueError> {
        let mut points = Vec::new();
        for &amplitude in amplitudes {
            Bound::Positive.check("amplitude (m)", amplitude)?;
            points.extend(self.resonance(amplitude));
        }
        Ok(points)
    }

    /// The stiffness that is left of the structure and the damper's apparent mass, at the damper.
    fn stiffness_left(&self, amplitude: f64, w: f64) -> Option<f64> {
        let effect = self.field.at(amplitude, w).ok()?;
        let own = Complex::new(1.0, 0.0) / self.structure.at_damper(w);
        Some(own.re - w * w * effect.apparent_mass)
    }

    fn resonance(&self, amplitude: f64) -> Option<BackbonePoint> {
        let lowest = self.structure.lowest();
        // From below, where stiffness prevails, to where inertia does.
        let at = |n: u32| lowest * (0.2 + 0.005 * f64::from(n));
        let mut before = None;
        for n in 0..=560 {
            let now = self.stiffness_left(amplitude, at(n));
            if let (Some(left), Some(right)) = (before, now)
                && left > 0.0
                && right <= 0.0
            {
                return self.resonance_between(amplitude, at(n - 1), at(n));
            }
            before = now;
        }
        None
    }

    fn resonance_between(
        &self,
        amplitude: f64,
        mut low: f64,
        mut high: f64,
    ) -> Option<BackbonePoint> {
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if self.stiffness_left(amplitude, middle)? > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let effect = self.field.at(amplitude, high).ok()?;
        let moved = self.structure.to_damper(high) / self.reduction(&effect, high);
        Some(BackbonePoint {
            amplitude,
            angular_frequency: high,
            force: amplitude / moved.abs(),
            effect,
        })
    }
}

/// Where a function of the amplitude vanishes between two ends, and whether it rises there.
fn roots(
    [low, high]: [f64; 2],
    value: impl Fn(f64) -> Result<f64, ValueError>,
) -> Result<Vec<(f64, bool)>, ValueError> {
    let mut roots = Vec::new();
    if low > high || high <= 0.0 {
        return Ok(roots);
    }
    // From zero, seven decades do for the logarithm.
    let begin = low.max(1e-7 * high);
    let ratio = libm::log(high / begin) / SCAN as f64;
    let at = |n: usize| match n {
        0 => begin,
        SCAN => high,
        _ => (begin * libm::exp(ratio * n as f64)).min(high),
    };
    let scan = (0..=SCAN).map(|n| Ok((at(n), value(at(n))?)));
    let scan: Vec<(f64, f64)> = scan.collect::<Result<_, _>>()?;
    let mut nodes = scan.clone();
    for three in scan.windows(3) {
        // Two zeros may hide about an extreme between neighbours on the same side of zero.
        if turns_to_zero([three[0].1, three[1].1, three[2].1]) {
            let positive = three[1].1 >= 0.0;
            nodes.push(extreme(three[0].0, three[2].0, positive, &value)?);
        }
    }
    nodes.sort_by(|one, other| one.0.total_cmp(&other.0));
    for pair in nodes.windows(2) {
        let [low, high] = [pair[0], pair[1]];
        if (low.1 < 0.0) != (high.1 < 0.0) {
            roots.push((bisect(low, high.0, &value)?, high.1 > low.1));
        }
    }
    Ok(roots)
}

/// Whether three values of one sign have the one nearest to zero in the middle.
fn turns_to_zero(values: [f64; 3]) -> bool {
    let [before, here, after] = values.map(f64::abs);
    let same = values
        .iter()
        .all(|value| (*value < 0.0) == (values[1] < 0.0));
    same && here <= before && here <= after
}

/// The value nearest to zero, or past it, between two amplitudes: golden section.
fn extreme(
    mut low: f64,
    mut high: f64,
    positive: bool,
    value: &impl Fn(f64) -> Result<f64, ValueError>,
) -> Result<(f64, f64), ValueError> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let distance = |amplitude: f64| -> Result<f64, ValueError> {
        let value = value(amplitude)?;
        Ok(if positive { value } else { -value })
    };
    for _ in 0..50 {
        let width = golden * (high - low);
        if distance(high - width)? < distance(low + width)? {
            high = low + width;
        } else {
            low = high - width;
        }
    }
    let middle = f64::midpoint(low, high);
    Ok((middle, value(middle)?))
}

/// The zero between two amplitudes with values of opposite sign.
fn bisect(
    (mut low, at_low): (f64, f64),
    mut high: f64,
    value: &impl Fn(f64) -> Result<f64, ValueError>,
) -> Result<f64, ValueError> {
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if (value(middle)? < 0.0) == (at_low < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests;
