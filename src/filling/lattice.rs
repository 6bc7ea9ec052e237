use std::ops::Range;

use glam::{DVec3, dvec3};

/// How far outside a row may end, over the pitch.
const OUTSIDE: f64 = 0.5;

/// The bounding box of a cavity, seen upwards: two axes across and one up, counted from the lowest
/// corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) corner: DVec3,
    /// Along, across (unused in a plane) and up.
    pub(super) axes: [DVec3; 3],
    pub(super) extent: [f64; 3],
    pub(super) planar: bool,
}

impl Frame {
    /// The box `bounds` with the unit vector `up`, which lies in the plane z = 0 of a planar cavity.
    pub(super) fn new(bounds: [DVec3; 2], up: DVec3, planar: bool) -> Self {
        let (along, across) = if planar {
            (dvec3(up.y, -up.x, 0.0), DVec3::Z)
        } else {
            up.any_orthonormal_pair()
        };
        let axes = [along, across, up];
        let [low, high] = bounds;
        let middle = 0.5 * (low + high);
        let extent = axes.map(|axis| axis.abs().dot(high - low));
        let corner = (0..3).fold(middle, |corner, i| corner - axes[i] * (0.5 * extent[i]));
        Self {
            corner,
            axes,
            extent,
            planar,
        }
    }

    /// The largest distance of a corner from the origin of coordinates, or more.
    pub(super) fn reach(&self) -> f64 {
        self.corner.length() + DVec3::from(self.extent).length()
    }

    /// A point of the box, by a number from 0 to 1 along each axis.
    pub(super) fn point(&self, mut unit: impl FnMut() -> f64) -> DVec3 {
        (0..3).fold(self.corner, |point, axis| {
            point + self.axes[axis] * (self.extent[axis] * unit())
        })
    }

    /// Room for centres of spheres of `radius` along an axis.
    pub(super) fn span(&self, axis: usize, radius: f64) -> f64 {
        self.extent[axis] - 2.0 * radius
    }
}

/// How the sites of a lattice stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pattern {
    /// Rows over gaps: triangles in the plane, hexagonal close packing in space.
    Close,
    /// Squares in the plane, cubes in space.
    Square,
    /// Squares as wide as to hold all in the lowest layer.
    Spread,
}

/// Sites on which equal spheres do not overlap, in layers from the floor up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    frame: Frame,
    radius: f64,
    /// Distance of sites in a row, of rows and of layers in m.
    pitch: [f64; 3],
    /// How far every second row is shifted along, and every second layer along and across.
    row_shift: f64,
    layer_shift: [f64; 2],
    /// Where row 0 of layer 0 begins, from the first place that a centre can have.
    start: [f64; 3],
    /// How far a sphere may leave its site along each axis.
    pub(super) slack: [f64; 3],
}

impl Lattice {
    /// A lattice for `count` spheres of `radius`, `looseness` times as wide as they need.
    pub(super) fn new(
        frame: Frame,
        pattern: Pattern,
        radius: f64,
        looseness: f64,
        count: usize,
    ) -> Self {
        let s = 2.0 * radius * looseness;
        let spare = s - 2.0 * radius;
        let (row, third) = (s * 0.75_f64.sqrt(), s / 12_f64.sqrt());
        let (pitch, row_shift, layer_shift) = match (pattern, frame.planar) {
            (Pattern::Close, true) => ([s, s, row], 0.0, [0.5 * s, 0.0]),
            (Pattern::Close, false) => {
                let layer = s * (2.0_f64 / 3.0).sqrt();
                ([s, row, layer], 0.5 * s, [0.5 * s, third])
            }
            (Pattern::Square, _) => ([s; 3], 0.0, [0.0; 2]),
            (Pattern::Spread, planar) => {
                let (a, b) = (frame.span(0, radius), frame.span(1, radius));
                let n = count.max(1) as f64;
                let wide = if planar { a / n } else { (a * b / n).sqrt() };
                ([wide.max(s), wide.max(s), s], 0.0, [0.0; 2])
            }
        };
        // Two neighbours that leave their sites by half the spare length each just do not meet.
        let slack = match (pattern, frame.planar) {
            (Pattern::Close, true) => [spare / 8.0_f64.sqrt(); 3],
            (Pattern::Close, false) => [spare / 12.0_f64.sqrt(); 3],
            _ => pitch.map(|pitch| 0.5 * (pitch - 2.0 * radius)),
        };
        Self {
            frame,
            radius,
            pitch,
            row_shift,
            layer_shift,
            start: [0.0, 0.0, slack[2].min(0.5 * frame.span(2, radius)).max(0.0)],
            slack,
        }
    }

