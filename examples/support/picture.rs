//! SVG files, and what is alike in all pictures.

use std::error::Error;
use std::fs;
use std::ops::Range;
use std::path::Path;

use plotters::chart::MeshStyle;
use plotters::coord::Shift;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(crate) type Failure = Box<dyn Error + Send + Sync>;

/// Width and height of a picture in pixels.
const SIZE: [u32; 2] = [960, 640];

/// Parts to a pixel: plotters draws to whole numbers, which bend a line that is smooth.
const FINE: u32 = 8;

/// A length in pixels, in the numbers that are drawn to.
pub(crate) const fn pixels(length: u32) -> u32 {
    FINE * length
}

/// Height of the title in pixels.
const HEAD: u32 = 46;

/// Where pictures are drawn.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Has the axes of a chart named, and their numbers written, as in all pictures.
pub(crate) fn name_axes<X, Y>(mesh: &mut MeshStyle<'_, '_, X, Y, SVGBackend<'_>>, names: [&str; 2])
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    mesh.x_desc(names[0])
        .y_desc(names[1])
        .x_label_formatter(&|value| short(*value))
        .y_label_formatter(&|value| short(*value))
        .axis_desc_style(("sans-serif", pixels(18)))
        .label_style(("sans-serif", pixels(15)))
        .axis_style(BLACK.stroke_width(pixels(1)))
        .set_all_tick_mark_size(pixels(5));
}

/// Has a picture drawn on white beneath its title, and writes it.
pub(crate) fn save(
    path: &Path,
    title: &str,
    draw: impl FnOnce(&Area<'_>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let size = SIZE.map(pixels);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size.into()).into_drawing_area();
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(pixels(HEAD));
        let style = TextStyle::from(("sans-serif", pixels(24)).into_font());
        let middle = [pixels(SIZE[0] / 2), pixels(28)].map(|at| at as i32);
        head.draw_text(
            title,
            &style.pos(Pos::new(HPos::Center, VPos::Center)),
            middle.into(),
        )?;
        draw(&body)?;
        area.present()?;
    }
    // The size that is shown; the drawing's own stays in the view box.
    let [drawn, shown] =
        [size, SIZE].map(|[width, height]| format!("width=\"{width}\" height=\"{height}\""));
    fs::write(path, text.replacen(&drawn, &shown, 1))?;
    Ok(())
}

/// What a line of a legend has beside its text.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Swatch {
    /// A piece of a line; dashes are so long, or none.
    Line(ShapeStyle, i32),
    Point(RGBColor),
}

/// A box with what lines mean.
pub(crate) fn legend(
    area: &Area<'_>,
    position: &SeriesLabelPosition,
    [paper, ink]: [RGBAColor; 2],
    entries: &[(&str, Swatch)],
) -> Result<(), Failure> {
    use SeriesLabelPosition as At;
    if entries.is_empty() {
        return Ok(());
    }
    let [edge, pad, sample, gap, pitch] = [5, 12, 32, 8, 19].map(|length| pixels(length) as i32);
    let style = TextStyle::from(("sans-serif", pixels(15)).into_font()).color(&ink);
    let mut widest = 0;
    for (text, _) in entries {
        widest = widest.max(area.estimate_text_size(text, &style)?.0 as i32);
    }
    let width = 2 * pad + sample + gap + widest;
    let height = 2 * pad + pitch * entries.len() as i32;
    let whole = area.dim_in_pixel();
    let (right, low) = (
        whole.0 as i32 - width - edge,
        whole.1 as i32 - height - edge,
    );
    let (x, y) = match position {
        At::UpperLeft => (edge, edge),
        At::MiddleLeft => (edge, low / 2),
        At::LowerLeft => (edge, low),
        At::UpperMiddle => (right / 2, edge),
        At::MiddleMiddle => (right / 2, low / 2),
        At::LowerMiddle => (right / 2, low),
        At::UpperRight => (right, edge),
        At::MiddleRight => (right, low / 2),
        At::LowerRight => (right, low),
        At::Coordinate(x, y) => (*x, *y),
    };
    let (to, under) = (x + width, y + height);
    area.draw(&Rectangle::new([(x, y), (to, under)], paper.filled()))?;
    let border = [(x, y), (to, y), (to, under), (x, under), (x, y)];
    area.draw(&PathElement::new(
        border,
        ink.mix(0.3).stroke_width(pixels(1)),
    ))?;
    let mut middle = y + pad + pitch / 2;
    for (text, swatch) in entries {
        let from = x + pad;
        match *swatch {
            Swatch::Line(style, dash) => {
                let ends = [(from, middle), (from + sample, middle)];
                let dash = if dash > 0 { dash } else { sample };
                area.draw(&DashedPathElement::new(ends, dash, dash, style))?;
            }
            Swatch::Point(colour) => {
                let at = (from + sample / 2, middle);
                area.draw(&Circle::new(at, pixels(4), colour.filled()))?;
            }
        }
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(text, &style, (from + sample + gap, middle))?;
        middle += pitch;
    }
    Ok(())
}

/// Round numbers for a logarithmic axis.
pub(crate) fn ticks(range: &Range<f64>) -> Vec<f64> {
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
pub(crate) fn short(value: f64) -> String {
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
