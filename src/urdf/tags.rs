//! The opening tags of an XML text with their lines, which the XML parser does not report.

/// An opening tag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tag<'a> {
    /// The name and the attributes.
    pub(super) text: &'a str,
    /// Counted from 1.
    pub(super) line: usize,
    /// Number of enclosing elements.
    pub(super) depth: usize,
    /// The text from this tag on.
    pub(super) rest: &'a str,
}

/// All opening tags, without comments, processing instructions and declarations.
pub(super) fn tags(text: &str) -> Vec<Tag<'_>> {
    let (mut found, mut depth, mut line) = (Vec::new(), 0_usize, 1);
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        let (before, element) = rest.split_at(start);
        line += before.matches('\n').count();
        let (tag, after) = if element.starts_with("<!--") {
            element.split_once("-->").unwrap_or((element, ""))
        } else {
            element.split_once('>').unwrap_or((element, ""))
        };
        if tag.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if !tag.starts_with("<!") && !tag.starts_with("<?") {
            found.push(Tag { text: tag.trim_start_matches('<').trim_end_matches('/'), line, depth, rest: element });
            depth += usize::from(!tag.ends_with('/'));
        }
        line += tag.matches('\n').count();
        rest = after;
    }
    found
}

impl<'a> Tag<'a> {
    /// The element's name.
    pub(super) fn name(&self) -> &'a str {
        self.text.split_whitespace().next().unwrap_or_default()
    }

    /// Names and values of the attributes.
    pub(super) fn attributes(&self) -> Vec<(&'a str, &'a str)> {
        let mut found = Vec::new();
        let mut rest = self.text;
        while let Some((before, after)) = rest.split_once('=') {
            let name = before.split_whitespace().last().unwrap_or_default();
            let Some(quote) = after.trim_start().chars().next().filter(|c| matches!(c, '"' | '\'')) else { break };
            let Some((value, behind)) = after.trim_start().get(1..).and_then(|v| v.split_once(quote)) else { break };
            found.push((name, value));
            rest = behind;
        }
        found
    }

    /// One attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<&'a str> {
        self.attributes().into_iter().find(|(other, _)| *other == name).map(|(_, value)| value)
    }
}
