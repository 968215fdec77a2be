//! XML documents from elements.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesStart, Event};
use std::io;

/// An element with its attributes and the elements in it.
#[derive(Debug, Default)]
pub(super) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Self>,
}

impl Element {
    pub(super) fn new(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }

    /// With one attribute more.
    pub(super) fn with(mut self, name: &'static str, value: &impl ToString) -> Self {
        self.attributes.push((name, value.to_string()));
        self
    }

    /// With more elements in it.
    pub(super) fn containing(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// The document that has this element as its root.
    pub(super) fn document(&self) -> String {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        let declaration = Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None));
        let written = writer.write_event(declaration).and_then(|()| self.write(&mut writer));
        let mut bytes = written.map(|()| writer.into_inner()).expect("a vector takes everything");
        bytes.push(b'\n');
        String::from_utf8(bytes).expect("elements are text")
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let mut start = BytesStart::new(self.name);
        start.extend_attributes(self.attributes.iter().map(|(name, value)| (*name, value.as_str())));
        if self.children.is_empty() {
            return writer.write_event(Event::Empty(start));
        }
        let end = start.to_end().into_owned();
        writer.write_event(Event::Start(start))?;
        self.children.iter().try_for_each(|child| child.write(writer))?;
        writer.write_event(Event::End(end))
    }
}
