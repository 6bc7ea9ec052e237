use super::{Line, Response};

/// What a sweep gives along one line, up and down again.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Branches {
    /// Where it was measured.
    pub line: Line,
    /// On the way up.
    pub up: Vec<Response>,
    /// On the way down, the highest first.
    pub down: Vec<Response>,
}

/// A range in which the response is another one on the way up than on the way down.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Parting {
    /// The lowest of the points that differ: amplitude, or frequency in Hz.
    pub from: f64,
    /// The highest.
    pub to: f64,
    /// The largest difference of RMS values about the mean, over the larger of the two.
    pub difference: f64,
}

impl Branches {
    /// Where the two branches part: ranges of neighbouring points whose [RMS](Response::rms_mean) differs by
    /// more than `tolerance` (a part of the larger one: 0.05 is 5 %), and by more than both half-widths
    /// together. Lowest first; none if the structure has no memory of where it came from.
    #[must_use]
    pub fn parted(&self, tolerance: f64) -> Vec<Parting> {
        let mut parted: Vec<Parting> = Vec::new();
        let mut goes_on = false;
        for (up, down) in self.up.iter().zip(self.down.iter().rev()) {
            let difference = difference(up, down).filter(|difference| *difference > tolerance);
            if let Some(difference) = difference {
                let at = self.line.swept.of(&up.point);
                match parted.last_mut().filter(|_| goes_on) {
                    Some(last) => {
                        last.to = at;
                        last.difference = last.difference.max(difference);
                    }
                    None => parted.push(Parting {
                        from: at,
                        to: at,
                        difference,
                    }),
                }
            }
            goes_on = difference.is_some();
        }
        parted
    }
}

/// The difference of two responses over the larger, if it is more than chance.
fn difference(a: &Response, b: &Response) -> Option<f64> {
    let width = |response: &Response| {
        let widths = response.half_widths;
        widths.map_or(0.0, |widths| widths.rms_mean)
    };
    let difference = (a.rms_mean - b.rms_mean).abs();
    let sure = difference > width(a) + width(b);
    sure.then(|| difference / a.rms_mean.max(b.rms_mean))
}
