//! Time in the picture: when what is shown, and elements that move with it.

use std::fmt::Write as _;

/// Pause at the end, s.
const PAUSE: f64 = 1.0;

/// The instants of a motion, played in a given time and then again.
#[derive(Debug)]
pub(super) struct Clip {
    /// Parts of the playing time, from 0 to less than 1: the pause follows.
    key_times: String,
    /// Of the motion, s.
    end: f64,
    /// Playing time without the pause, s.
    seconds: f64,
}

impl Clip {
    /// Of instants that begin with 0 and do not fall, s.
    pub(super) fn new(instants: &[f64], seconds: f64) -> Self {
        let end = instants.last().copied().unwrap_or(0.0);
        let mut clip = Self { key_times: String::new(), end, seconds };
        let parts = instants.iter().map(|time| short(clip.part(*time), 4)).collect::<Vec<_>>().join(";");
        clip.key_times = format!("{parts};1");
        clip
    }

    /// The part of the playing time at which an instant is shown.
    fn part(&self, time: f64) -> f64 {
        let played = if self.end > 0.0 { time / self.end } else { 0.0 };
        played * self.seconds / (self.seconds + PAUSE)
    }

    /// Seconds of the motion per second of the picture.
    pub(super) fn speed(&self) -> f64 {
        self.end / self.seconds
    }

    fn duration(&self) -> String {
        short(self.seconds + PAUSE, 2)
    }

    /// A group whose transformation takes these values at the instants; `still` is where it is without animation.
    pub(super) fn moving(&self, kind: &str, values: &[String], still: usize, content: &str) -> String {
        let mut group = format!("<g transform=\"{kind}({})\">", values[still]);
        if let Some(last) = values.last().filter(|_| values.windows(2).any(|pair| pair[0] != pair[1])) {
            let _ = write!(
                group,
                "<animateTransform attributeName=\"transform\" type=\"{kind}\" dur=\"{}s\" repeatCount=\"indefinite\" \
                 keyTimes=\"{}\" values=\"{};{last}\"/>",
                self.duration(),
                self.key_times,
                values.join(";"),
            );
        }
        group + content + "</g>"
    }

    /// An attribute of 0 that runs evenly to a value at the last instant.
    pub(super) fn even(&self, name: &str, to: &str) -> String {
        format!(
            "<animate attributeName=\"{name}\" dur=\"{}s\" repeatCount=\"indefinite\" keyTimes=\"0;{};1\" \
             values=\"0;{to};{to}\"/>",
            self.duration(),
            short(self.part(self.end), 4),
        )
    }

    /// A group that is seen from one instant on, until another or the end.
    pub(super) fn seen(&self, from: f64, until: Option<f64>, content: &str) -> String {
        let until = until.map_or(1.0, |until| self.part(until.min(self.end)).max(self.part(from)));
        format!(
            "<g><animate attributeName=\"opacity\" calcMode=\"discrete\" dur=\"{}s\" repeatCount=\"indefinite\" \
             keyTimes=\"0;{};{}\" values=\"0;1;{}\"/>{content}</g>",
            self.duration(),
            short(self.part(from), 4),
            short(until, 4),
            u8::from(until >= 1.0),
        )
    }
}

/// With at most so many digits after the point; never a negative zero.
pub(in crate::output) fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A point of the plane.
pub(super) fn pair([x, y]: [f64; 2]) -> String {
    format!("{} {}", short(x, 4), short(y, 4))
}

#[cfg(test)]
mod tests {
    use super::{Clip, short};

    #[test]
    fn instants_are_parts_of_the_playing_time_before_the_pause() {
        let clip = Clip::new(&[0.0, 5.0, 20.0], 4.0);
        assert_eq!(clip.key_times, "0;0.2;0.8;1");
        assert_eq!(clip.duration(), "5");
        assert!((clip.speed() - 5.0).abs() < 1e-15);
        let values = ["1", "2", "3"].map(str::to_owned);
        assert!(clip.moving("rotate", &values, 1, "").contains("values=\"1;2;3;3\""));
        assert_eq!(clip.moving("rotate", &["1".to_owned(), "1".to_owned()], 0, ""), "<g transform=\"rotate(1)\"></g>");
        assert!(clip.seen(5.0, None, "").contains("keyTimes=\"0;0.2;1\" values=\"0;1;1\""));
        assert!(clip.seen(5.0, Some(30.0), "").contains("keyTimes=\"0;0.2;0.8\" values=\"0;1;0\""));
    }

    #[test]
    fn numbers_have_no_digits_too_many() {
        assert_eq!(
            ["0.5", "-2", "0", "100"],
            [0.5, -2.0, -0.000_04, 100.0].map(|value| short(value, 4)).each_ref().map(String::as_str)
        );
    }
}
