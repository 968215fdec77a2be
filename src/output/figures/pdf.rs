//! SVG as PDF with embedded fonts.

use krilla::Document;
use krilla::geom::Size;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use std::sync::{Arc, LazyLock};
use usvg::{Options, Tree, fontdb};

/// The font that figures name, whatever the machine has.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for font in [dejavu::sans::regular(), dejavu::sans::bold()] {
        fonts.load_font_data(font.to_vec());
    }
    Arc::new(fonts)
});

/// A page with the picture, `width` points wide, or of the picture's size; text stays text.
///
/// # Errors
/// What the libraries say.
pub(super) fn pdf(svg: &str, title: &str, width: Option<f64>) -> Result<Vec<u8>, String> {
    let options = Options { fontdb: Arc::clone(&FONTS), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let (own_width, own_height) = (tree.size().width(), tree.size().height());
    #[allow(clippy::cast_possible_truncation, reason = "a length on a page")]
    let page_width = width.map_or(own_width, |width| width as f32);
    let size = Size::from_wh(page_width, own_height * page_width / own_width).ok_or("a picture without extent")?;
    let mut document = Document::new();
    let program = concat!("planar-capture ", env!("CARGO_PKG_VERSION")).to_owned();
    // without a date: equal figures give equal bytes
    document.set_metadata(Metadata::new().title(title.to_owned()).creator(program));
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    document.finish().map_err(|error| format!("{error:?}"))
}
