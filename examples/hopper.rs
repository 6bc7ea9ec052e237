//! A cavity composed from parts: grains run from a hopper over pegs into bins.
//!
//! The hopper is filled while a gate closes it. The picture of the cavity is made from its distance function
//! alone, so that it shows any that has a plane. The table has the weight that each wall bears at the end.
//! `cargo run --release --example hopper` leaves `target/hopper/hopper.svg` and `walls.csv`.

#![allow(clippy::print_stdout)]

#[path = "support/outline.rs"]
mod outline;
#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use particle_damper::cavity::{Cavity, Composite, Part};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{Damper, Filling, Material, Particle, RestitutionImpulse};

type Failure = Box<dyn Error + Send + Sync>;

const HALF: f64 = 0.04; // m, half of the width
const HEIGHT: f64 = 0.16; // m
const OUTLET: f64 = 0.105; // m, above the floor
const GRAINS: usize = 180;
const PIXEL: f64 = 0.25e-3; // m

/// A capsule in the plane, between two points in mm.
fn rod(name: &str, from: [f64; 2], to: [f64; 2]) -> Part {
    let ends = [from, to].map(|[x, y]| dvec3(x, y, 0.0) * 1e-3);
    Part::rod(ends, 1e-3).named(name)
}

fn parts() -> Vec<Part> {
    let mut parts = vec![
        Part::plane().named("floor"),
        Part::plane()
            .along(DVec3::NEG_Y)
            .at(DVec3::Y * HEIGHT)
            .named("lid"),
        Part::plane()
            .along(DVec3::X)
            .at(DVec3::X * -HALF)
            .named("left"),
        Part::plane()
            .along(DVec3::NEG_X)
            .at(DVec3::X * HALF)
            .named("right"),
        rod("left chute", [-42.0, 135.0], [-8.0, 1e3 * OUTLET]),
        rod("right chute", [42.0, 135.0], [8.0, 1e3 * OUTLET]),
    ];
    for row in 0..4_u32 {
        let count = 7 + row % 2;
        for number in 0..count {
            let x = 0.01 * (f64::from(number) - 0.5 * f64::from(count - 1));
            let place = dvec3(x, 0.09 - 0.0125 * f64::from(row), 0.0);
            parts.push(
                Part::sphere(1.5e-3)
                    .at(place)
                    .named(format!("peg {row}.{number}")),
            );
        }
    }
    for (number, x) in [-24.0, -8.0, 8.0, 24.0].into_iter().enumerate() {
        parts.push(rod(&format!("partition {number}"), [x, -2.0], [x, 40.0]));
    }
    parts
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let room = Composite::planar(parts())?;
    // Planes along the chutes, and across the outlet.
    let chute = |side: f64| {
        let foot = dvec3(8e-3 * side, OUTLET + 1.4e-3, 0.0);
        Part::plane().along(dvec3(-30.0 * side, 34.0, 0.0)).at(foot)
    };
    let gates = [Part::plane().at(DVec3::Y * OUTLET), chute(1.0), chute(-1.0)];
    let closed = Composite::planar(parts().into_iter().chain(gates))?;
    let grain = Particle::with_density(1.5e-3, 1190.0)?;
    let bed = Filling::new(1).with(GRAINS, grain).fill(&closed)?;
    let law = RestitutionImpulse::new(Material::acrylic());
    let mut damper = Damper::builder(&room, law)
        .particles(bed)
        .time_step(1e-4)
        .build()?;

    let mut picture = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-42 -162 266 166\" width=\"1064\">\n\
         <rect x=\"-42\" y=\"-162\" width=\"266\" height=\"166\" fill=\"#fbfaf7\"/>\n\
         <defs><g id=\"room\"><rect x=\"-40\" y=\"-160\" width=\"80\" height=\"160\" fill=\"#eef2f6\" \
         stroke=\"#33414e\"/><path stroke=\"#33414e\" stroke-width=\"0.27\" d=\"",
    );
    picture.push_str(&outline::solid(&room, PIXEL));
    picture.push_str("\"/></g></defs>\n");
    let times = if quick {
        [0.0, 0.05, 0.1]
    } else {
        [0.0, 0.25, 3.0]
    };
    for (number, time) in times.into_iter().enumerate() {
        while damper.time() < time {
            damper.step()?;
        }
        let _ = writeln!(
            picture,
            "<g transform=\"translate({} 0)\"><use href=\"#room\"/>",
            91 * number
        );
        for own in damper.particles() {
            let (place, r) = (own.position * 1e3, own.radius * 1e3);
            let _ = writeln!(
                picture,
                "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{r}\" fill=\"#e69f00\"/>",
                place.x, -place.y
            );
        }
        picture.push_str("</g>\n");
    }
    picture.push_str("</svg>\n");

    let directory = output::directory("hopper")?;
    let rows = (0..room.walls()).map(|wall| {
        let load = damper.wall_load(0, wall).unwrap_or_default().force;
        format!("{},{:.6},{:.6}", room.wall_name(wall), load.x, load.y)
    });
    output::write_table(&directory.join("walls.csv"), "wall,x_newton,y_newton", rows)?;
    let weight = GRAINS as f64 * grain.mass * 9.81;
    let borne: f64 = (0..room.walls())
        .filter_map(|wall| damper.wall_load(0, wall))
        .map(|load| -load.force.y)
        .sum();
    println!("the walls bear {borne:.6} N of a weight of {weight:.6} N");
    let path = directory.join("hopper.svg");
    fs::write(&path, picture)?;
    output::say_where("picture", &path);
    Ok(())
}
