//! The figure: four panels over the number of links.

use crate::Row;
use crate::fit::Fit;
use crate::shape::Shape;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::{MarkerShape, ScatterPlot};
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use std::sync::Arc;

/// Colours of Okabe and Ito with markers.
const STYLES: [(&str, MarkerShape); 4] = [
    ("#0072B2", MarkerShape::Circle),
    ("#D55E00", MarkerShape::Square),
    ("#009E73", MarkerShape::Triangle),
    ("#CC79A7", MarkerShape::Diamond),
];

/// SVG text.
pub fn draw(rows: &[Row], fit: Fit) -> String {
    let forward = |row: &Row| f64::from(row.derivation.flops("forward_dynamics"));
    let operations = |function: &'static str| move |row: &Row| f64::from(row.derivation.flops(function));
    let mut first = vec![points(rows, 0, "forward dynamics", forward)];
    for arms in [1, 4] {
        // the fitted planes at one and four arms, as lines
        let ends = [2, 7].map(|links| Shape { arms, links });
        let ends: Vec<(f64, f64)> = ends.iter().map(|shape| (f64::from(shape.joints()), fit.at(*shape))).collect();
        let line = LinePlot::new().with_data(ends).with_color("#000000").with_stroke_width(1.2);
        first.push(Plot::Line(if arms == 1 { line.with_legend("linear fit") } else { line }));
    }
    let panels = vec![
        first,
        vec![
            points(rows, 0, "forward dynamics", forward),
            points(rows, 1, "reduced dynamics", operations("reduced_dynamics")),
            points(rows, 2, "impact, exact", operations("full_impact")),
            points(rows, 3, "impact, the paper's", operations("reduced_impact")),
        ],
        vec![
            points(rows, 0, "derive the graph", |row| row.derivation.seconds),
            points(rows, 1, "cargo build --release", |row| row.release.seconds),
            points(rows, 2, "cargo build", |row| row.debug.seconds),
        ],
        vec![
            points(rows, 0, "generated", |row| row.evaluation.generated),
            points(rows, 1, "generic", |row| row.evaluation.generic),
        ],
    ];
    let titles = [
        ("Forward dynamics with the linear fit", "operations per call (flops)", false),
        ("Operations", "operations per call (flops)", true),
        ("Derivation and compilation", "time (s)", true),
        ("One call of forward dynamics", "time (ns)", true),
    ];
    let layouts = panels.iter().zip(titles).map(|(panel, (title, y, logarithmic))| {
        let layout = Layout::auto_from_plots(panel)
            .with_title(title)
            .with_x_label("links, all arms together")
            .with_y_label(y)
            .with_tick_format(TickFormat::Custom(Arc::new(|value| value.to_string())))
            .with_legend_position(LegendPosition::InsideTopLeft);
        if logarithmic {
            layout.with_log_scale().with_x_axis_max(50.0)
        } else {
            layout.with_x_axis_min(0.0).with_y_axis_min(0.0)
        }
    });
    let layouts = layouts.collect();
    let scene =
        Figure::new(2, 2).with_plots(panels).with_layouts(layouts).with_cell_size(480.0, 380.0).with_labels().render();
    SvgBackend::new().with_pretty(true).render_scene(&scene)
}

fn points(rows: &[Row], style: usize, name: &str, value: impl Fn(&Row) -> f64) -> Plot {
    let (color, marker) = STYLES[style];
    let data: Vec<(f64, f64)> = rows.iter().map(|row| (f64::from(row.shape.joints()), value(row))).collect();
    Plot::Scatter(
        ScatterPlot::new().with_data(data).with_color(color).with_marker(marker).with_size(4.5).with_legend(name),
    )
}
