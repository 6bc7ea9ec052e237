//! Heat maps as SVG files.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::prelude::*;

use crate::colour::colour;

/// Values over two axes, and lines across them.
#[derive(Debug)]
pub(crate) struct Map<'a> {
    pub(crate) title: &'a str,
    /// What the axes and the colours show, with units.
    pub(crate) axes: [&'a str; 3],
    /// Borders of the cells along both axes; the first is logarithmic.
    pub(crate) borders: [Vec<f64>; 2],
    /// Row by row, from low to high.
    pub(crate) values: Vec<Vec<f64>>,
    pub(crate) range: Range<f64>,
    /// What a line shows, and its points.
    pub(crate) line: (&'a str, Vec<(f64, f64)>),
}

/// Borders of cells whose middles are at `values`, which are spaced by equal steps or ratios.
pub(crate) fn borders(values: &[f64], logarithmic: bool) -> Vec<f64> {
    let [first, second] = [values[0], values[1]];
    let half = if logarithmic {
        (second / first).sqrt()
    } else {
        0.5 * (second - first)
    };
    let below = |value: f64| {
        if logarithmic {
            value / half
        } else {
            value - half
        }
    };
    let above = |value: f64| {
        if logarithmic {
            value * half
        } else {
            value + half
        }
    };
    let mut borders = vec![below(first)];
    borders.extend(values.iter().map(|value| above(*value)));
    borders
}

impl Map<'_> {
    fn colour_of(&self, value: f64) -> RGBColor {
        colour((value - self.range.start) / (self.range.end - self.range.start))
    }

    pub(crate) fn draw(&self, path: &Path) -> Result<(), Box<dyn Error + Send + Sync>> {
        let area = SVGBackend::new(path, (960, 640)).into_drawing_area();
        area.fill(&WHITE)?;
        let (left, right) = area.split_horizontally(850);
        let [x, y] = self
            .borders
            .each_ref()
            .map(|borders| borders[0]..borders[borders.len() - 1]);
        let mut chart = ChartBuilder::on(&left)
            .caption(self.title, ("sans-serif", 24))
            .margin(16)
            .x_label_area_size(52)
            .y_label_area_size(68)
            .build_cartesian_2d(
                x.log_scale()
                    .with_key_points(vec![0.5, 1.0, 2.0, 5.0, 10.0]),
                y,
            )?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(self.axes[0])
            .y_desc(self.axes[1])
            .x_label_formatter(&|value| value.to_string())
            .y_label_formatter(&|value| value.to_string())
            .axis_desc_style(("sans-serif", 18))
            .label_style(("sans-serif", 15))
            .draw()?;
        let cells = self.values.iter().enumerate().flat_map(|(row, values)| {
            values
                .iter()
                .enumerate()
                .map(move |(column, value)| (row, column, *value))
        });
        chart.draw_series(cells.map(|(row, column, value)| {
            let [x, y] = &self.borders;
            let corners = [(x[column], y[row]), (x[column + 1], y[row + 1])];
            Rectangle::new(corners, self.colour_of(value).filled())
        }))?;
        let (label, points) = &self.line;
        let style = WHITE.stroke_width(3);
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style))?
            .label(*label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 32, y)], style));
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .legend_area_size(40)
            .margin(12)
            .background_style(BLACK.mix(0.55))
            .label_font(("sans-serif", 15).into_font().color(&WHITE))
            .draw()?;
        let mut scale = ChartBuilder::on(&right)
            .caption(self.axes[2], ("sans-serif", 18))
            .margin(16)
            .margin_bottom(68)
            .y_label_area_size(40)
            .build_cartesian_2d(0.0..1.0, self.range.clone())?;
        scale
            .configure_mesh()
            .disable_mesh()
            .disable_x_axis()
            .y_label_formatter(&|value| value.to_string())
            .label_style(("sans-serif", 15))
            .draw()?;
        let step = (self.range.end - self.range.start) / 100.0;
        scale.draw_series((0..100).map(|n| {
            let low = self.range.start + f64::from(n) * step;
            Rectangle::new(
                [(0.0, low), (1.0, low + step)],
                self.colour_of(low).filled(),
            )
        }))?;
        area.present()?;
        Ok(())
    }
}
