//! The elements of an XML document with their lines, read from the parser's events without recursion.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Error, Reader, XmlVersion};
use std::collections::HashMap;

/// Largest depth of nested elements; a URDF has about six.
const MAX_DEPTH: usize = 64;

/// An element.
#[derive(Debug)]
pub(super) struct Element<'a> {
    tag: BytesStart<'a>,
    /// Of its start, counted from 1.
    pub(super) line: usize,
    /// The elements in it, in the order of the document; text, comments and processing instructions are no elements.
    pub(super) children: Vec<Self>,
}

/// Why a text has no tree of elements: the message, with its line where it has one.
pub(super) type XmlError = String;

/// The root element of a document.
///
/// Its time is linear in the length of the text. Entities other than XML's five and character references are not
/// expanded, so that no text grows.
pub(super) fn root(text: &str) -> Result<Element<'_>, XmlError> {
    let mut reader = Reader::from_str(text);
    let mut lines = Lines { text, at: 0, line: 1 };
    // the elements whose ends have not been read, outermost first, no more than MAX_DEPTH of them
    let mut open: Vec<Element<'_>> = Vec::new();
    let (mut root, mut depth, mut deepest) = (None, 0_usize, 0_usize);
    let outcome = loop {
        let line = lines.of(reader.buffer_position());
        let (element, is_empty) = match reader.read_event() {
            Ok(Event::Start(tag)) => (Element { tag, line, children: Vec::new() }, false),
            Ok(Event::Empty(tag)) => (Element { tag, line, children: Vec::new() }, true),
            Ok(Event::End(_)) => {
                depth -= 1;
                if let Some(element) = open.pop_if(|_| depth < MAX_DEPTH) {
                    close(element, &mut open, &mut root);
                }
                continue;
            }
            Ok(Event::Text(outside)) if depth == 0 && !outside.as_ref().trim().is_empty() => {
                break Err(format!("line {line}: there is text outside of the elements"));
            }
            Ok(Event::CData(_) | Event::GeneralRef(_)) if depth == 0 => {
                break Err(format!("line {line}: there is text outside of the elements"));
            }
            Ok(Event::Eof) => break Ok(()),
            Ok(_) => continue,
            Err(error) => {
                let line = lines.of(reader.error_position().max(lines.at as u64));
                break Err(format!("line {line}: {}", reason(&error)));
            }
        };
        if depth == 0 && root.is_some() {
            break Err(format!("line {line}: there is a second root element, `<{}>`", element.name()));
        }
        deepest = deepest.max(depth + 1);
        if !is_empty {
            depth += 1;
        }
        if depth + usize::from(is_empty) <= MAX_DEPTH {
            if is_empty { close(element, &mut open, &mut root) } else { open.push(element) }
        }
    };
    if deepest > MAX_DEPTH {
        return Err(format!("its elements are nested {deepest} deep, expected {MAX_DEPTH} at most"));
    }
    outcome?;
    match (open.pop(), root) {
        (Some(element), _) => Err(format!("line {}: `<{}>` is not closed", element.line, element.name())),
        (None, None) => Err("it has no elements".to_owned()),
        (None, Some(root)) => Ok(root),
    }
}

/// Puts an element into the one around it.
fn close<'a>(element: Element<'a>, open: &mut [Element<'a>], root: &mut Option<Element<'a>>) {
    match open.last_mut() {
        Some(outer) => outer.children.push(element),
        None => *root = Some(element),
    }
}

/// The parser's message, without prefix.
fn reason(error: &Error) -> String {
    match error {
        Error::IllFormed(error) => error.to_string(),
        Error::Syntax(error) => error.to_string(),
        other => other.to_string(),
    }
}

/// Lines of increasing offsets.
struct Lines<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl Lines<'_> {
    fn of(&mut self, offset: u64) -> usize {
        let offset = usize::try_from(offset).unwrap_or(usize::MAX).min(self.text.len());
        let passed = self.text.get(self.at..offset).unwrap_or_default();
        self.line += passed.matches('\n').count();
        self.at = self.at.max(offset);
        self.line
    }
}

impl Element<'_> {
    /// The name with its prefix.
    pub(super) fn name(&self) -> &str {
        self.tag.name().into_inner()
    }

    /// The attributes by name, with XML's five entities and character references replaced.
    ///
    /// # Errors
    /// The message of an attribute that is malformed or given twice.
    pub(super) fn attributes(&self) -> Result<HashMap<&str, String>, String> {
        let mut found = HashMap::new();
        for attribute in self.tag.attributes() {
            let attribute = attribute.map_err(|error| format!("<{}>: {error}", self.name()))?;
            let value = attribute.normalized_value(XmlVersion::Explicit1_0);
            let value = value.map_err(|error| format!("`{}` of <{}>: {error}", attribute.key.as_ref(), self.name()))?;
            found.insert(attribute.key.into_inner(), value.into_owned());
        }
        Ok(found)
    }
}
