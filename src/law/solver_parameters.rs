use crate::error::{Bound, ValueError};

/// In which order a sweep goes through the contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SweepOrder {
    /// One after the other, each with the velocities that those before it left (Gauss-Seidel); to and fro,
    /// so that an impulse crosses a bed in one sweep whichever way it goes.
    #[default]
    Sequential,
    /// All from the same velocities (Jacobi).
    Simultaneous,
}

/// What the contact dynamics solver is set to, which works out the impulses of a step under an
/// [`ImpulseLaw`](crate::ImpulseLaw).
///
/// The method is nonsmooth contact dynamics: Moreau's time stepping with projected Gauss-Seidel sweeps.
/// M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235, doi 10.1016/S0045-7825(98)00383-1; F. Radjai
/// and V. Richefeu, Mech. Mater. 41 (2009) 715, doi 10.1016/j.mechmat.2009.01.028. Its stages in a step:
///
/// 1. **Predict**: all bodies stand where they will be at [`prediction`](Self::prediction) of the step.
/// 2. **Prepare** a contact constraint for each two bodies that touch there, or will within the step: the
///    active contacts, by their speed of approach or by the load that they bore and that presses them
///    together again (speculative contacts). Each has a target, the speed of separation that it has to leave: e times the speed
///    of approach v at the *start* of the step; or, if v is below the
///    [restitution threshold](Self::restitution_threshold), what
///    [position correction](Self::position_correction) asks for.
/// 3. **Free velocities**: gravity and excitation act over the step; then the **warm start**: contacts at
///    rest give what they gave in the step before.
/// 4. **Sweeps**: each contact changes its impulse by what leaves its target, but never pulls; and its
///    friction by what ends the slip, but no further than mu times the normal impulse. The same for
///    rolling.
/// 5. **Apply**: the impulses over the time step are the forces of Eq. (12), which hold over it. If all
///    of them together would leave more kinetic energy than the free velocities had, position correction
///    apart, all are made smaller by one factor until they do not: restitution with friction can create
///    energy (Kane's paradox), and what a warm start gives in excess can.
///
/// Of two bodies alone this gives Eqs (10) and (11).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SolverParameters {
    /// How often a step goes through the contacts, at least once; 2 unless set. Two are as accurate as four
    /// in a damper. A heavy body on light ones wants more: 4 at a mass ratio of 60, 16 at 150.
    pub sweeps: u32,
    /// In which order; [sequential](SweepOrder::Sequential) unless set.
    pub order: SweepOrder,
    /// Bodies that approach no faster than this times what a free body gains on its container over the
    /// step (by gravity and the container's acceleration) do not rebound but come to rest on each other.
    /// Not negative; 2 unless set.
    pub restitution_threshold: f64,
    /// Part of an overlap beyond the [slop](Self::slop) that a step gives back (Baumgarte's factor), 0 to
    /// 1; 0.2 unless set. Bodies do not part faster for it than a free body falls over the step, and their
    /// load would press them together: so it gives no energy that was not lost before.
    pub position_correction: f64,
    /// Overlap that is left alone, as a fraction of the smaller radius. Not negative; 0.01 unless set.
    pub slop: f64,
    /// Part of the impulse of the step before that a contact at rest starts from, 0 to 1; 1 unless set:
    /// then a pile at rest stays where it is. At 0.9 it creeps (0.002 radii in five seconds).
    pub warm_start: f64,
    /// Where in the step contacts are looked for, as a fraction of it, 0 to 1/2. Unless set it is 1/2, the
    /// midpoint: then impacts come neither early nor late on the mean, and angular momentum is exact.
    pub prediction: f64,
    /// Whether impulses that would create energy are made smaller (stage 5); true unless set.
    pub energy_bound: bool,
}

impl Default for SolverParameters {
    fn default() -> Self {
        Self {
            sweeps: 2,
            order: SweepOrder::Sequential,
            restitution_threshold: 2.0,
            position_correction: 0.2,
            slop: 0.01,
            warm_start: 1.0,
            prediction: 0.5,
            energy_bound: true,
        }
    }
}

impl SolverParameters {
    /// Eqs (10) to (12) as they are printed: bodies that overlap at the start of the step, all at once
    /// from the velocities there, and nothing that keeps resting ones from sinking.
    #[must_use]
    pub const fn literal() -> Self {
        Self {
            sweeps: 1,
            order: SweepOrder::Simultaneous,
            restitution_threshold: 0.0,
            position_correction: 0.0,
            slop: 0.0,
            warm_start: 0.0,
            prediction: 0.0,
            energy_bound: false,
        }
    }

    /// The same with another number of sweeps.
    #[must_use]
    pub const fn with_sweeps(mut self, sweeps: u32) -> Self {
        self.sweeps = sweeps;
        self
    }

    /// Tells every number.
    pub(crate) fn tell(&self, tell: &mut dyn FnMut(f64)) {
        let Self {
            sweeps,
            order,
            restitution_threshold,
            position_correction,
            slop,
            warm_start,
            prediction,
            energy_bound,
        } = *self;
        let simultaneous = order == SweepOrder::Simultaneous;
        let flags = [
            f64::from(sweeps),
            f64::from(simultaneous),
            f64::from(energy_bound),
        ];
        let numbers = [
            restitution_threshold,
            position_correction,
            slop,
            warm_start,
            prediction,
        ];
        flags.into_iter().chain(numbers).for_each(tell);
    }

    /// Refuses numbers that are out of range: the fields can be set without asking.
    pub(crate) fn check(&self) -> Result<(), ValueError> {
        Bound::AtLeast(1.0).check("sweeps of the contact solver", f64::from(self.sweeps))?;
        for (quantity, value) in [
            ("restitution threshold", self.restitution_threshold),
            ("slop (fraction of a radius)", self.slop),
        ] {
            Bound::NonNegative.check(quantity, value)?;
        }
        for (quantity, value) in [
            ("position correction", self.position_correction),
            ("warm-start factor", self.warm_start),
        ] {
            Bound::Within(0.0, 1.0).check(quantity, value)?;
        }
        Bound::Within(0.0, 0.5).check("prediction (fraction of a step)", self.prediction)?;
        Ok(())
    }
}
