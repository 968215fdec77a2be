//! Where a crate of one's own has `planar-capture` from.

/// A source of the crate `planar-capture`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Dependency {
    /// Its own folder `vendor`, with the sources that this program carries.
    Vendored,
    /// A folder, absolute or relative to the crate.
    Path(String),
    /// A git repository.
    Git(String),
    /// A registry.
    Version(String),
}

impl Dependency {
    /// As in a manifest.
    pub(super) fn to_toml(&self) -> String {
        let (key, value) = match self {
            Self::Vendored => ("path", "vendor/planar-capture"),
            Self::Path(path) => ("path", path.as_str()),
            Self::Git(url) => ("git", url.as_str()),
            Self::Version(version) => ("version", version.as_str()),
        };
        format!("{key} = {}", toml::Value::from(value))
    }

    /// Where the library is, in words.
    pub(super) fn about(&self) -> String {
        match self {
            Self::Vendored => {
                "`vendor/` has the sources of `planar-capture`, as of the program that wrote this crate; \
                               `Cargo.lock` the\nversions of everything else that these were tested with."
                    .to_owned()
            }
            Self::Path(from) | Self::Git(from) => format!("`planar-capture` comes from {from}."),
            Self::Version(version) => format!("`planar-capture` {version} comes from the registry."),
        }
    }
}
