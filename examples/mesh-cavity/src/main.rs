//! A damper in a cavity from a triangle mesh, whose distances parry works out.
//!
//! The mesh is an L, extruded; one read from a file would do as well. The program lets a bed come to rest,
//! tells what each wall bears, and fails if together that is not the weight.
//!
//! Run: `cargo run --release --manifest-path examples/mesh-cavity/Cargo.toml`

mod mesh;

use std::error::Error;
use std::process::ExitCode;

use mesh::MeshCavity;
use particle_damper::cavity::Cavity;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{Damper, Filling, Material, Particle, RestitutionImpulse};

const GRAINS: usize = 150;
const GRAIN: f64 = 0.2e-3; // kg

/// The mesh of an L that stands on its longer side: corners, and triangles that look inwards.
fn extruded_l() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let outline = [
        [0.0, 0.0],
        [0.05, 0.0],
        [0.05, 0.02],
        [0.02, 0.02],
        [0.02, 0.06],
        [0.0, 0.06],
    ];
    let corners = [0.0, 0.03]
        .into_iter()
        .flat_map(|z| outline.map(|[x, y]| dvec3(x, y, z)));
    let mut triangles = Vec::new();
    for a in 0..6 {
        let b = (a + 1) % 6;
        triangles.extend([[a, a + 6, b], [b, a + 6, b + 6]]);
    }
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
        triangles.extend([[a, b, c], [a + 6, c + 6, b + 6]]);
    }
    (corners.collect(), triangles)
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let (corners, triangles) = extruded_l();
    let cavity = MeshCavity::new(&corners, &triangles)?;
    println!(
        "{} triangles make {} walls",
        triangles.len(),
        cavity.walls()
    );
    let bed = Filling::new(1)
        .with(GRAINS, Particle::new(3e-3, GRAIN)?)
        .fill(&cavity)?;
    let mut damper = Damper::builder(&cavity, RestitutionImpulse::new(Material::acrylic()))
        .particles(bed)
        .time_step(1e-4)
        .build()?;
    while damper.time() < 1.5 {
        damper.step()?;
    }
    let mut borne = DVec3::ZERO;
    for wall in 0..cavity.walls() {
        let load = damper.wall_load(0, wall).unwrap_or_default().force;
        println!(
            "wall {wall} bears ({:8.5}, {:8.5}, {:8.5}) N",
            load.x, load.y, load.z
        );
        borne += load;
    }
    let weight = GRAINS as f64 * GRAIN * 9.81;
    println!("together {:.5} N of a weight of {weight:.5} N", -borne.y);
    if (borne + DVec3::Y * weight).length() < 1e-3 * weight && damper.outside() == 0 {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("the walls should bear the weight");
    Ok(ExitCode::FAILURE)
}
