//! Least squares of a few parameters: the method of Levenberg and Marquardt.

/// Where the sum of squares is least.
#[derive(Debug, Clone)]
pub(super) struct Solution<const P: usize> {
    pub(super) parameters: [f64; P],
    /// The inverse of J^T J: the covariance of the parameters if residuals have the variance one.
    pub(super) covariance: [[f64; P]; P],
    pub(super) residuals: Vec<f64>,
}

impl<const P: usize> Solution<P> {
    /// Sum of squared residuals over the degrees of freedom that are left; none if none are.
    pub(super) fn variance(&self) -> Option<f64> {
        let left = self.residuals.len().checked_sub(P).filter(|left| *left > 0);
        left.map(|left| squares(&self.residuals) / left as f64)
    }
}

fn squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Lower triangle of a symmetric positive matrix; none if it is not positive.
fn cholesky<const P: usize>(matrix: &[[f64; P]; P]) -> Option<[[f64; P]; P]> {
    let mut lower = [[0.0; P]; P];
    for row in 0..P {
        for column in 0..=row {
            let known: f64 = (0..column).map(|k| lower[row][k] * lower[column][k]).sum();
            let rest = matrix[row][column] - known;
            lower[row][column] = if row == column {
                // Below rounding the direction is not determined.
                (rest > 1e-13 * matrix[row][row]).then(|| rest.sqrt())?
            } else {
                rest / lower[column][column]
            };
        }
    }
    Some(lower)
}

/// What `lower` times its transpose has to be multiplied with to give `right`.
fn solve<const P: usize>(lower: &[[f64; P]; P], right: &[f64; P]) -> [f64; P] {
    let mut x = *right;
    for row in 0..P {
        let known: f64 = (0..row).map(|k| lower[row][k] * x[k]).sum();
        x[row] = (x[row] - known) / lower[row][row];
    }
    for row in (0..P).rev() {
        let known: f64 = (row + 1..P).map(|k| lower[k][row] * x[k]).sum();
        x[row] = (x[row] - known) / lower[row][row];
    }
    x
}

/// Products of the columns of the Jacobian of `residuals`, with each other and with the residuals.
/// Parameters are in units in which a change of one matters.
fn normal_equations<const P: usize>(
    at: &[f64; P],
    now: &[f64],
    residuals: &impl Fn(&[f64; P]) -> Vec<f64>,
) -> ([[f64; P]; P], [f64; P]) {
    const STEP: f64 = 1e-5;
    let columns: [Vec<f64>; P] = std::array::from_fn(|k| {
        let shifted = |by: f64| {
            let mut moved = *at;
            moved[k] += by;
            residuals(&moved)
        };
        let (above, below) = (shifted(STEP), shifted(-STEP));
        let slope = |(above, below): (&f64, &f64)| (above - below) / (2.0 * STEP);
        above.iter().zip(&below).map(slope).collect()
    });
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
    let matrix =
        std::array::from_fn(|row| std::array::from_fn(|k| dot(&columns[row], &columns[k])));
    (matrix, std::array::from_fn(|k| dot(&columns[k], now)))
}

/// The parameters near `start` for which the squares of `residuals` sum to the least; none if it is not
/// found or does not determine them all.
pub(super) fn least_squares<const P: usize>(
    start: [f64; P],
    residuals: impl Fn(&[f64; P]) -> Vec<f64>,
) -> Option<Solution<P>> {
    let (mut at, mut now) = (start, residuals(&start));
    let mut caution = 1e-3;
    for _ in 0..200 {
        let (matrix, gradient) = normal_equations(&at, &now, &residuals);
        let mut settled = false;
        while caution < 1e12 {
            let mut damped = matrix;
            for (k, row) in damped.iter_mut().enumerate() {
                row[k] *= 1.0 + caution;
            }
            let step = cholesky(&damped).map(|lower| solve(&lower, &gradient));
            if let Some(step) = step {
                let next = std::array::from_fn(|k| at[k] - step[k]);
                let then = residuals(&next);
                let size = step.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
                settled = size < 1e-9;
                if squares(&then) <= squares(&now) {
                    (at, now) = (next, then);
                    caution *= 0.1;
                    break;
                }
            }
            if settled {
                break;
            }
            caution *= 10.0;
        }
        if settled || caution >= 1e12 {
            break;
        }
        caution = caution.max(1e-12);
    }
    let (matrix, gradient) = normal_equations(&at, &now, &residuals);
    let lower = cholesky(&matrix)?;
    let left = solve(&lower, &gradient);
    if !left.iter().all(|part| part.abs() < 1e-4) {
        return None;
    }
    let mut covariance = [[0.0; P]; P];
    for (k, row) in covariance.iter_mut().enumerate() {
        let unit = std::array::from_fn(|n| f64::from(n == k));
        *row = solve(&lower, &unit);
    }
    Some(Solution {
        parameters: at,
        covariance,
        residuals: now,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_has_the_textbook_covariance() {
        let xs = [0.0, 1.0, 2.0, 3.0, 5.0];
        let ys = [1.0, 2.9, 5.2, 6.8, 11.1];
        let residuals = |p: &[f64; 2]| -> Vec<f64> {
            let at = xs.iter().zip(&ys);
            at.map(|(x, y)| p[0] + p[1] * x - y).collect()
        };
        let found = least_squares([0.0, 0.0], residuals).unwrap();
        let n = xs.len() as f64;
        let (mean_x, mean_y) = (xs.iter().sum::<f64>() / n, ys.iter().sum::<f64>() / n);
        let sxx: f64 = xs.iter().map(|x| (x - mean_x).powi(2)).sum();
        let sxy: f64 = xs
            .iter()
            .zip(&ys)
            .map(|(x, y)| (x - mean_x) * (y - mean_y))
            .sum();
        assert!((found.parameters[1] - sxy / sxx).abs() < 1e-9);
        assert!((found.covariance[1][1] - 1.0 / sxx).abs() < 1e-9);
        assert!((found.covariance[0][0] - (1.0 / n + mean_x * mean_x / sxx)).abs() < 1e-9);
        assert!(found.variance().unwrap() > 0.0);
    }

    #[test]
    fn what_residuals_do_not_depend_on_is_not_determined() {
        let blind = |p: &[f64; 2]| vec![p[0] - 1.0, p[0] - 2.0, p[0] - 3.0];
        assert!(least_squares([0.0, 0.0], blind).is_none());
    }

    #[test]
    fn a_curved_valley_is_followed_from_afar() {
        let rosenbrock = |p: &[f64; 2]| vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]];
        let found = least_squares([-1.2, 1.0], rosenbrock).unwrap();
        assert!(
            (found.parameters[0] - 1.0).abs() < 1e-8 && (found.parameters[1] - 1.0).abs() < 1e-8
        );
        assert!(found.variance().is_none());
    }
}
