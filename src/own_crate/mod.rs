//! A crate of one's own: a robot, its graph, a first scenario, and the command line with the robot's compiled code.
//!
//! # Example
//! ```
//! use planar_capture::layout::Layout;
//! use planar_capture::own_crate::{Dependency, OwnCrate, renamed};
//!
//! let text = std::fs::read_to_string("codegen/layouts/single_arm_3r.toml")?;
//! let layout = Layout::parse(&text, "single_arm_3r.toml")?;
//! let layout_text = renamed(&text, &layout, "servicer");
//! let files = OwnCrate {
//!     layout: &Layout { name: "servicer".to_owned(), ..layout },
//!     layout_text: &layout_text,
//!     graph: &std::fs::read_to_string("codegen/graphs/single_arm_3r.json")?,
//!     dependency: &Dependency::Version("0.1.0".to_owned()),
//! }
//! .files();
//! let text = |wanted: &str| files.iter().find(|(path, _)| path == wanted).map_or("", |(_, text)| text);
//! let manifest: toml::Table = text("Cargo.toml").parse()?;
//! assert_eq!(manifest["package"]["name"].as_str(), Some("servicer"));
//! assert_eq!(manifest["dependencies"]["planar-capture"]["version"].as_str(), Some("0.1.0"));
//! assert_eq!(Layout::parse(text("layouts/servicer.toml"), "servicer.toml")?.joints(), 3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod dependency;
mod layout_text;
mod motion;
mod name;
mod vendor;

pub use dependency::Dependency;
pub use layout_text::renamed;
pub use name::{NoName, check_name};
pub use vendor::has_sources;

use crate::layout::Layout;

/// What a crate of one's own is made of.
#[derive(Clone, Copy, Debug)]
pub struct OwnCrate<'a> {
    /// The robot; its name is the crate's.
    pub layout: &'a Layout,
    /// Its TOML text.
    pub layout_text: &'a str,
    /// Its graph, with reference vectors.
    pub graph: &'a str,
    /// Where `planar-capture` comes from.
    pub dependency: &'a Dependency,
}

/// Files that are the same but for the robot's name.
const TEMPLATES: [(&str, &str); 7] = [
    (".gitignore", include_str!("templates/gitignore.txt")),
    ("Cargo.toml", include_str!("templates/manifest.txt")),
    ("README.md", include_str!("templates/readme.txt")),
    ("build.rs", include_str!("templates/build.txt")),
    ("src/law.rs", include_str!("templates/law.txt")),
    ("src/main.rs", include_str!("templates/main.txt")),
    ("src/tests.rs", include_str!("templates/tests.txt")),
];

impl OwnCrate<'_> {
    /// (path, text) of every file, the sources of `planar-capture` included where they come with it.
    #[must_use]
    pub fn files(&self) -> Vec<(String, String)> {
        let name = &self.layout.name;
        let fill = |text: &str| {
            let text = text.replace("{{ name }}", name).replace("{{ dependency }}", &self.dependency.to_toml());
            text.replace("{{ about }}", &self.dependency.about())
        };
        let mut files: Vec<_> = TEMPLATES.iter().map(|(path, text)| ((*path).to_owned(), fill(text))).collect();
        files.push((format!("layouts/{name}.toml"), self.layout_text.to_owned()));
        files.push((format!("layouts/{name}.json"), self.graph.to_owned()));
        files.push(("scenarios/first.toml".to_owned(), motion::scenario(self.layout)));
        if *self.dependency == Dependency::Vendored {
            files.extend(vendor::files());
        }
        files
    }
}
