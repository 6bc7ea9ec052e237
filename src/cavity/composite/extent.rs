//! How far bodies reach, and how thin and how round they are.

use glam::DVec3;

use super::solid::{Placed, Profile, Solid};

const EVERYWHERE: [DVec3; 2] = [DVec3::NEG_INFINITY, DVec3::INFINITY];

impl Solid {
    /// Takes what is as long as the plane z = 0 is deep for endless: in the plane that is no edge of it.
    pub(super) fn extend_across(&mut self, axes: &glam::DMat3) {
        match self {
            Self::Block { core, .. } => {
                for axis in 0..3 {
                    if axes.col(axis).z != 0.0 {
                        core[axis] = f64::INFINITY;
                    }
                }
            }
            Self::Revolved(Profile::Disc { core, .. }) if axes.y_axis.z != 0.0 => {
                core.y = f64::INFINITY;
            }
            _ => {}
        }
    }
}

impl Placed {
    /// The box outside of which the wall is no nearer than the box.
    pub(super) fn reach(&self) -> [DVec3; 2] {
        if self.hollow {
            EVERYWHERE
        } else {
            self.extent()
        }
    }

    /// The box that the room is in, for all that this part tells.
    pub(super) fn room(&self) -> [DVec3; 2] {
        match self.solid {
            Solid::HalfSpace => self.half_space(if self.hollow { 1.0 } else { -1.0 }),
            _ if self.hollow => self.extent(),
            _ => EVERYWHERE,
        }
    }

    /// The box that the body is in.
    fn extent(&self) -> [DVec3; 2] {
        match &self.solid {
            Solid::HalfSpace => self.half_space(1.0),
            Solid::Cylinder { radius } => {
                let endless = self.axes.y_axis.abs().cmpgt(DVec3::ZERO);
                let size = DVec3::select(endless, DVec3::INFINITY, DVec3::splat(*radius));
                [self.origin - size, self.origin + size]
            }
            Solid::Capsule { half, radius } => self.rings([[0.0, *half], [0.0, -half]], *radius),
            Solid::Block { core, layer } => {
                let [x, y, z] = [0, 1, 2].map(|axis| {
                    let size = self.axes.col(axis).abs() * core[axis];
                    DVec3::select(size.is_nan_mask(), DVec3::ZERO, size)
                });
                let size = x + y + z + *layer;
                [self.origin - size, self.origin + size]
            }
            Solid::Revolved(Profile::Cone { .. }) => EVERYWHERE,
            Solid::Revolved(Profile::Sheet { ends, radius }) => {
                self.rings(ends.map(|end| end.to_array()), *radius)
            }
            Solid::Revolved(Profile::Disc { core, layer }) => {
                self.rings([[core.x, core.y], [core.x, -core.y]], *layer)
            }
            Solid::Union(parts) => {
                let boxes = parts.iter().map(|part| self.turned_box(part.extent()));
                boxes.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[a, b], [c, d]| {
                    [a.min(c), b.max(d)]
                })
            }
        }
    }

    /// Where the coordinate along an axis ends, on the side of `sign` times the plane's own axis.
    fn half_space(&self, sign: f64) -> [DVec3; 2] {
        let [mut low, mut high] = EVERYWHERE;
        for axis in 0..3 {
            if self.axes.y_axis * sign == DVec3::AXES[axis] {
                high[axis] = self.origin[axis];
            } else if self.axes.y_axis * -sign == DVec3::AXES[axis] {
                low[axis] = self.origin[axis];
            }
        }
        [low, high]
    }

    /// The box around two rings (radius and height) with a layer around them.
    fn rings(&self, rings: [[f64; 2]; 2], layer: f64) -> [DVec3; 2] {
        let axis = self.axes.y_axis;
        let across = (DVec3::ONE - axis * axis).max(DVec3::ZERO);
        let across = DVec3::from_array(across.to_array().map(f64::sqrt));
        let boxes = rings.map(|[radius, height]| {
            let along = axis * height;
            let along = DVec3::select(along.is_nan_mask(), DVec3::ZERO, along);
            let size = across * radius + layer;
            [self.origin + along - size, self.origin + along + size]
        });
        let [[a, b], [c, d]] = boxes;
        [a.min(c), b.max(d)]
    }

    /// A box of the own frame as it stands in the frame outside.
    fn turned_box(&self, [low, high]: [DVec3; 2]) -> [DVec3; 2] {
        let (middle, size) = (0.5 * (low + high), 0.5 * (high - low));
        if !(middle.is_finite() && size.is_finite()) {
            return EVERYWHERE;
        }
        let middle = self.origin + self.axes * middle;
        let size = (0..3).fold(DVec3::ZERO, |sum, axis| {
            sum + self.axes.col(axis).abs() * size[axis]
        });
        [middle - size, middle + size]
    }

    /// A length that tells its scale: of its place, or of its own size, m.
    pub(super) fn size(&self) -> f64 {
        let finite = |size: f64| if size.is_finite() { size } else { 0.0 };
        let own = match &self.solid {
            Solid::HalfSpace => 0.0,
            Solid::Cylinder { radius } => *radius,
            Solid::Capsule { half, radius } => half + radius,
            Solid::Block { core, layer } => {
                core.to_array().map(finite).into_iter().sum::<f64>() + layer
            }
            Solid::Revolved(Profile::Cone { layer, .. }) => *layer,
            Solid::Revolved(Profile::Sheet { ends, radius }) => {
                ends[0].length() + ends[1].length() + radius
            }
            Solid::Revolved(Profile::Disc { core, layer }) => {
                finite(core.x) + finite(core.y) + layer
            }
            Solid::Union(parts) => parts.iter().map(Self::size).fold(0.0, f64::max),
        };
        own.max(self.origin.length())
    }

    /// The least thickness of an obstacle in m; infinite if it is not one, or has no other side.
    pub(super) fn thickness(&self) -> f64 {
        if self.hollow {
            return f64::INFINITY;
        }
        match &self.solid {
            Solid::HalfSpace | Solid::Revolved(Profile::Cone { .. }) => f64::INFINITY,
            Solid::Cylinder { radius }
            | Solid::Capsule { radius, .. }
            | Solid::Revolved(Profile::Sheet { radius, .. }) => 2.0 * radius,
            Solid::Block { core, layer } => 2.0 * (core.min_element() + layer),
            Solid::Revolved(Profile::Disc { core, layer }) => 2.0 * (core.min_element() + layer),
            Solid::Union(parts) => parts
                .iter()
                .map(Self::thickness)
                .fold(f64::INFINITY, f64::min),
        }
    }

    /// The radius of the tightest rounded edge that is hollow, in m; infinite if there is none.
    pub(super) fn rounding(&self) -> f64 {
        match &self.solid {
            Solid::Block { layer, .. } | Solid::Revolved(Profile::Disc { layer, .. })
                if self.hollow =>
            {
                *layer
            }
            _ => f64::INFINITY,
        }
    }
}
