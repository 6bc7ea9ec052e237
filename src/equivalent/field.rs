use crate::error::{Bound, ValueError};
use crate::fields::Cell;

/// What a damper does to a box that moves as A sin w t, in the first harmonic of its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// Apparent mass of what is in the box, in kg: as a mass that moves with it would have. It may be
    /// negative.
    pub apparent_mass: f64,
    /// Equivalent viscous coefficient in N s/m: loss per cycle over pi w A^2.
    pub viscous_coefficient: f64,
    /// Amplitude of the third harmonic of the force in N, where it is known.
    pub third_harmonic: Option<f64>,
}

impl Effect {
    /// An apparent mass (kg) and a viscous coefficient (N s/m).
    #[must_use]
    pub const fn new(apparent_mass: f64, viscous_coefficient: f64) -> Self {
        Self {
            apparent_mass,
            viscous_coefficient,
            third_harmonic: None,
        }
    }
}

impl From<&Cell> for Effect {
    fn from(cell: &Cell) -> Self {
        Self::new(cell.apparent_mass.value, cell.viscous_coefficient.value)
    }
}

/// What an isolated damper does, over amplitude and frequency.
///
/// # Using
/// [`OneBall`](crate::impact_damper::OneBall) is a closed form, [`FieldTable`] interpolates what was simulated
/// or measured.
///
/// # Implementing
/// 1. [`amplitudes`](Self::amplitudes) are the ends of the amplitudes (m) for which [`at`](Self::at) has an
///    answer at an angular frequency (rad/s): the lower one not negative, the upper one above it. Empty if
///    it has none: the upper one below the lower.
/// 2. [`at`](Self::at) is continuous between them, and an error outside.
/// 3. [`bed_mass`](Self::bed_mass) is the mass of what is loose, kg.
///
/// ```
/// use particle_damper::equivalent::{Effect, Field};
/// use particle_damper::{Bound, ValueError};
///
/// /// Grains that rest: a mass, up to where they are thrown.
/// struct AtRest {
///     mass: f64,
/// }
///
/// impl Field for AtRest {
///     fn amplitudes(&self, angular_frequency: f64) -> [f64; 2] {
///         [0.0, 9.81 / angular_frequency.powi(2)]
///     }
///     fn bed_mass(&self) -> f64 {
///         self.mass
///     }
///     fn at(&self, amplitude: f64, angular_frequency: f64) -> Result<Effect, ValueError> {
///         let [low, high] = self.amplitudes(angular_frequency);
///         Bound::Within(low, high).check("amplitude (m)", amplitude)?;
///         Ok(Effect::new(self.mass, 0.0))
///     }
/// }
/// ```
pub trait Field {
    /// The least and the largest amplitude (m) for which there is an answer.
    fn amplitudes(&self, angular_frequency: f64) -> [f64; 2];

    /// Mass in kg of what is loose.
    fn bed_mass(&self) -> f64;

    /// What the damper does at `amplitude` (m) and `angular_frequency` (rad/s).
    ///
    /// # Errors
    /// If the field has no answer there; the error says where it has.
    fn at(&self, amplitude: f64, angular_frequency: f64) -> Result<Effect, ValueError>;
}

impl<F: Field + ?Sized> Field for &F {
    fn amplitudes(&self, angular_frequency: f64) -> [f64; 2] {
        (**self).amplitudes(angular_frequency)
    }

    fn bed_mass(&self) -> f64 {
        (**self).bed_mass()
    }

    fn at(&self, amplitude: f64, angular_frequency: f64) -> Result<Effect, ValueError> {
        (**self).at(amplitude, angular_frequency)
    }
}

/// A field on a grid, interpolated linearly in the logarithms of amplitude and angular frequency.
///
/// ```
/// use particle_damper::equivalent::{Effect, Field, FieldTable};
///
/// // Two amplitudes (m), two angular frequencies (rad/s); amplitudes follow each other first.
/// let effects = [Effect::new(0.01, 0.1), Effect::new(0.0, 0.3), Effect::new(0.01, 0.2), Effect::new(0.0, 0.6)];
/// let table = FieldTable::new(0.01, &[1e-3, 4e-3], &[30.0, 60.0], &effects)?;
/// let between = table.at(2e-3, 30.0)?;
/// assert!((between.viscous_coefficient - 0.2).abs() < 1e-12);
/// assert_eq!(table.at(5e-3, 30.0).unwrap_err().to_string(), "amplitude (m) must lie in [0.001, 0.004], not 0.005");
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FieldTable {
    bed_mass: f64,
    amplitudes: Vec<f64>,
    angular_frequencies: Vec<f64>,
    effects: Vec<Effect>,
}

