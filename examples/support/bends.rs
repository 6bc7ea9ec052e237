//! Where a curve needs more points to look like one.

/// Pixels of a picture to a unit of the abscissa, and to a factor of e of a logarithmic ordinate.
const PIXELS: [f64; 2] = [210.0, 130.0];

/// The largest angle between neighbouring pieces of a line that is not seen, in rad.
const UNSEEN: f64 = 0.07;

/// The middles of the pieces on both sides of a bend that can be seen, of pieces that are longer than
/// `shortest`; `curve` has positive ordinates and rising abscissas.
pub(crate) fn bends(curve: &[(f64, f64)], shortest: f64) -> Vec<f64> {
    let direction = |from: (f64, f64), to: (f64, f64)| {
        let up = PIXELS[1] * (to.1 / from.1).ln();
        up.atan2(PIXELS[0] * (to.0 - from.0))
    };
    let pieces: Vec<[(f64, f64); 2]> = curve.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let mut bent = vec![false; pieces.len()];
    for (number, pair) in pieces.windows(2).enumerate() {
        let [before, after] = [pair[0], pair[1]].map(|[from, to]| direction(from, to));
        if (after - before).abs() > UNSEEN {
            bent[number] = true;
            bent[number + 1] = true;
        }
    }
    let long = |[from, to]: &[(f64, f64); 2]| to.0 - from.0 > 1.5 * shortest;
    let bent = pieces
        .iter()
        .zip(bent)
        .filter(|(piece, bent)| *bent && long(piece));
    let middle = |[from, to]: &[(f64, f64); 2]| {
        // Without digits that nobody wants to read.
        (f64::midpoint(from.0, to.0) * 1e6).round() / 1e6
    };
    bent.map(|(piece, _)| middle(piece)).collect()
}
