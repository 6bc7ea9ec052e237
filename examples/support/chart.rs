//! Line charts as SVG files.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::coord::ranged1d::ValueFormatter;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

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

type Drawing<'a, X, Y> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>;
type Failure = Box<dyn Error + Send + Sync>;

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

impl Chart<'_> {
    pub(crate) fn draw(&self, path: &Path, lines: &[Line]) -> Result<(), Failure> {
        let area = SVGBackend::new(path, (960, 640)).into_drawing_area();
        area.fill(&WHITE)?;
        let mut builder = ChartBuilder::on(&area);
        builder
            .caption(self.title, ("sans-serif", 24))
            .margin(16)
            .x_label_area_size(52)
            .y_label_area_size(68);
        let (x, y) = (self.x.clone(), self.y.clone());
        let log = |range: Range<f64>| range.clone().log_scale().with_key_points(ticks(&range));
        match self.logarithmic {
            [false, false] => self.fill(builder.build_cartesian_2d(x, y)?, lines)?,
            [false, true] => self.fill(builder.build_cartesian_2d(x, log(y))?, lines)?,
            [true, false] => self.fill(builder.build_cartesian_2d(log(x), y)?, lines)?,
            [true, true] => self.fill(builder.build_cartesian_2d(log(x), log(y))?, lines)?,
        }
        area.present()?;
        Ok(())
    }

    fn fill<X, Y>(&self, mut chart: Drawing<'_, X, Y>, lines: &[Line]) -> Result<(), Failure>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        chart
            .configure_mesh()
            .x_desc(self.axes[0])
            .y_desc(self.axes[1])
            .x_label_formatter(&|value| short(*value))
            .y_label_formatter(&|value| short(*value))
            .axis_desc_style(("sans-serif", 18))
            .label_style(("sans-serif", 15))
            .bold_line_style(BLACK.mix(0.18))
            .light_line_style(BLACK.mix(0.05))
            .draw()?;
        for line in lines {
            let colour = COLOURS[line.colour % COLOURS.len()];
            let style = colour.stroke_width(2);
            let points = line.points.iter().copied();
            let dash = line.dash;
            let legend = if dash == POINTS {
                let marks = points.clone();
                chart.draw_series(marks.map(|point| Circle::new(point, 4, colour.filled())))?
            } else if dash == 0 {
                chart.draw_series(LineSeries::new(points.clone(), style))?
            } else {
                chart.draw_series(DashedLineSeries::new(points.clone(), dash, dash, style))?
            };
            let length = if dash > 0 { dash } else { 32 };
            if !line.label.is_empty() {
                let legend = legend.label(&line.label);
                if dash == POINTS {
                    legend.legend(move |(x, y)| Circle::new((x + 16, y), 4, colour.filled()));
                } else {
                    legend.legend(move |(x, y)| {
                        DashedPathElement::new([(x, y), (x + 32, y)], length, length, style)
                    });
                }
            }
            if line.marked && dash != POINTS {
                chart.draw_series(points.map(|point| Circle::new(point, 4, colour.filled())))?;
            }
        }
        chart
            .configure_series_labels()
            .position(self.legend.clone())
            .legend_area_size(40)
            .margin(12)
            .background_style(WHITE.mix(0.9))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 15))
            .draw()?;
        Ok(())
    }
}

/// Round numbers for a logarithmic axis.
fn ticks(range: &Range<f64>) -> Vec<f64> {
    let decades = (range.end / range.start).log10();
    let digits: &[u32] = if decades > 3.5 {
        &[1]
    } else if decades > 1.3 {
        &[1, 2, 5]
    } else {
        &[1, 2, 3, 4, 6, 8]
    };
    let exponents = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    exponents
        .flat_map(|exponent| {
            digits
                .iter()
                .map(move |&digit| f64::from(digit) * 10_f64.powi(exponent))
        })
        .filter(|tick| (range.start..=range.end).contains(tick))
        .collect()
}

/// A number without the digits that rounding leaves behind, and from 10 000 on in groups of three.
fn short(value: f64) -> String {
    let text = format!("{:.4}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if value >= 1e4 && !text.contains('.') {
        return text
            .bytes()
            .enumerate()
            .flat_map(|(place, digit)| {
                let gap = place > 0 && (text.len() - place) % 3 == 0;
                gap.then_some('\u{2009}')
                    .into_iter()
                    .chain([char::from(digit)])
            })
            .collect();
    }
    text.strip_prefix("-")
        .filter(|digits| *digits == "0")
        .unwrap_or(text)
        .to_owned()
}
