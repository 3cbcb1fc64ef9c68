//! The PNG of a figure: its SVG, drawn with the fonts that this program carries.

use std::sync::{Arc, LazyLock};

use anyhow::{Context as _, Result};
use dejavu::sans;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

/// Pixels of the PNG for one unit of the SVG: sharp on a projector.
const SCALE: f32 = 2.0;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for face in [sans::regular(), sans::bold(), sans::oblique(), sans::bold_oblique()] {
        fonts.load_font_data(face.to_vec());
    }
    Arc::new(fonts)
});

pub(super) fn png(svg: &str) -> Result<Vec<u8>> {
    let options = Options { fontdb: FONTS.clone(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).context("the figure is not valid SVG")?;
    let size = tree.size().to_int_size();
    let size = size.scale_by(SCALE).context("the figure has no area")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).context("the figure has no area")?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().context("the PNG could not be encoded")
}
