//! Line charts as SVG files.

use std::ops::Range;
use std::path::Path;

use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;

use picture::{Failure, Swatch, pixels, ticks};

#[path = "picture.rs"]
pub(crate) mod picture;

/// The dash of a line that is not drawn: its points are marked alone.
pub(crate) const POINTS: i32 = -1;

/// One line of a chart.
#[derive(Debug)]
pub(crate) struct Line {
    /// What the legend says; empty leaves the line out of it.
    pub(crate) label: String,
    /// Number of the colour.
    pub(crate) colour: usize,
    /// Length of the dashes in pixels; zero draws the line through, [`POINTS`] does not draw it.
    pub(crate) dash: i32,
    /// Whether the points are marked.
    pub(crate) marked: bool,
    pub(crate) points: Vec<(f64, f64)>,
}

/// The frame of a chart.
#[derive(Debug)]
pub(crate) struct Chart<'a> {
    pub(crate) title: &'a str,
    /// What the axes show, with units.
    pub(crate) axes: [&'a str; 2],
    pub(crate) x: Range<f64>,
    pub(crate) y: Range<f64>,
    /// Whether the axes are logarithmic.
    pub(crate) logarithmic: [bool; 2],
    pub(crate) legend: SeriesLabelPosition,
}

type Drawing<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

/// Colours that the colour-blind can tell apart (Okabe & Ito 2008), the last of them excepted.
const COLOURS: [RGBColor; 8] = [
    RGBColor(60, 60, 60),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(120, 200, 150),
];

#[allow(dead_code)] // Shared by the examples, each of which uses a part.
impl Line {
    /// Points that are joined.
    pub(crate) fn through(label: &str, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self {
            label: label.into(),
            colour,
            dash: 0,
            marked: false,
            points,
        }
    }

    /// Points that are marked alone.
    pub(crate) fn points(label: &str, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self {
            dash: POINTS,
            ..Self::through(label, colour, points)
        }
    }

    /// The same with dashes of so many pixels.
    pub(crate) fn dashed(self, dash: i32) -> Self {
        Self { dash, ..self }
    }

    /// The same with its points marked.
    pub(crate) fn marked(self) -> Self {
        Self {
            marked: true,
            ..self
        }
    }
}

impl Chart<'_> {
    pub(crate) fn draw(&self, path: &Path, lines: &[Line]) -> Result<(), Failure> {
        picture::save(path, self.title, |area| {
            let mut builder = ChartBuilder::on(area);
            builder
                .margin(pixels(16))
                .margin_top(0)
                .x_label_area_size(pixels(52))
                .y_label_area_size(pixels(68));
            let (x, y) = (self.x.clone(), self.y.clone());
            let log = |range: Range<f64>| range.clone().log_scale().with_key_points(ticks(&range));
            match self.logarithmic {
                [false, false] => self.fill(builder.build_cartesian_2d(x, y)?, lines),
                [false, true] => self.fill(builder.build_cartesian_2d(x, log(y))?, lines),
                [true, false] => self.fill(builder.build_cartesian_2d(log(x), y)?, lines),
                [true, true] => self.fill(builder.build_cartesian_2d(log(x), log(y))?, lines),
            }
        })
    }

    fn fill<'a, 'b: 'a, X, Y>(
        &self,
        mut chart: Drawing<'a, 'b, X, Y>,
        lines: &[Line],
    ) -> Result<(), Failure>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut mesh = chart.configure_mesh();
        picture::name_axes(&mut mesh, self.axes);
        mesh.bold_line_style(BLACK.mix(0.18).stroke_width(pixels(1)))
            .light_line_style(BLACK.mix(0.05).stroke_width(pixels(1)))
            .draw()?;
        let mut entries = Vec::new();
        for line in lines {
            let colour = COLOURS[line.colour % COLOURS.len()];
            let style = colour.stroke_width(pixels(2));
            let points = || line.points.iter().copied();
            let dash = line.dash.max(0) * pixels(1) as i32;
            let swatch = if line.dash == POINTS {
                Swatch::Point(colour)
            } else {
                Swatch::Line(style, dash)
            };
            if dash > 0 {
                chart.draw_series(DashedLineSeries::new(points(), dash, dash, style))?;
            } else if line.dash != POINTS {
                chart.draw_series(LineSeries::new(points(), style))?;
            }
            if line.marked || line.dash == POINTS {
                let mark = |point| Circle::new(point, pixels(4), colour.filled());
                chart.draw_series(points().map(mark))?;
            }
            if !line.label.is_empty() {
                entries.push((line.label.as_str(), swatch));
            }
        }
        let area = chart.plotting_area().strip_coord_spec();
        let colours = [WHITE.mix(0.9), BLACK.mix(1.0)];
        picture::legend(&area, &self.legend, colours, &entries)
    }
}
