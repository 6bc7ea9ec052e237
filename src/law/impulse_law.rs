use super::{ContactLaw, Impulses, SolverParameters};

/// A contact law that gives numbers: how bodies rebound and what friction they have. From them the
/// contact dynamics solver works out the impulses of all contacts together, once a step, and holds them
/// over it.
///
/// # Using
/// [`RestitutionImpulse`](crate::RestitutionImpulse) is the paper's approximate law. What the solver does,
/// and its numbers, are on [`SolverParameters`].
///
/// # Implementing
/// 1. [`restitution`](Self::restitution) is asked once a step of each contact whose bodies approach faster
///    than the restitution threshold; slower ones come to rest on each other.
/// 2. [`friction`](Self::friction) and [`rolling_arm`](Self::rolling_arm) are asked of every contact; both
///    are zero unless given.
/// 3. All three must be functions of their arguments: same arguments, same bits.
/// 4. The solver's parameters are its defaults unless the law has [its own](Self::solver).
///
/// Restitution that falls with the speed of approach, e = exp(-v/v0), complete:
/// ```
/// use particle_damper::{Bodies, ContactLaw, ImpulseLaw, Impulses, LawError};
///
/// struct Fading {
///     speed: f64, // v0, m/s
///     friction: f64,
/// }
///
/// impl ContactLaw for Fading {
///     type Kind = Impulses;
///     type Coefficients = f64; // longest step, s
///
///     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
///         Ok(0.1 * bodies.first.radius / self.speed)
///     }
///     fn time_step_limit(&self, longest: &f64) -> f64 {
///         *longest
///     }
/// }
///
/// impl ImpulseLaw for Fading {
///     fn restitution(&self, _: &f64, approach_speed: f64) -> f64 {
///         (-approach_speed / self.speed).exp()
///     }
///     fn friction(&self, _: &f64) -> f64 {
///         self.friction
///     }
/// }
/// ```
pub trait ImpulseLaw: ContactLaw<Kind = Impulses> {
    /// Restitution coefficient, 0 to 1, of bodies that approach each other along the normal at
    /// `approach_speed` (m/s, positive). An answer outside that range counts as the nearer end of it.
    fn restitution(&self, coefficients: &Self::Coefficients, approach_speed: f64) -> f64;

    /// Coefficient of sliding friction, not negative.
    #[inline]
    fn friction(&self, _coefficients: &Self::Coefficients) -> f64 {
        0.0
    }

    /// Lever in m, not negative, by which the normal force resists rolling: the couple is this times the
    /// force at the most.
    #[inline]
    fn rolling_arm(&self, _coefficients: &Self::Coefficients) -> f64 {
        0.0
    }

    /// What the contact dynamics solver is set to.
    fn solver(&self) -> SolverParameters {
        SolverParameters::default()
    }
}

macro_rules! forward_law {
    ($reference:ty) => {
        impl<L: ImpulseLaw + ?Sized> ImpulseLaw for $reference {
            #[inline]
            fn restitution(&self, coefficients: &Self::Coefficients, approach_speed: f64) -> f64 {
                (**self).restitution(coefficients, approach_speed)
            }

            #[inline]
            fn friction(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).friction(coefficients)
            }

            #[inline]
            fn rolling_arm(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).rolling_arm(coefficients)
            }

            fn solver(&self) -> SolverParameters {
                (**self).solver()
            }
        }
    };
}

forward_law!(&L);
forward_law!(&mut L);
forward_law!(Box<L>);
