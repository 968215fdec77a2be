//! Text in HTML and SVG.

/// As the content of an element.
pub(crate) fn text(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// As the value of an attribute, or the content of an element.
pub(crate) fn attribute(value: &str) -> String {
    text(value).replace('"', "&quot;")
}
