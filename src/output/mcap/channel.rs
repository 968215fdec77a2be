//! An MCAP file in the making.

use foxglove::Encode;
use foxglove::messages::Timestamp;
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{self, Cursor};
use std::marker::PhantomData;

const NANOSECONDS: f64 = 1e9;

/// Channels and messages, in memory.
///
/// In memory, because the library's writer finishes the file when it is dropped and panics where that fails, as on a
/// full disk; and because its sinks that do not panic only log what they could not write.
pub(super) struct Recording {
    writer: Writer<Cursor<Vec<u8>>>,
    sequences: BTreeMap<u16, u32>,
}

/// Where messages of one kind go.
#[derive(Debug)]
pub(super) struct Channel<M> {
    id: u16,
    message: PhantomData<fn(&M)>,
}

impl<M> Clone for Channel<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Channel<M> {}

impl Recording {
    pub(super) fn new() -> io::Result<Self> {
        // one thread: the same bytes on any number of processors
        let options =
            WriteOptions::new().library(concat!("planar-capture/", env!("CARGO_PKG_VERSION"))).compression_threads(0);
        let writer = options.create(Cursor::new(Vec::new())).map_err(failed)?;
        Ok(Self { writer, sequences: BTreeMap::new() })
    }

    /// What the file says about itself.
    pub(super) fn metadata<const N: usize>(&mut self, name: &str, entries: [(&str, String); N]) -> io::Result<()> {
        let metadata = entries.map(|(key, value)| (key.to_owned(), value)).into();
        self.writer.write_metadata(&Metadata { name: name.to_owned(), metadata }).map_err(failed)
    }

    /// A channel of one of Foxglove's own messages.
    pub(super) fn channel<M: Encode>(&mut self, topic: &str) -> io::Result<Channel<M>> {
        let schema = M::get_schema().ok_or_else(|| io::Error::other("a message without a schema"))?;
        let id = self.raw_channel(topic, &schema.name, &schema.data, &BTreeMap::new())?;
        Ok(Channel { id, message: PhantomData })
    }

    /// A channel of messages that `schema`, an encoded `FileDescriptorSet`, describes; its number.
    pub(super) fn raw_channel(
        &mut self,
        topic: &str,
        message: &str,
        schema: &[u8],
        metadata: &BTreeMap<String, String>,
    ) -> io::Result<u16> {
        let schema = self.writer.add_schema(message, "protobuf", schema).map_err(failed)?;
        self.writer.add_channel(schema, topic, "protobuf", metadata).map_err(failed)
    }

    /// `time` in s from the start of the approach.
    pub(super) fn log<M: Encode>(&mut self, channel: Channel<M>, time: f64, message: &M) -> io::Result<()> {
        let mut bytes = Vec::new();
        message.encode(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
        self.log_raw(channel.id, time, &bytes)
    }

    /// As [`log`](Self::log), for a message that is encoded already.
    pub(super) fn log_raw(&mut self, channel_id: u16, time: f64, message: &[u8]) -> io::Result<()> {
        let sequence = self.sequences.entry(channel_id).or_default();
        let log_time = nanoseconds(time);
        let header = MessageHeader { channel_id, sequence: *sequence, log_time, publish_time: log_time };
        *sequence = sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, message).map_err(failed)
    }

    /// The file's bytes.
    pub(super) fn finish(mut self) -> io::Result<Vec<u8>> {
        self.writer.finish().map_err(failed)?;
        Ok(self.writer.into_inner().into_inner())
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "times are not negative; 584 years are held"
)]
fn nanoseconds(time: f64) -> u64 {
    (time * NANOSECONDS).round() as u64
}

/// The time inside a message; it stands still after 136 years, the most that the message holds.
pub(super) fn timestamp(time: f64) -> Timestamp {
    let (seconds, rest) = (nanoseconds(time) / 1_000_000_000, nanoseconds(time) % 1_000_000_000);
    let held = u32::try_from(seconds).ok().zip(u32::try_from(rest).ok());
    held.map_or(Timestamp::MAX, |(seconds, rest)| Timestamp::new(seconds, rest))
}

fn failed(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    }
}
