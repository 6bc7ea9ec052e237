use std::f64::consts::PI;

use super::lattice::{Frame, Pattern};
use crate::particle::Particle;

/// Relative gap that is kept around every particle.
pub(super) const GAP: f64 = 1e-6;
/// Radii within this ratio share a lattice.
const SAME_SIZE: f64 = 1.25;
/// Widths of the lattices that are tried one after the other, over the diameter.
const LOOSENESS: [f64; 6] = [1.25, 1.15, 1.08, 1.04, 1.015, TIGHTEST];
const TIGHTEST: f64 = 1.0 + GAP;

/// Volume of a sphere, in a plane its area.
pub(super) fn solid_volume(radius: f64, planar: bool) -> f64 {
    if planar {
        PI * radius * radius
    } else {
        4.0 / 3.0 * PI * (radius * radius * radius)
    }
}

/// Particles of similar radii, which share a lattice.
#[derive(Debug)]
pub(super) struct Size {
    /// The largest radius, with its gap.
    pub(super) radius: f64,
    /// Numbers in the bed.
    pub(super) members: Vec<u32>,
    /// Solid volume of these over that of these and all smaller ones.
    pub(super) share: f64,
}

/// The bed sorted into sizes, the largest first.
pub(super) fn sizes(bed: &[Particle], planar: bool) -> Vec<Size> {
    let mut order: Vec<u32> = (0..bed.len() as u32).collect();
    order.sort_by(|&a, &b| bed[b as usize].radius.total_cmp(&bed[a as usize].radius));
    let mut sizes: Vec<Size> = Vec::new();
    for number in order {
        let radius = bed[number as usize].radius * (1.0 + GAP);
        match sizes.last_mut() {
            Some(size) if size.radius <= radius * SAME_SIZE => size.members.push(number),
            _ => sizes.push(Size {
                radius,
                members: vec![number],
                share: 0.0,
            }),
        }
    }
    let mut rest = 0.0;
    for size in sizes.iter_mut().rev() {
        let own = size.members.len() as f64 * solid_volume(size.radius, planar);
        rest += own;
        size.share = own / rest;
    }
    sizes
}

/// One way to fill.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    pub(super) pattern: Pattern,
    pub(super) looseness: f64,
    /// Whether sizes are mixed, or put one above the other to save room.
    pub(super) mixed: bool,
    /// Whether a site stands in the centre, as round cavities like it.
    pub(super) centred: bool,
}

/// Whether what other widths of the same lattice have held leaves little hope for this plan. The
/// tightest one is always tried.
pub(super) fn hopeless(tried: &[(Plan, usize)], plan: Plan, wanted: usize, planar: bool) -> bool {
    plan.looseness > TIGHTEST
        && tried.iter().any(|(other, placed)| {
            let scale = other.looseness / plan.looseness;
            let density = scale * scale * if planar { 1.0 } else { scale };
            other.pattern == plan.pattern && 1.2 * density * (*placed as f64) + 20.0 < wanted as f64
        })
}

/// The ways to fill, the loosest first.
pub(super) fn plans(frame: &Frame, sizes: &[Size]) -> Vec<Plan> {
    let plan = |pattern, looseness| Plan {
        pattern,
        looseness,
        mixed: true,
        centred: false,
    };
    let mut plans = Vec::new();
    let loosest = LOOSENESS[0];
    let floor: f64 = sizes
        .iter()
        .map(|size| {
            let pitch = 2.0 * loosest * size.radius;
            let n = size.members.len() as f64;
            n * if frame.planar { pitch } else { pitch * pitch }
        })
        .sum();
    let room = frame.extent[0] * if frame.planar { 1.0 } else { frame.extent[1] };
    if floor < room {
        plans.push(plan(Pattern::Spread, loosest));
    }
    for pattern in [Pattern::Close, Pattern::Square] {
        plans.extend(LOOSENESS.map(|looseness| plan(pattern, looseness)));
    }
    for pattern in [Pattern::Close, Pattern::Square] {
        plans.push(Plan {
            centred: true,
            ..plan(pattern, TIGHTEST)
        });
    }
    if sizes.len() > 1 {
        for pattern in [Pattern::Close, Pattern::Square] {
            plans.push(Plan {
                mixed: false,
                ..plan(pattern, TIGHTEST)
            });
        }
    }
    plans
}

/// The largest radius among those that were left over after `placed` particles.
pub(super) fn first_without_place(sizes: &[Size], bed: &[Particle], placed: usize) -> f64 {
    let mut left = placed;
    for size in sizes {
        if let Some(&number) = size.members.get(left) {
            return bed[number as usize].radius;
        }
        left -= size.members.len();
    }
    0.0
}
