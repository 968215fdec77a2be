//! Writes schemas, channels and messages of an MCAP file.

use foxglove::Encode;
use foxglove::messages::Timestamp;
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{McapError, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::marker::PhantomData;

/// An MCAP file, written as it grows; the library holds the last chunk in memory.
///
/// The library's writer finishes the file when it is dropped and panics if that fails, for example on a full disk; its
/// sinks that do not panic only log errors. Hence it writes to a [`Latch`], and the error is that of the whole file.
pub(super) struct Recording<'a> {
    writer: Writer<NoSeek<Latch<'a>>>,
    sequences: BTreeMap<u16, u32>,
}

/// A channel of messages of one type.
#[derive(Debug)]
pub(super) struct Channel<M> {
    id: u16,
    message: PhantomData<fn(&M)>,
}

impl<'a> Recording<'a> {
    pub(super) fn new(to: impl Write + 'a) -> io::Result<Self> {
        // one thread, so that the bytes do not depend on the number of processors
        let options =
            WriteOptions::new().library(concat!("planar-capture/", env!("CARGO_PKG_VERSION"))).compression_threads(0);
        let to = NoSeek::new(Latch { to: Box::new(to), error: None });
        let writer = options.disable_seeking(true).create(to).map_err(io_error)?;
        Ok(Self { writer, sequences: BTreeMap::new() })
    }

    /// Adds a metadata record.
    pub(super) fn metadata(&mut self, name: &str, entries: Vec<(String, String)>) -> io::Result<()> {
        let metadata = entries.into_iter().collect();
        self.writer.write_metadata(&Metadata { name: name.to_owned(), metadata }).map_err(io_error)
    }

    /// Adds a channel of one of Foxglove's message types.
    pub(super) fn channel<M: Encode>(&mut self, topic: &str) -> io::Result<Channel<M>> {
        let schema = M::get_schema().ok_or_else(|| io::Error::other("a message without a schema"))?;
        let id = self.raw_channel(topic, &schema.name, &schema.data, &BTreeMap::new())?;
        Ok(Channel { id, message: PhantomData })
    }

    /// Adds a channel of messages that `schema`, an encoded `FileDescriptorSet`, describes; returns its id.
    pub(super) fn raw_channel(
        &mut self,
        topic: &str,
        message: &str,
        schema: &[u8],
        metadata: &BTreeMap<String, String>,
    ) -> io::Result<u16> {
        let schema = self.writer.add_schema(message, "protobuf", schema).map_err(io_error)?;
        self.writer.add_channel(schema, topic, "protobuf", metadata).map_err(io_error)
    }

    /// Adds a message; `time` since the start of the approach, s.
    pub(super) fn log<M: Encode>(&mut self, channel: &Channel<M>, time: f64, message: &M) -> io::Result<()> {
        let mut bytes = Vec::new();
        message.encode(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
        self.log_raw(channel.id, time, &bytes)
    }

    /// Adds an encoded message, as [`log`](Self::log).
    pub(super) fn log_raw(&mut self, channel_id: u16, time: f64, message: &[u8]) -> io::Result<()> {
        let sequence = self.sequences.entry(channel_id).or_default();
        let log_time = nanoseconds(time);
        let header = MessageHeader { channel_id, sequence: *sequence, log_time, publish_time: log_time };
        *sequence = sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, message).map_err(io_error)
    }

    /// Ends the file; the first error that occurred while it was written.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.writer.finish().map_err(io_error)?;
        let Latch { mut to, error } = self.writer.into_inner().into_inner();
        error.map_or_else(|| to.flush(), Err)
    }
}

/// A writer that keeps its first error and takes what follows as written.
struct Latch<'a> {
    to: Box<dyn Write + 'a>,
    error: Option<io::Error>,
}

impl Write for Latch<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.error.is_none() {
            self.error = self.to.write_all(bytes).err();
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "times are not negative, below 584 years")]
fn nanoseconds(time: f64) -> u64 {
    (time * 1e9).round() as u64
}

/// The time inside a message, which cannot represent more than 136 years.
pub(super) fn timestamp(time: f64) -> Timestamp {
    let (seconds, rest) = (nanoseconds(time) / 1_000_000_000, nanoseconds(time) % 1_000_000_000);
    let parts = u32::try_from(seconds).ok().zip(u32::try_from(rest).ok());
    parts.map_or(Timestamp::MAX, |(seconds, rest)| Timestamp::new(seconds, rest))
}

fn io_error(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    }
}
