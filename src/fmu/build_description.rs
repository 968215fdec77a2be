//! `buildDescription.xml`: how the sources are compiled.

use super::sources::compiled;
use super::xml::Element;

/// The document for a module of this name.
pub(super) fn xml(name: &str) -> String {
    let files = compiled(name).into_iter().map(|file| Element::new("SourceFile").with("name", &file));
    let set = Element::new("SourceFileSet").with("language", &"C99").containing(files);
    let build = Element::new("BuildConfiguration").with("modelIdentifier", &name).containing([set]);
    Element::new("fmiBuildDescription").with("fmiVersion", &"3.0").containing([build]).document()
}
