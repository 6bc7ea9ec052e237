use glam::{DQuat, DVec3};

/// A part of a [`Composite`](super::Composite) cavity: a solid body with a name, put anywhere at any
/// angle. Each part is one wall.
///
/// The room is outside of a part, unless it is [`inside`](Self::inside). Where it stands and how it is
/// turned may be said in any order; a part that cannot be is refused by
/// [`Composite::new`](super::Composite::new).
///
/// | part | its own frame, before it is put in place |
/// |---|---|
/// | [`plane`](Self::plane) | everything below y = 0 is solid |
/// | [`sphere`](Self::sphere) | about the origin |
/// | [`cylinder`](Self::cylinder) | endless, about the y axis |
/// | [`cone`](Self::cone) | endless, opens along y from an apex at the origin; a rounded tip |
/// | [`capsule`](Self::capsule) | about the y axis, its middle at the origin: a rod with round ends |
/// | [`rod`](Self::rod) | a capsule between two points; in a plane a baffle, or a partition |
/// | [`torus`](Self::torus) | about the y axis, its middle at the origin |
/// | [`disc`](Self::disc) | a cylinder with an end, about the y axis, its middle at the origin; rounded rims |
/// | [`block`](Self::block) | its middle at the origin, edges along the axes; all of them rounded |
/// | [`funnel`](Self::funnel) | a conical sheet about the y axis, its lower end at y = 0; round rims |
/// | [`tube`](Self::tube), [`orifice`](Self::orifice) | a funnel of one radius; one without height: a plate with a round hole |
/// | [`union`](Self::union) | several bodies that count as one wall |
///
/// # Edges and corners
/// Edges of bodies are rounded, with a radius that is part of the body: a grain rolls over them. Where
/// parts meet in a corner of the room, a grain touches each of them. Where they meet in an edge or a knot
/// that points into the room, it would touch each at the same place, and be pushed twice: a
/// [`union`](Self::union) pushes once, and has no such edge.
///
/// Hollow bodies have to be wider than the grains, and grains that lie in a hollow cone or on the rim of
/// a hole all around touch it on one side at a time.
///
/// A damper with parts that are thinner than a grain reports an
/// [error](crate::StepError::TooFast) where a grain is so fast that it could pass through one within a
/// step.
///
/// ```
/// use particle_damper::cavity::{Composite, Part};
/// use particle_damper::glam::DVec3;
///
/// // Between two cylinders, lying.
/// let annulus = Composite::new([
///     Part::cylinder(0.03).inside().along(DVec3::X).named("shell"),
///     Part::cylinder(0.01).along(DVec3::X).named("core"),
///     Part::plane().along(DVec3::X).named("left"),
///     Part::plane().along(DVec3::NEG_X).at(DVec3::X * 0.05).named("right"),
/// ])?;
/// # Ok::<(), particle_damper::cavity::CompositeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Part {
    pub(super) name: String,
    pub(super) shape: Shape,
    pub(super) hollow: bool,
    pub(super) at: DVec3,
    /// Where its own y axis points to, before it is rotated.
    pub(super) axis: DVec3,
    pub(super) rotation: DQuat,
}

/// The body of a part, as it was asked for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shape {
    Plane,
    Cylinder {
        radius: f64,
    },
    Cone {
        half_angle: f64,
        tip: f64,
    },
    /// A sphere without length.
    Capsule {
        radius: f64,
        length: f64,
    },
    Torus {
        ring: f64,
        radius: f64,
    },
    Disc {
        /// Radius and height.
        size: [f64; 2],
        rounding: f64,
    },
    Block {
        size: DVec3,
        rounding: f64,
    },
    Funnel {
        radii: [f64; 2],
        height: f64,
        thickness: f64,
    },
    Union(Vec<Part>),
}

impl Part {
    const fn new(shape: Shape) -> Self {
        Self {
            name: String::new(),
            shape,
            hollow: false,
            at: DVec3::ZERO,
            axis: DVec3::Y,
            rotation: DQuat::IDENTITY,
        }
    }

    /// A plane: the room is on the side that it [faces](Self::along), +y at first.
    pub const fn plane() -> Self {
        Self::new(Shape::Plane)
    }

    /// A sphere of `radius` in m.
    pub const fn sphere(radius: f64) -> Self {
        Self::new(Shape::Capsule {
            radius,
            length: 0.0,
        })
    }

