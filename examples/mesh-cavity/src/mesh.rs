//! A cavity from a triangle mesh.
//!
//! A wall of a [`Cavity`] is touched at one point at the most. So the triangles are joined to walls over
//! edges that are flat or point into the room, and parted at those that recede from it: a sphere in such a
//! corner touches two walls.

use std::collections::BTreeMap;
use std::error::Error;

use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TrianglePointLocation};
use particle_damper::cavity::{Cavity, WallPoint};
use particle_damper::glam::{DVec3, dvec3};

const FLAT: f64 = 1e-9; // sine of an angle

/// Triangles that count as one wall.
struct Wall {
    mesh: TriMesh,
    normals: Vec<DVec3>,
    /// Whether the edges and the corners of each triangle, as parry counts them, are on the border of the wall.
    border: Vec<[[bool; 3]; 2]>,
}

pub struct MeshCavity {
    walls: Vec<Wall>,
    bounds: [DVec3; 2],
}

fn ours(point: Vector) -> DVec3 {
    dvec3(point.x, point.y, point.z)
}

impl Wall {
    fn point(&self, from: DVec3) -> WallPoint {
        let point = Vector::new(from.x, from.y, from.z);
        let (foot, (triangle, location)) =
            self.mesh.project_local_point_and_get_location(point, false);
        let triangle = triangle as usize;
        let (normal, offset) = (self.normals[triangle], from - ours(foot.point));
        let side = offset.dot(normal);
        let [edges, corners] = self.border[triangle];
        let goes_on = match location {
            TrianglePointLocation::OnEdge(edge, _) => edges[edge as usize],
            TrianglePointLocation::OnVertex(corner) => corners[corner as usize],
            _ => true,
        };
        // A wall goes on beyond its border, behind its neighbours there.
        if goes_on || offset.length() < 1e-12 {
            return WallPoint {
                normal,
                distance: side,
            };
        }
        let distance = offset.length().copysign(side);
        WallPoint {
            normal: offset / distance,
            distance,
        }
    }
}

impl MeshCavity {
    /// The room that the `triangles` enclose; seen from inside their corners go around counterclockwise.
    pub fn new(corners: &[DVec3], triangles: &[[u32; 3]]) -> Result<Self, Box<dyn Error>> {
        let corner = |number: u32| corners[number as usize];
        let normal = |[a, b, c]: [u32; 3]| {
            (corner(b) - corner(a))
                .cross(corner(c) - corner(a))
                .normalize()
        };
        let mut edges: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        let edges_of =
            |[a, b, c]: [u32; 3]| [[a, b], [b, c], [a, c]].map(|[a, b]| [a.min(b), a.max(b)]);
        for (number, triangle) in triangles.iter().enumerate() {
            for edge in edges_of(*triangle) {
                edges.entry(edge).or_default().push(number);
            }
        }
        // Every triangle points to another of its wall, the first one to itself.
        let mut first: Vec<usize> = (0..triangles.len()).collect();
        let mut parted = Vec::new();
        for (edge, both) in &edges {
            let &[a, b] = both.as_slice() else {
                return Err(format!("edge {edge:?} has {} triangles, not 2", both.len()).into());
            };
            let beyond = triangles[b].iter().find(|corner| !edge.contains(corner));
            let rise = beyond.map_or(0.0, |own| {
                normal(triangles[a]).dot((corner(*own) - corner(edge[0])).normalize())
            });
            if rise > FLAT {
                parted.push(*edge);
            } else {
                let [a, b] = [a, b].map(|own| wall_of(&first, own));
                first[a.max(b)] = a.min(b);
            }
        }
        let mut members: BTreeMap<usize, Vec<[u32; 3]>> = BTreeMap::new();
        for (number, triangle) in triangles.iter().enumerate() {
            members
                .entry(wall_of(&first, number))
                .or_default()
                .push(*triangle);
        }
        let all: Vec<Vector> = corners.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
        let walls = members.into_values().map(|own| {
            let on_border = |own: &[u32; 3]| {
                let ends = |corner: u32| parted.iter().any(|edge| edge.contains(&corner));
                [
                    edges_of(*own).map(|edge| parted.contains(&edge)),
                    own.map(ends),
                ]
            };
            Ok(Wall {
                normals: own.iter().copied().map(normal).collect(),
                border: own.iter().map(on_border).collect(),
                mesh: TriMesh::new(all.clone(), own)?,
            })
        });
        let low = corners
            .iter()
            .fold(DVec3::INFINITY, |low, own| low.min(*own));
        let high = corners
            .iter()
            .fold(DVec3::NEG_INFINITY, |high, own| high.max(*own));
        Ok(Self {
            walls: walls.collect::<Result<_, Box<dyn Error>>>()?,
            bounds: [low, high],
        })
    }
}

fn wall_of(first: &[usize], mut triangle: usize) -> usize {
    while first[triangle] != triangle {
        triangle = first[triangle];
    }
    triangle
}

impl Cavity for MeshCavity {
    fn walls(&self) -> u32 {
        self.walls.len() as u32
    }

    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        self.walls[number as usize].point(point)
    }

    fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }
}
