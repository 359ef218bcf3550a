//! The canvas of a picture: maps metres of a view to pixels of a PNG.

use super::glyphs::{self, COLUMNS, ROWS};
use super::view::SceneView;
use scene::Vec2;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform,
};

/// Side of a picture, pixels.
pub const SIDE_PX: u32 = 800;

/// Longer lines are not dashed, because dashes would be drawn far outside the picture too, pixels.
const MOST_DASHED_PX: f32 = 20_000.0;

/// Red, green, blue, and opacity.
pub type Ink = (u8, u8, u8, u8);

/// Style of a line.
#[derive(Clone, Copy, Debug)]
pub struct LineStyle {
    /// Colour.
    pub ink: Ink,
    /// Pixels.
    pub width_px: f32,
    /// Length of dashes and of gaps, pixels.
    pub dash_px: Option<f32>,
}

impl LineStyle {
    /// A line without gaps.
    pub const fn plain(ink: Ink, width_px: f32) -> Self {
        Self { ink, width_px, dash_px: None }
    }
}

/// A picture in progress.
pub struct Paper {
    pixels: Pixmap,
    view: SceneView,
    scale: f64,
}

impl Paper {
    /// An empty picture; `None` if there is no memory for it.
    pub fn new(view: SceneView, ground: Ink) -> Option<Self> {
        let mut pixels = Pixmap::new(SIDE_PX, SIDE_PX)?;
        pixels.fill(colour(ground));
        Some(Self { pixels, view, scale: f64::from(SIDE_PX) / view.width_m })
    }

    /// Converts metres to pixels.
    pub fn px(&self, metres: f64) -> f32 {
        (metres * self.scale) as f32
    }

    /// Pixel of a point.
    pub fn at(&self, place: Vec2) -> (f32, f32) {
        let half = 0.5 * self.view.width_m;
        let (right, down) = (place.x - self.view.centre.x + half, half - (place.y - self.view.centre.y));
        (self.px(right), self.px(down))
    }

    fn path(&self, points: &[Vec2], closed: bool) -> Option<Path> {
        let mut path = PathBuilder::new();
        for (i, point) in points.iter().enumerate() {
            let (x, y) = self.at(*point);
            if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if closed {
            path.close();
        }
        path.finish()
    }

    /// A line through points; an invisible one is skipped.
    pub fn line(&mut self, points: &[Vec2], closed: bool, style: LineStyle) {
        if !self.view.shows(points, 10.0) {
            return;
        }
        let Some(path) = self.path(points, closed) else { return };
        let length_m: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let dash_px = style.dash_px.filter(|_| self.px(length_m) < MOST_DASHED_PX);
        let dash = dash_px.and_then(|length| StrokeDash::new(vec![length, length], 0.0));
        let stroke = Stroke {
            width: style.width_px,
            line_cap: if dash.is_some() { LineCap::Butt } else { LineCap::Round },
            line_join: LineJoin::Round,
            dash,
            ..Stroke::default()
        };
        self.pixels.stroke_path(&path, &paint(style.ink), &stroke, Transform::identity(), None);
    }

    /// An area with holes.
    pub fn area(&mut self, rings: &[&[Vec2]], ink: Ink) {
        let mut path = PathBuilder::new();
        for ring in rings.iter().filter(|ring| ring.len() > 2) {
            for (i, point) in ring.iter().enumerate() {
                let (x, y) = self.at(*point);
                if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
            }
            path.close();
        }
        if let Some(path) = path.finish() {
            self.pixels.fill_path(&path, &paint(ink), FillRule::EvenOdd, Transform::identity(), None);
        }
    }

    /// A dot with its radius in pixels.
    pub fn dot(&mut self, place: Vec2, radius_px: f32, ink: Ink) {
        let (x, y) = self.at(place);
        if let Some(path) = PathBuilder::from_circle(x, y, radius_px) {
            self.pixels.fill_path(&path, &paint(ink), FillRule::Winding, Transform::identity(), None);
        }
    }

    /// A ring with its radius in pixels.
    pub fn ring(&mut self, place: Vec2, radius_px: f32, ink: Ink) {
        let (x, y) = self.at(place);
        if let Some(path) = PathBuilder::from_circle(x, y, radius_px) {
            let stroke = Stroke { width: 2.0, ..Stroke::default() };
            self.pixels.stroke_path(&path, &paint(ink), &stroke, Transform::identity(), None);
        }
    }

    /// Text on a plate, with its upper left corner at a pixel and this width of a letter's square.
    pub fn text(&mut self, (left, top): (f32, f32), text: &str, square_px: f32, ink: Ink) {
        let width = text_width(text, square_px);
        let height = ROWS as f32 * square_px;
        self.plate((left - square_px, top - square_px), (width + square_px, height + 2.0 * square_px));
        for (place, letter) in text.chars().enumerate() {
            let from = left + (place * (COLUMNS + 1)) as f32 * square_px;
            for (column, row) in glyphs::squares(letter) {
                let corner = (from + column as f32 * square_px, top + row as f32 * square_px);
                self.rectangle(corner, (square_px, square_px), ink);
            }
        }
    }

    fn plate(&mut self, corner: (f32, f32), size: (f32, f32)) {
        self.rectangle(corner, size, (255, 255, 255, 200));
    }

    /// A rectangle of pixels.
    pub fn rectangle(&mut self, (left, top): (f32, f32), (width, height): (f32, f32), ink: Ink) {
        if let Some(rect) = Rect::from_xywh(left, top, width, height) {
            self.pixels.fill_rect(rect, &paint(ink), Transform::identity(), None);
        }
    }

    /// The PNG; `None` if it cannot be encoded.
    pub fn png(&self) -> Option<Vec<u8>> {
        self.pixels.encode_png().ok()
    }
}

/// Width of a text, pixels.
pub fn text_width(text: &str, square_px: f32) -> f32 {
    (text.chars().count() * (COLUMNS + 1)) as f32 * square_px
}

fn colour((red, green, blue, cover): Ink) -> Color {
    Color::from_rgba8(red, green, blue, cover)
}

fn paint(ink: Ink) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(colour(ink));
    paint
}
