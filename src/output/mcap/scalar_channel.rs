//! Channels of messages of `double` fields, with their schemas.

use super::recording::Recording;
use prost::Message;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet};
use std::collections::{BTreeMap, HashSet};
use std::io;

const PACKAGE: &str = "planar_capture";

/// A channel of messages whose fields are all `double`.
pub(super) struct ScalarChannel {
    id: u16,
}

impl ScalarChannel {
    /// Adds the channel `/name` of messages `planar_capture.Name`. `fields` are names and units; the channel's metadata
    /// has the unit of each field.
    pub(super) fn new(recording: &mut Recording<'_>, name: &str, fields: &[(&str, &str)]) -> io::Result<Self> {
        let names = identifiers(fields.iter().map(|(name, _)| *name));
        let mut letters = name.chars();
        let message: String = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
        let schema = schema(name, &message, &names).encode_to_vec();
        let units: BTreeMap<_, _> =
            names.into_iter().zip(fields).map(|(name, (_, unit))| (name, (*unit).to_owned())).collect();
        let id = recording.raw_channel(&format!("/{name}"), &format!("{PACKAGE}.{message}"), &schema, &units)?;
        Ok(Self { id })
    }

    /// Adds a message with values in the order of the fields.
    pub(super) fn log(
        &self,
        recording: &mut Recording<'_>,
        time: f64,
        values: impl Iterator<Item = f64>,
    ) -> io::Result<()> {
        let mut bytes = Vec::new();
        for (number, value) in (1..).zip(values) {
            prost::encoding::double::encode(number, &value, &mut bytes);
        }
        recording.log_raw(self.id, time, &bytes)
    }
}

fn schema(name: &str, message: &str, fields: &[String]) -> FileDescriptorSet {
    let field = |(number, name): (i32, &String)| FieldDescriptorProto {
        name: Some(name.clone()),
        number: Some(number),
        label: Some(Label::Optional.into()),
        r#type: Some(Type::Double.into()),
        ..FieldDescriptorProto::default()
    };
    let message = DescriptorProto {
        name: Some(message.to_owned()),
        field: (1..).zip(fields).map(field).collect(),
        ..DescriptorProto::default()
    };
    let file = FileDescriptorProto {
        name: Some(format!("{PACKAGE}/{name}.proto")),
        package: Some(PACKAGE.to_owned()),
        message_type: vec![message],
        syntax: Some("proto3".to_owned()),
        ..FileDescriptorProto::default()
    };
    FileDescriptorSet { file: vec![file] }
}

/// Unique protobuf identifiers for names that contain arbitrary characters, such as those of arms.
///
/// A character other than a letter, digit or underscore becomes `_`; a name that is then taken gets a number. Names that
/// differ only in underscores and capitals clash too, since protobuf gives them the same name in JSON.
fn identifiers<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken = HashSet::new();
    let key = |name: &str| name.replace('_', "").to_ascii_lowercase();
    let unique = |name: &str| {
        let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let start = if plain.starts_with(|c: char| c.is_ascii_alphabetic()) { plain } else { format!("the_{plain}") };
        let numbered = (2_u32..).map(|number| format!("{start}_no{number}"));
        let free = std::iter::once(start.clone()).chain(numbered).find(|name| taken.insert(key(name)));
        free.expect("fewer names than numbers")
    };
    names.map(unique).collect()
}

#[cfg(test)]
mod tests {
    use super::identifiers;

    #[test]
    fn any_name_becomes_one_that_protobuf_takes() {
        let names = ["base_yaw", "arm 1", "arm_1", "arm1", "Ärm", "1st"];
        assert_eq!(
            identifiers(names.into_iter()),
            ["base_yaw", "arm_1", "arm_1_no2", "arm1_no3", "the__rm", "the_1st"]
        );
    }
}
