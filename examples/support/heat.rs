//! Heat maps as SVG files.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

use crate::colour::colour;

/// Values over a grid of cells.
#[derive(Debug)]
pub(crate) struct HeatMap<'a> {
    pub(crate) title: &'a str,
    /// What the axes and the colours show, with units.
    pub(crate) axes: [&'a str; 3],
    /// Middles of the cells, evenly spaced.
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
    /// One value for each x at the first y, then at the next; positive. Colours go by their logarithm, and what
    /// is not finite is left white.
    pub(crate) values: &'a [f64],
    /// A point to be marked, and what it is.
    pub(crate) mark: (f64, f64, &'a str),
}

type Failure = Box<dyn Error + Send + Sync>;

/// Half the distance of neighbours.
fn half(values: &[f64]) -> f64 {
    match values {
        [first, .., last] => 0.5 * (last - first) / (values.len() - 1) as f64,
        _ => 0.5,
    }
}

impl HeatMap<'_> {
    pub(crate) fn draw(&self, path: &Path) -> Result<(), Failure> {
        let all = || {
            self.values
                .iter()
                .copied()
                .filter(|value| value.is_finite())
        };
        let (low, high) = (
            all().fold(f64::MAX, f64::min),
            all().fold(f64::MIN, f64::max),
        );
        // One value alone has a colour too.
        let span = (high - low).max(1e-6 * high.abs());
        let shade = |value: f64| colour((value / low).ln() / ((low + span) / low).ln());
        let (dx, dy) = (half(self.x), half(self.y));
        let [x, y] = [(self.x, dx), (self.y, dy)]
            .map(|(values, half)| values[0] - half..values[values.len() - 1] + half);
        let area = SVGBackend::new(path, (960, 640)).into_drawing_area();
        area.fill(&WHITE)?;
        let (left, right) = area.split_horizontally(830);
        let mut map = ChartBuilder::on(&left)
            .caption(self.title, ("sans-serif", 24))
            .margin(16)
            .x_label_area_size(52)
            .y_label_area_size(68)
            .build_cartesian_2d(x, y)?;
        map.configure_mesh()
            .disable_mesh()
            .x_desc(self.axes[0])
            .y_desc(self.axes[1])
            .axis_desc_style(("sans-serif", 18))
            .label_style(("sans-serif", 15))
            .draw()?;
        let cells = self
            .values
            .iter()
            .enumerate()
            .filter(|cell| cell.1.is_finite());
        map.draw_series(cells.map(|(n, value)| {
            let (x, y) = (self.x[n % self.x.len()], self.y[n / self.x.len()]);
            let corners = [(x - dx, y - dy), (x + dx, y + dy)];
            Rectangle::new(corners, shade(*value).filled())
        }))?;
        let (x, y, label) = self.mark;
        map.draw_series([Circle::new((x, y), 9, WHITE.stroke_width(3))])?;
        map.draw_series([Circle::new((x, y), 6, BLACK.stroke_width(2))])?;
        let style = ("sans-serif", 16).into_font().color(&WHITE);
        // To the side where there is room.
        let way = if x > 0.5 * (self.x[0] + self.x[self.x.len() - 1]) {
            -14 - 8 * label.len() as i32
        } else {
            14
        };
        map.draw_series(
            [EmptyElement::at((x, y)) + Text::new(label.to_owned(), (way, -8), style)],
        )?;
        let mut bar = ChartBuilder::on(&right)
            .margin(16)
            .margin_top(48)
            .margin_bottom(66)
            .right_y_label_area_size(70)
            .build_cartesian_2d(0.0..1.0, low..low + span)?
            .set_secondary_coord(0.0..1.0, low..low + span);
        bar.configure_secondary_axes()
            .y_desc(self.axes[2])
            .axis_desc_style(("sans-serif", 18))
            .label_style(("sans-serif", 15))
            .draw()?;
        bar.draw_series((0..100).map(|n| {
            let [from, to] = [0, 1].map(|more| f64::from(n + more) / 100.0);
            let corners = [(0.0, low + span * from), (1.0, low + span * to)];
            Rectangle::new(corners, shade(low + span * from).filled())
        }))?;
        area.present()?;
        Ok(())
    }
}