impl FieldTable {
    /// A table over `amplitudes` (m) and `angular_frequencies` (rad/s), both rising, for a bed of `bed_mass`
    /// (kg). `effects` hold one effect for each amplitude at the first frequency, then at the next.
    ///
    /// # Errors
    /// If there are fewer than two amplitudes or no frequency, values are not positive or do not rise, the
    /// number of effects is not that of cells, or a number in them is not finite.
    pub fn new(
        bed_mass: f64,
        amplitudes: &[f64],
        angular_frequencies: &[f64],
        effects: &[Effect],
    ) -> Result<Self, ValueError> {
        let count = |values: &[f64]| values.len() as f64;
        Bound::AtLeast(2.0).check("number of amplitudes", count(amplitudes))?;
        Bound::AtLeast(1.0).check("number of frequencies", count(angular_frequencies))?;
        let cells = count(amplitudes) * count(angular_frequencies);
        Bound::Within(cells, cells).check("number of effects", effects.len() as f64)?;
        rising("amplitude (m)", amplitudes)?;
        rising("angular frequency (rad/s)", angular_frequencies)?;
        for effect in effects {
            Bound::Finite.check("apparent mass (kg)", effect.apparent_mass)?;
            Bound::Finite.check("viscous coefficient (N s/m)", effect.viscous_coefficient)?;
            let third = effect.third_harmonic.unwrap_or_default();
            Bound::NonNegative.check("third harmonic (N)", third)?;
        }
        Ok(Self {
            bed_mass: Bound::NonNegative.check("mass of the bed (kg)", bed_mass)?,
            amplitudes: amplitudes.to_vec(),
            angular_frequencies: angular_frequencies.to_vec(),
            effects: effects.to_vec(),
        })
    }

    /// A table of cells that [`EffectiveFields`](crate::EffectiveFields) has measured: one for each of their
    /// amplitudes at each of their frequencies, in any order.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and if a cell is missing or there twice, or beds differ in mass.
    pub fn from_cells(cells: &[Cell]) -> Result<Self, ValueError> {
        let axis = |of: fn(&Cell) -> f64| -> Vec<f64> {
            let mut values: Vec<f64> = cells.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        };
        let amplitudes = axis(|cell| cell.amplitude);
        let frequencies = axis(Cell::angular_frequency);
        let bed_mass = cells.first().map_or(0.0, |cell| cell.bed_mass);
        let mut effects = Vec::with_capacity(cells.len());
        for w in &frequencies {
            for amplitude in &amplitudes {
                let here = |cell: &&Cell| {
                    cell.amplitude.to_bits() == amplitude.to_bits()
                        && cell.angular_frequency().to_bits() == w.to_bits()
                };
                let count = cells.iter().filter(here).count() as f64;
                let what = "cells at one amplitude and frequency";
                Bound::Within(1.0, 1.0).check(what, count)?;
                effects.extend(cells.iter().filter(here).map(Effect::from));
            }
        }
        for cell in cells {
            let same = Bound::Within(bed_mass, bed_mass);
            same.check("mass of the bed (kg)", cell.bed_mass)?;
        }
        Self::new(bed_mass, &amplitudes, &frequencies, &effects)
    }

    /// The angular frequencies in rad/s.
    #[must_use]
    pub fn angular_frequencies(&self) -> &[f64] {
        &self.angular_frequencies
    }
}

fn rising(what: &'static str, values: &[f64]) -> Result<(), ValueError> {
    let mut before = 0.0;
    for &value in values {
        before = Bound::Above(before).check(what, value)?;
    }
    Ok(())
}

/// The place of `value` among rising `values`: the one below, and how far it is to the next.
fn place(what: &'static str, values: &[f64], value: f64) -> Result<(usize, f64), ValueError> {
    let (first, last) = (values[0], values[values.len() - 1]);
    Bound::Within(first, last).check(what, value)?;
    let above = values.partition_point(|known| *known <= value);
    let below = above.saturating_sub(1).min(values.len().saturating_sub(2));
    let Some(next) = values.get(below + 1) else {
        return Ok((below, 0.0));
    };
    Ok((
        below,
        libm::log(value / values[below]) / libm::log(next / values[below]),
    ))
}

impl Field for FieldTable {
    fn amplitudes(&self, angular_frequency: f64) -> [f64; 2] {
        let [low, high] = [0, self.amplitudes.len() - 1].map(|n| self.amplitudes[n]);
        let inside = place("", &self.angular_frequencies, angular_frequency).is_ok();
        if inside { [low, high] } else { [high, low] }
    }

