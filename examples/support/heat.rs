//! Heat maps as SVG files.

use std::ops::Range;
use std::path::Path;

use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::chart::picture::{self, Area, Failure, Swatch, pixels, short, ticks};
use colour::colour;

#[path = "colour.rs"]
mod colour;

/// Values over a grid of cells.
#[derive(Debug)]
pub(crate) struct HeatMap<'a> {
    pub(crate) title: &'a str,
    /// What the axes and the colours show, with units.
    pub(crate) axes: [&'a str; 3],
    /// Middles of the cells: evenly spaced, or with even ratios if x is logarithmic.
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
    pub(crate) logarithmic: bool,
    /// One value for each x at the first y, then at the next. What is not finite is left white.
    pub(crate) values: &'a [f64],
    /// From the darkest colour to the lightest; what is beyond has the last one.
    pub(crate) range: Range<f64>,
    /// What a line shows, and its points.
    pub(crate) line: Option<(&'a str, Vec<(f64, f64)>)>,
    /// A point to be marked, and what it is.
    pub(crate) mark: Option<(f64, f64, &'a str)>,
}

type Drawing<'a, 'b, X> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, RangedCoordf64>>;

/// Borders of cells whose middles are at `values`.
fn borders(values: &[f64], logarithmic: bool) -> Vec<f64> {
    let [to, from]: [fn(f64) -> f64; 2] = if logarithmic {
        [f64::ln, f64::exp]
    } else {
        [|value| value; 2]
    };
    let (first, last) = (to(values[0]), to(values[values.len() - 1]));
    let step = (last - first) / (values.len() - 1) as f64;
    let border = |n: usize| from(first + (n as f64 - 0.5) * step);
    (0..=values.len()).map(border).collect()
}

impl HeatMap<'_> {
    pub(crate) fn draw(&self, path: &Path) -> Result<(), Failure> {
        picture::save(path, self.title, |area| {
            let (left, right) = area.split_horizontally(pixels(840));
            let (x, y) = (borders(self.x, self.logarithmic), borders(self.y, false));
            let [across, up] = [&x, &y].map(|borders| borders[0]..borders[borders.len() - 1]);
            let mut map = ChartBuilder::on(&left);
            map.margin(pixels(16))
                .margin_top(0)
                .x_label_area_size(pixels(52))
                .y_label_area_size(pixels(68));
            if self.logarithmic {
                let across = across.clone().log_scale().with_key_points(ticks(&across));
                self.fill(map.build_cartesian_2d(across, up)?, &x, &y)?;
            } else {
                self.fill(map.build_cartesian_2d(across, up)?, &x, &y)?;
            }
            self.scale(&right)
        })
    }

    fn shade(&self, value: f64) -> RGBColor {
        colour((value - self.range.start) / (self.range.end - self.range.start))
    }

    fn fill<'a, 'b: 'a, X>(
        &self,
        mut map: Drawing<'a, 'b, X>,
        x: &[f64],
        y: &[f64],
    ) -> Result<(), Failure>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut mesh = map.configure_mesh();
        picture::name_axes(&mut mesh, [self.axes[0], self.axes[1]]);
        mesh.disable_mesh().draw()?;
        let values = self.values.iter().enumerate();
        let cells = values.filter(|cell| cell.1.is_finite());
        map.draw_series(cells.map(|(n, value)| {
            let (column, row) = (n % self.x.len(), n / self.x.len());
            let corners = [(x[column], y[row]), self.far_corner([column, row], x, y)];
            Rectangle::new(corners, self.shade(*value).filled())
        }))?;
        let white = ("sans-serif", pixels(15)).into_font().color(&WHITE);
        if let Some((x, y, label)) = self.mark {
            for (radius, colour, width) in [(9, WHITE, 3), (6, BLACK, 2)] {
                let style = colour.stroke_width(pixels(width));
                map.draw_series([Circle::new((x, y), pixels(radius), style)])?;
            }
            // To the side where there is room.
            let far = x > 0.5 * (self.x[0] + self.x[self.x.len() - 1]);
            let length = 14 + if far { 8 * label.len() as i32 } else { 0 };
            let aside = if far { -length } else { length } * pixels(1) as i32;
            let text = Text::new(
                label.to_owned(),
                (aside, -(pixels(8) as i32)),
                white.clone(),
            );
            map.draw_series([EmptyElement::at((x, y)) + text])?;
        }
        if let Some((label, points)) = &self.line {
            let style = WHITE.stroke_width(pixels(3));
            map.draw_series(LineSeries::new(points.iter().copied(), style))?;
            let area = map.plotting_area().strip_coord_spec();
            let colours = [BLACK.mix(0.55), WHITE.mix(1.0)];
            let entries = [(*label, Swatch::Line(style, 0))];
            picture::legend(&area, &SeriesLabelPosition::UpperLeft, colours, &entries)?;
        }
        Ok(())
    }

    /// Where a cell ends: a little behind those that are drawn later, so that no paper shines through.
    fn far_corner(&self, [column, row]: [usize; 2], x: &[f64], y: &[f64]) -> (f64, f64) {
        let value = |column: usize, row: usize| {
            let drawn = column < self.x.len() && row < self.y.len();
            drawn && self.values[row * self.x.len() + column].is_finite()
        };
        let behind = |borders: &[f64], n: usize| borders[n] + 0.1 * (borders[n + 1] - borders[n]);
        let (far, up) = (column + 1, row + 1);
        if value(far, up) && value(column, up) && value(far, row) {
            (behind(x, far), behind(y, up))
        } else if value(far, row) && up == self.y.len() {
            (behind(x, far), y[up])
        } else if value(column, up) && far == self.x.len() {
            (x[far], behind(y, up))
        } else {
            (x[far], y[up])
        }
    }

    /// What the colours mean, beside the map and as high as it is.
    fn scale(&self, area: &Area<'_>) -> Result<(), Failure> {
        let mut bar = ChartBuilder::on(area)
            .margin(pixels(16))
            .margin_left(pixels(4))
            .margin_top(0)
            .margin_bottom(pixels(68))
            .right_y_label_area_size(pixels(70))
            .build_cartesian_2d(0.0..1.0, self.range.clone())?
            .set_secondary_coord(0.0..1.0, self.range.clone());
        bar.configure_secondary_axes()
            .y_desc(self.axes[2])
            .y_label_formatter(&|value| short(*value))
            .axis_desc_style(("sans-serif", pixels(18)))
            .label_style(("sans-serif", pixels(15)))
            .axis_style(BLACK.stroke_width(pixels(1)))
            .set_all_tick_mark_size(pixels(5))
            .draw()?;
        let step = (self.range.end - self.range.start) / 100.0;
        bar.draw_series((0..100).map(|n| {
            let low = self.range.start + f64::from(n) * step;
            Rectangle::new(
                [(0.0, low), (1.0, self.range.end)],
                self.shade(low).filled(),
            )
        }))?;
        Ok(())
    }
}
