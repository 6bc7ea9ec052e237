//! Colours of heat maps.

use plotters::prelude::RGBColor;

/// From dark to light, as the eye sees it (six points of "viridis", Smith & van der Walt 2015).
const COLOURS: [[f64; 3]; 6] = [
    [68.0, 1.0, 84.0],
    [65.0, 68.0, 135.0],
    [42.0, 120.0, 142.0],
    [34.0, 168.0, 132.0],
    [122.0, 209.0, 81.0],
    [253.0, 231.0, 37.0],
];

/// The colour of a part, from dark (0) to light (1).
pub(crate) fn colour(part: f64) -> RGBColor {
    let place = part.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let low = (place as usize).min(COLOURS.len() - 2);
    let mixed = |n: usize| {
        let [from, to] = [COLOURS[low][n], COLOURS[low + 1][n]];
        (from + (to - from) * (place - low as f64)).round() as u8
    };
    RGBColor(mixed(0), mixed(1), mixed(2))
}
