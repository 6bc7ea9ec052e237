//! Solid bodies of revolution and blocks, by their signed distances.

use glam::{DMat3, DVec2, DVec3, dvec2};

use crate::cavity::WallPoint;

/// A body about its y axis, or one of several bodies.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Solid {
    HalfSpace,
    Cylinder {
        radius: f64,
    },
    /// What is nearer to a piece of the axis than the radius.
    Capsule {
        half: f64,
        radius: f64,
    },
    /// Outside of a profile in the meridian plane, turned about the axis.
    Revolved(Profile),
    /// A block of half edges, with a layer around it.
    Block {
        core: DVec3,
        layer: f64,
    },
    Union(Vec<Placed>),
}

/// A curve in the meridian plane, whose points are (radius, height).
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Profile {
    /// A cone whose apex is at a height, with a layer around it.
    Cone {
        sine: f64,
        cosine: f64,
        apex: f64,
        layer: f64,
    },
    /// What is nearer to a segment than the radius.
    Sheet { ends: [DVec2; 2], radius: f64 },
    /// A cylinder of radius and half height, with a layer around it.
    Disc { core: DVec2, layer: f64 },
}

/// A body in its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Placed {
    pub(super) solid: Solid,
    /// Whether the room is inside.
    pub(super) hollow: bool,
    pub(super) origin: DVec3,
    /// Its own axes. The second is the axis of revolution, the first is taken where every direction across
    /// it is as good.
    pub(super) axes: DMat3,
}

/// A signed distance from a body, and its gradient, outwards.
type Meridian = (f64, DVec2);

impl Placed {
    /// The wall as it stands to `point`.
    #[inline]
    pub(super) fn wall(&self, point: DVec3) -> WallPoint {
        let outside = self.outside(point);
        if self.hollow {
            WallPoint {
                normal: -outside.normal,
                distance: -outside.distance,
            }
        } else {
            outside
        }
    }

    /// The same from outside of the body.
    #[inline]
    fn outside(&self, point: DVec3) -> WallPoint {
        let from = point - self.origin;
        let axis = self.axes.y_axis;
        let height = axis.dot(from);
        let mut radial = from - axis * height;
        let profile = match &self.solid {
            Solid::HalfSpace => {
                return WallPoint {
                    normal: axis,
                    distance: height,
                };
            }
            Solid::Capsule { half, radius } => {
                let from = from - axis * height.clamp(-half, *half);
                return WallPoint {
                    normal: from.normalize_or(self.axes.x_axis),
                    distance: from.length() - radius,
                };
            }
            Solid::Block { core, layer } => return self.block(from, *core, *layer),
            Solid::Union(parts) => return self.nearest(from, parts),
            Solid::Cylinder { radius } => {
                return WallPoint {
                    normal: radial.normalize_or(self.axes.x_axis),
                    distance: radial.length() - radius,
                };
            }
            Solid::Revolved(profile) => profile,
        };
        let (distance, gradient) = profile.outside(dvec2(radial.length(), height));
        // Once more, for points near the axis.
        radial -= axis * axis.dot(radial);
        let across = radial.normalize_or(self.axes.x_axis);
        WallPoint {
            normal: across * gradient.x + axis * gradient.y,
            distance,
        }
    }

    fn block(&self, from: DVec3, core: DVec3, layer: f64) -> WallPoint {
        let own = self.axes.transpose() * from;
        let beyond = own.abs() - core;
        let out = beyond.max(DVec3::ZERO);
        let (normal, distance) = if out == DVec3::ZERO {
            let deepest = beyond.max_element();
            let face = (0..3).find(|axis| beyond[*axis] >= deepest).unwrap_or(0);
            (DVec3::AXES[face], deepest)
        } else {
            (out.normalize_or(DVec3::X), out.length())
        };
        WallPoint {
            normal: self.axes * (normal * own.signum()),
            distance: distance - layer,
        }
    }

    fn nearest(&self, from: DVec3, parts: &[Self]) -> WallPoint {
        let own = self.axes.transpose() * from;
        let none = WallPoint {
            normal: DVec3::Y,
            distance: f64::INFINITY,
        };
        let nearest = parts.iter().fold(none, |nearest, part| {
            let wall = part.wall(own);
            if wall.distance < nearest.distance {
                wall
            } else {
                nearest
            }
        });
        WallPoint {
            normal: self.axes * nearest.normal,
            ..nearest
        }
    }
}

impl Profile {
    /// The signed distance of a point from the body, and its gradient.
    #[inline]
    fn outside(&self, point: DVec2) -> Meridian {
        match *self {
            Self::Cone {
                sine,
                cosine,
                apex,
                layer,
            } => {
                let from = dvec2(point.x, point.y - apex);
                let beside = from.x * cosine - from.y * sine;
                let along = from.x * sine + from.y * cosine;
                if beside > 0.0 && along < 0.0 {
                    around(from, dvec2(0.0, -1.0), layer)
                } else {
                    (beside - layer, dvec2(cosine, -sine))
                }
            }
            Self::Sheet {
                ends: [from, to],
                radius,
            } => {
                let way = to - from;
                let square = way.length_squared();
                let part = if square > 0.0 {
                    ((point - from).dot(way) / square).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let across = if square > 0.0 { way.perp() } else { DVec2::X };
                around(point - (from + way * part), across, radius)
            }
            Self::Disc { core, layer } => {
                let sign = dvec2(1.0, point.y.signum());
                let beyond = point.abs() - core;
                let out = beyond.max(DVec2::ZERO);
                if out != DVec2::ZERO {
                    let (distance, gradient) = around(out, DVec2::X, layer);
                    (distance, gradient * sign)
                } else if beyond.x >= beyond.y {
                    (beyond.x - layer, DVec2::X)
                } else {
                    (beyond.y - layer, DVec2::Y * sign)
                }
            }
        }
    }
}

/// Outside of a circle of `radius` whose centre is at `-from`; `otherwise` is the direction in the centre.
#[inline]
fn around(from: DVec2, otherwise: DVec2, radius: f64) -> Meridian {
    let gradient = from.normalize_or(otherwise.normalize_or(DVec2::X));
    (from.length() - radius, gradient)
}