    /// The same lattice, moved along and across by `phase` (0 to 1) times the room that its longest
    /// rows leave.
    pub(super) fn moved(mut self, phase: [f64; 2]) -> Self {
        for (axis, phase) in phase.into_iter().enumerate() {
            let left = self.frame.span(axis, self.radius).max(0.0) % self.pitch[axis];
            let shift = self.layer_shift[axis];
            // Shifted layers keep their last site.
            let free = if shift > 0.0 { left % shift } else { left };
            self.start[axis] = phase * free;
        }
        self
    }

    /// The same lattice with a site in the centre of the bounding box.
    pub(super) fn centred(mut self) -> Self {
        let middle = |axis: usize| 0.5 * self.frame.span(axis, self.radius).max(0.0);
        let [a, b, c] = self.pitch;
        let layer = ((middle(2) / c) as i64).rem_euclid(2) as f64;
        let across = middle(1) - layer * self.layer_shift[1];
        let row = ((across / b).floor() as i64).rem_euclid(2) as f64;
        let along = middle(0) - row * self.row_shift - layer * self.layer_shift[0];
        self.start = [along.rem_euclid(a), across.rem_euclid(b), middle(2) % c];
        self
    }

    pub(super) fn layers(&self) -> Range<i64> {
        0..1 + ((self.frame.span(2, self.radius) - self.start[2]) / self.pitch[2]).floor() as i64
    }

    /// The rows of a layer, those included that begin less than half a pitch outside.
    pub(super) fn rows(&self, layer: i64) -> Range<i64> {
        if self.frame.planar {
            return 0..1;
        }
        let start = self.start[1] + (layer % 2) as f64 * self.layer_shift[1];
        self.within(1, start)
    }

    /// The first site of a row, and the row's number of sites.
    pub(super) fn row(&self, layer: i64, row: i64) -> (DVec3, i64) {
        let odd = (layer % 2) as f64;
        let start =
            self.start[0] + row.rem_euclid(2) as f64 * self.row_shift + odd * self.layer_shift[0];
        let numbers = self.within(0, start);
        let from_corner = [
            start + numbers.start as f64 * self.pitch[0],
            self.start[1] + odd * self.layer_shift[1] + row as f64 * self.pitch[1],
            self.start[2] + layer as f64 * self.pitch[2],
        ];
        let mut site = self.frame.corner;
        for (number, (axis, place)) in self.frame.axes.into_iter().zip(from_corner).enumerate() {
            if !(self.frame.planar && number == 1) {
                site += axis * (self.radius + place);
            }
        }
        (site, numbers.end - numbers.start)
    }

    /// From one site of a row to the next.
    pub(super) fn stride(&self) -> DVec3 {
        self.frame.axes[0] * self.pitch[0]
    }

    /// Numbers of the places `start + number * pitch` along an axis that a centre can have, or that
    /// are less than half a pitch outside.
    fn within(&self, axis: usize, start: f64) -> Range<i64> {
        let (pitch, span) = (self.pitch[axis], self.frame.span(axis, self.radius));
        let first = (-start / pitch).ceil() as i64;
        let last = ((span - start) / pitch + OUTSIDE).floor() as i64;
        first..last + 1
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn spheres_that_use_their_slack_do_not_overlap(
            size in prop::array::uniform3(2.5..9.0_f64),
            looseness in 1.0..1.6_f64,
            phase in prop::array::uniform2(0.0..1.0_f64),
            (planar, centred) in (any::<bool>(), any::<bool>()),
            pattern in prop::sample::select(&[Pattern::Close, Pattern::Square, Pattern::Spread][..]),
        ) {
            let high = if planar { dvec3(size[0], size[1], 0.0) } else { DVec3::from(size) };
            let frame = Frame::new([DVec3::ZERO, high], DVec3::Y, planar);
            let lattice = Lattice::new(frame, pattern, 1.0, looseness, 3);
            let lattice = if centred { lattice.centred() } else { lattice.moved(phase) };
            let mut sites = Vec::new();
            for layer in lattice.layers() {
                for row in lattice.rows(layer) {
                    let (start, count) = lattice.row(layer, row);
                    sites.extend((0..count).map(|i| start + lattice.stride() * i as f64));
                }
            }
            let slack = DVec3::from(lattice.slack);
            let slack = dvec3(slack.x, slack.z, if planar { 0.0 } else { slack.y });
            for (number, site) in sites.iter().enumerate() {
                for other in &sites[..number] {
                    let step = (*site - *other).abs();
                    // Towards each other along every axis, for patterns that allow it.
                    let least = if pattern == Pattern::Close {
                        step.length() - 2.0 * slack.length()
                    } else {
                        (step - 2.0 * slack).max(DVec3::ZERO).max_element()
                    };
                    prop_assert!(least > 2.0 - 1e-12, "{site} {other} {least}");
                }
            }
            if centred {
                let middle = 0.5 * high;
                prop_assert!(sites.iter().any(|site| site.distance(middle) < 1e-12));
            }
        }
    }
}