    fn bed_mass(&self) -> f64 {
        self.bed_mass
    }

    fn at(&self, amplitude: f64, angular_frequency: f64) -> Result<Effect, ValueError> {
        let frequencies = &self.angular_frequencies;
        let (row, up) = place("angular frequency (rad/s)", frequencies, angular_frequency)?;
        let (column, right) = place("amplitude (m)", &self.amplitudes, amplitude)?;
        let width = self.amplitudes.len();
        let next_row = (row + 1).min(frequencies.len() - 1);
        let corners = [
            (row, column, (1.0 - up) * (1.0 - right)),
            (row, column + 1, (1.0 - up) * right),
            (next_row, column, up * (1.0 - right)),
            (next_row, column + 1, up * right),
        ];
        let mean = |of: fn(&Effect) -> Option<f64>| {
            corners.iter().try_fold(0.0, |sum, (row, column, weight)| {
                Some(sum + weight * of(&self.effects[row * width + column])?)
            })
        };
        Ok(Effect {
            apparent_mass: mean(|effect| Some(effect.apparent_mass)).unwrap_or_default(),
            viscous_coefficient: mean(|effect| Some(effect.viscous_coefficient))
                .unwrap_or_default(),
            third_harmonic: mean(|effect| effect.third_harmonic),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> FieldTable {
        let effects: Vec<Effect> = (0..6)
            .map(|n| Effect::new(f64::from(n), f64::from(10 * n)))
            .collect();
        FieldTable::new(1.0, &[1.0, 2.0, 8.0], &[10.0, 20.0], &effects).unwrap()
    }

    #[test]
    fn nodes_are_met_and_values_between_are_between() {
        let table = table();
        for (row, w) in [10.0, 20.0].into_iter().enumerate() {
            for (column, a) in [1.0, 2.0, 8.0].into_iter().enumerate() {
                let effect = table.at(a, w).unwrap();
                assert!((effect.apparent_mass - (3 * row + column) as f64).abs() < 1e-12);
                assert!((effect.viscous_coefficient - 10.0 * effect.apparent_mass).abs() < 1e-12);
            }
        }
        // Halfway in both logarithms.
        let middle = table.at(4.0, 200.0_f64.sqrt()).unwrap();
        assert!((middle.apparent_mass - 3.0).abs() < 1e-12, "{middle:?}");
        assert!(middle.third_harmonic.is_none());
    }

    #[test]
    fn outside_is_an_error_with_the_range() {
        let table = table();
        assert!(table.at(0.5, 10.0).is_err() && table.at(1.0, 9.9).is_err());
        assert!(table.at(f64::NAN, 10.0).is_err());
        let [low, high] = table.amplitudes(9.0);
        assert!(low > high);
    }

    #[test]
    fn cells_make_a_table_in_any_order() {
        let cell = |a: f64, f: f64| Cell::known(a, f, 1.0, a, f);
        let mut cells = vec![
            cell(2.0, 5.0),
            cell(1.0, 5.0),
            cell(1.0, 4.0),
            cell(2.0, 4.0),
        ];
        let table = FieldTable::from_cells(&cells).unwrap();
        let effect = table.at(2.0, std::f64::consts::TAU * 5.0).unwrap();
        assert!((effect.apparent_mass - 2.0).abs() < 1e-12);
        assert!((effect.viscous_coefficient - 5.0).abs() < 1e-12);
        let missing = cells.pop().unwrap();
        assert!(FieldTable::from_cells(&cells).is_err());
        cells.push(Cell {
            bed_mass: 2.0,
            ..missing
        });
        assert!(FieldTable::from_cells(&cells).is_err());
        assert!(FieldTable::from_cells(&[]).is_err());
    }

    #[test]
    fn a_table_that_is_none_is_refused() {
        let effect = Effect::new(1.0, 1.0);
        assert!(FieldTable::new(1.0, &[1.0], &[1.0], &[effect]).is_err());
        assert!(FieldTable::new(1.0, &[1.0, 1.0], &[1.0], &[effect; 2]).is_err());
        assert!(FieldTable::new(1.0, &[1.0, 2.0], &[], &[]).is_err());
        assert!(FieldTable::new(1.0, &[1.0, 2.0], &[1.0], &[effect; 3]).is_err());
        let broken = Effect::new(f64::NAN, 1.0);
        assert!(FieldTable::new(1.0, &[1.0, 2.0], &[1.0], &[broken; 2]).is_err());
        assert!(FieldTable::new(1.0, &[1.0, 2.0], &[1.0], &[effect; 2]).is_ok());
    }
}
