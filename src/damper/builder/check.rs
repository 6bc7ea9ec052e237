//! What a damper is built from: whatever can be refused is.

use glam::DVec3;

use super::{BuildError, Settings};
use crate::cavity::Cavity;
use crate::damper::neighbours::BLOCK;
use crate::error::{Bound, ValueError};
use crate::mount::Mount;
use crate::particle::Particle;

/// The most walls: each block of particles keeps a sum for each.
const MOST_WALLS: u64 = 1 << 20;

/// Refuses what cannot be of numbers, cavities, particles and what drives the `mount`; the number of walls.
pub(super) fn check<C: Cavity>(
    settings: &Settings,
    cavities: &[C],
    mount: &dyn Mount,
) -> Result<usize, BuildError> {
    check_numbers(settings, cavities.iter().any(Cavity::is_planar))?;
    if let Some(jump) = mount.jump() {
        return Err(BuildError::BaseJumps(jump));
    }
    let walls = check_counts(&settings.particles, cavities)?;
    let limits = cavity_limits(cavities);
    check_particles(&settings.particles, &limits, settings.initial_overlap)?;
    Ok(walls)
}

/// Refuses numbers that cannot be.
fn check_numbers(settings: &Settings, planar: bool) -> Result<(), BuildError> {
    for component in settings.gravity.to_array() {
        Bound::Finite.check("gravity (m/s^2)", component)?;
    }
    if let Some(time_step) = settings.time_step {
        Bound::Positive.check("time step (s)", time_step)?;
    }
    Bound::Finite.check("start time (s)", settings.start_time)?;
    let quantity = "initial overlap (fraction of a radius)";
    Bound::NonNegative.check(quantity, settings.initial_overlap)?;
    let overlap_limit = settings.overlap_limit;
    if overlap_limit.is_nan() || overlap_limit <= 0.0 {
        Bound::Positive.check("overlap limit (fraction of a radius)", overlap_limit)?;
    }
    if planar {
        in_plane("gravity", settings.gravity)?;
    }
    Ok(())
}

/// Refuses more particles or walls than can be numbered; the number of walls.
fn check_counts<C: Cavity>(particles: &[Particle], cavities: &[C]) -> Result<usize, BuildError> {
    let limit = u32::MAX as usize - BLOCK;
    if particles.len() > limit {
        return Err(BuildError::TooManyParticles {
            count: particles.len(),
            limit,
        });
    }
    let walls = cavities.iter().map(|cavity| u64::from(cavity.walls()));
    let walls = walls.sum();
    if walls > MOST_WALLS {
        return Err(BuildError::TooManyWalls {
            count: walls,
            limit: MOST_WALLS,
        });
    }
    Ok(walls as usize)
}

/// What a cavity bears.
struct CavityLimits {
    planar: bool,
    /// The least width of its bounds, m.
    extent: f64,
    /// The radius of its sharpest inner edge, m.
    rounding: f64,
}

/// What each of `cavities` bears.
fn cavity_limits<C: Cavity>(cavities: &[C]) -> Vec<CavityLimits> {
    let limits = |cavity: &C| {
        let planar = cavity.is_planar();
        let [low, high] = cavity.bounds();
        let size = high - low;
        CavityLimits {
            planar,
            extent: if planar {
                size.x.min(size.y)
            } else {
                size.min_element()
            },
            rounding: cavity.rounding(),
        }
    };
    cavities.iter().map(limits).collect()
}

/// Refuses particles that cannot be, or not in their cavity.
fn check_particles(
    particles: &[Particle],
    limits: &[CavityLimits],
    initial_overlap: f64,
) -> Result<(), BuildError> {
    let radii = particles.iter().map(|particle| particle.radius);
    let squeeze = initial_overlap * radii.fold(f64::INFINITY, f64::min);
    for (number, particle) in particles.iter().enumerate() {
        check_particle(particle).map_err(|error| BuildError::Particle {
            particle: number,
            error,
        })?;
        let Some(limits) = limits.get(particle.cavity as usize) else {
            return Err(BuildError::UnknownCavity {
                particle: number,
                cavity: particle.cavity,
                cavities: limits.len(),
            });
        };
        if limits.planar {
            in_plane("particle position", particle.position)?;
            in_plane("particle velocity", particle.velocity)?;
            if particle.spin.x != 0.0 || particle.spin.y != 0.0 {
                return Err(BuildError::OutOfPlane {
                    quantity: "particle spin",
                    value: particle.spin,
                });
            }
        }
        // Pressed into two opposite walls at once.
        if 2.0 * particle.radius > limits.extent + 2.0 * squeeze {
            return Err(BuildError::TooLarge {
                particle: number,
                diameter: 2.0 * particle.radius,
                extent: limits.extent,
            });
        }
        if particle.radius > limits.rounding {
            return Err(BuildError::TooLargeForEdge {
                particle: number,
                radius: particle.radius,
                rounding: limits.rounding,
            });
        }
    }
    Ok(())
}

fn check_particle(particle: &Particle) -> Result<(), ValueError> {
    Bound::Positive.check("radius (m)", particle.radius)?;
    Bound::Positive.check("mass (kg)", particle.mass)?;
    // Their reciprocals have to be finite.
    let smallest = Bound::AtLeast(f64::MIN_POSITIVE);
    smallest.check("mass (kg)", particle.mass)?;
    smallest.check("moment of inertia (kg m^2)", particle.inertia())?;
    for (quantity, vector) in [
        ("position (m)", particle.position),
        ("velocity (m/s)", particle.velocity),
        ("spin (rad/s)", particle.spin),
    ] {
        for component in vector.to_array() {
            Bound::Finite.check(quantity, component)?;
        }
    }
    Ok(())
}

/// Refuses a vector that leaves the plane z = 0.
pub(super) fn in_plane(quantity: &'static str, value: DVec3) -> Result<(), BuildError> {
    if value.z == 0.0 {
        Ok(())
    } else {
        Err(BuildError::OutOfPlane { quantity, value })
    }
}
