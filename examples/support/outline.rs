//! Pictures of cavities, from their distance functions alone.

use std::fmt::Write as _;

use particle_damper::cavity::Cavity;
use particle_damper::glam::dvec3;

/// What of the bounds is wall in the plane z = 0: rows of pixels, as the path of a drawing in mm, y upwards.
pub(crate) fn solid(cavity: &impl Cavity, pixel: f64) -> String {
    let [low, high] = cavity.bounds();
    let [columns, rows] = [0, 1].map(|axis| ((high - low)[axis] / pixel).round() as u32);
    let at = |number: u32, from: f64| from + (f64::from(number) + 0.5) * pixel;
    let is_wall = |column: u32, row: u32| {
        let point = dvec3(at(column, low.x), at(row, low.y), 0.0);
        column < columns && (0..cavity.walls()).any(|wall| cavity.wall(wall, point).distance < 0.0)
    };
    let mut path = String::new();
    for row in 0..rows {
        let mut begin = None;
        for column in 0..=columns {
            let edge = 1e3 * (at(column, low.x) - 0.5 * pixel);
            match (begin, is_wall(column, row)) {
                (None, true) => begin = Some(edge),
                (Some(from), false) => {
                    let y = -1e3 * at(row, low.y);
                    let _ = write!(path, "M{from:.2} {y:.2}H{edge:.2}");
                    begin = None;
                }
                _ => {}
            }
        }
    }
    path
}