    /// An endless cylinder of `radius` in m.
    pub const fn cylinder(radius: f64) -> Self {
        Self::new(Shape::Cylinder { radius })
    }

    /// An endless cone: its sides stand at `half_angle` (rad, between 0 and a quarter turn) to its axis, its
    /// tip is rounded with the radius `tip` (m, may be zero if it is hollow). The apex, at the origin, is where
    /// the sides would meet without.
    pub const fn cone(half_angle: f64, tip: f64) -> Self {
        Self::new(Shape::Cone { half_angle, tip })
    }

    /// A capsule of `radius`; the centres of its round ends are `length` apart, in m.
    pub const fn capsule(radius: f64, length: f64) -> Self {
        Self::new(Shape::Capsule { radius, length })
    }

    /// A capsule of `radius` around the straight line between two points of the container's frame, in m.
    pub fn rod([from, to]: [DVec3; 2], radius: f64) -> Self {
        let way = to - from;
        let length = way.length();
        let rod = Self::capsule(radius, length).at(0.5 * (from + to));
        if length > 0.0 { rod.along(way) } else { rod }
    }

    /// A torus: a ring of radius `ring`, `radius` thick, in m.
    pub const fn torus(ring: f64, radius: f64) -> Self {
        Self::new(Shape::Torus { ring, radius })
    }

    /// A cylinder of `radius` and `height` with rims rounded by `rounding`, in m: a plate, a bar, or, from
    /// [inside](Self::inside), a cup.
    pub const fn disc(radius: f64, height: f64, rounding: f64) -> Self {
        Self::new(Shape::Disc {
            size: [radius, height],
            rounding,
        })
    }

    /// A rectangular block of edge lengths `size` whose edges and corners are rounded by `rounding`, in m:
    /// by half of its thickness at the most.
    pub const fn block(size: DVec3, rounding: f64) -> Self {
        Self::new(Shape::Block { size, rounding })
    }

    /// A sheet of `thickness` with round rims, whose middle runs from the first radius at y = 0 to the
    /// second at y = `height`, in m: the outlet of a hopper.
    pub const fn funnel(radii: [f64; 2], height: f64, thickness: f64) -> Self {
        Self::new(Shape::Funnel {
            radii,
            height,
            thickness,
        })
    }

    /// A tube of `radius` (of the middle of its wall), `height` and wall `thickness`, in m, open at both
    /// ends, with round rims.
    pub const fn tube(radius: f64, height: f64, thickness: f64) -> Self {
        Self::funnel([radius, radius], height, thickness)
    }

    /// A flat ring of `thickness` across y, in m, whose round rims have their centres at the radii `hole` and
    /// `edge`.
    pub const fn orifice(hole: f64, edge: f64, thickness: f64) -> Self {
        Self::funnel([hole, edge], 0.0, thickness)
    }

    /// Bodies that count as one wall: a grain touches the nearest. It stands in a frame of its own, which
    /// may be moved and turned in turn. Names of its parts are of no account. Where a grain overlaps with two
    /// of the bodies, beside their seam, the overlap is that with the one that it is deeper in.
    pub fn union(parts: impl IntoIterator<Item = Self>) -> Self {
        Self::new(Shape::Union(parts.into_iter().collect()))
    }

    /// The same body hollow: the room is inside.
    pub const fn inside(mut self) -> Self {
        self.hollow = true;
        self
    }

    /// The same body solid: the room is outside, as it is unless said otherwise.
    pub const fn outside(mut self) -> Self {
        self.hollow = false;
        self
    }

    /// Its origin in the container's frame, in m.
    pub const fn at(mut self, origin: DVec3) -> Self {
        self.at = origin;
        self
    }

    /// Turns its y axis the shortest way to `axis` (of any length, container's frame); a plane faces that
    /// way. What it was turned by before is forgotten.
    pub const fn along(mut self, axis: DVec3) -> Self {
        self.axis = axis;
        self.rotation = DQuat::IDENTITY;
        self
    }

    /// Turns it about its own origin, on top of what it was turned by before.
    pub fn turned(mut self, rotation: DQuat) -> Self {
        self.rotation = rotation * self.rotation;
        self
    }

    /// The name of the wall; "wall" unless set.
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The name of the wall.
    #[must_use]
    pub fn name(&self) -> &str {
        if self.name.is_empty() {
            "wall"
        } else {
            &self.name
        }
    }
}
