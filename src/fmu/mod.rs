//! FMUs: the module of a robot in C with the functions of FMI 3.0 for co-simulation around it, as one archive.
//!
//! [`Fmu::new`] has all texts of the archive, [`binary::compile`] the binary for this machine, and [`archive`] writes
//! and compares archives. The same graph gives the same bytes, but for the binary.
//!
//! It never contains: a formula; the module has them, and its Runge–Kutta step.
//!
//! # Example
//! ```
//! use planar_capture::build::graph;
//! use planar_capture::fmu::{Fmu, Origin};
//! use planar_capture::layout::Layout;
//!
//! let layout = Layout::read("codegen/layouts/single_arm_3r.toml".as_ref())?;
//! let graph = graph::read(&std::fs::read_to_string("codegen/graphs/single_arm_3r.json")?, &layout)?;
//! let sha256 = layout.sha256();
//! let origin = Origin { name: "arm", layout_sha256: &sha256, source: "single_arm_3r.toml", command: "build" };
//! let fmu = Fmu::new(&graph, &origin)?;
//! assert_eq!(fmu.entries[0].path, "modelDescription.xml");
//! // one input for the torque of each joint
//! let description = String::from_utf8_lossy(&fmu.entries[0].content);
//! for joint in 1..=3 {
//!     assert!(description.contains(&format!("arm1_joint{joint}_torque")));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod archive;
pub mod binary;
mod build_description;
mod documentation;
mod model_description;
mod sources;
mod xml;

use crate::build::graph::Graph;
use crate::build::{CModule, CText, CoSimulation};
use crate::layout::sha256;
use model_description::ModelDescription;

/// A file in the archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// From the archive's root, with `/`.
    pub path: String,
    /// The content.
    pub content: Vec<u8>,
}

/// The files of an FMU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fmu {
    /// The name of the layout, of the binary, and the prefix of the module's functions.
    pub name: String,
    /// The files; `modelDescription.xml` is the first.
    pub entries: Vec<Entry>,
}

/// What the headers of the module say of its origin.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    /// The name of the layout, and of the module.
    pub name: &'a str,
    /// The hash of the layout.
    pub layout_sha256: &'a str,
    /// The source that the module's header names.
    pub source: &'a str,
    /// The command that generates the FMU again.
    pub command: &'a str,
}

impl Fmu {
    /// Descriptions, sources and documentation, without a binary.
    ///
    /// # Errors
    /// What [`CModule::render`] and [`CoSimulation::render`] say.
    pub fn new(graph: &Graph, origin: &Origin<'_>) -> Result<Self, String> {
        let Origin { name, source, command, .. } = *origin;
        let file = sources::module_file(name);
        let header = format!("{file}.h");
        let module = CModule { header: &header, source, command };
        let text = module.render(graph)?;
        let describe = |token: &str| -> Result<(CoSimulation, String), String> {
            let robot = CoSimulation::render(graph, &module, token)?;
            let description = ModelDescription { origin, token, variables: &robot.variables }.xml();
            Ok((robot, description))
        };
        let (robot, description) = describe("")?;
        let token = sha256(&hashed(&text, &robot, &description));
        let (robot, description) = describe(&token)?;
        let mut files = vec![
            ("modelDescription.xml".to_owned(), description),
            ("documentation/index.html".to_owned(), documentation::html(origin, &robot.variables)),
            ("documentation/licenses/license.txt".to_owned(), documentation::licences()),
            ("sources/buildDescription.xml".to_owned(), build_description::xml(name)),
            (format!("sources/{file}.c"), text.source),
            (format!("sources/{file}.h"), text.header),
            ("sources/robot.c".to_owned(), robot.source),
            ("sources/robot.h".to_owned(), robot.header),
        ];
        files.extend(sources::fixed().map(|(file, text)| (format!("sources/{file}"), text.to_owned())));
        let entries = files.into_iter().map(|(path, text)| Entry { path, content: text.into_bytes() }).collect();
        Ok(Self { name: name.to_owned(), entries })
    }
}

/// What the token is the hash of: everything but the headers of the module, which name the command.
fn hashed(text: &CText, robot: &CoSimulation, description: &str) -> String {
    let body = |text: &str| text.split_once("\n\n").map_or_else(|| text.to_owned(), |(_, body)| body.to_owned());
    let mut all = vec![body(&text.source), body(&text.header), robot.source.clone(), robot.header.clone()];
    all.extend(sources::fixed().map(|(_, text)| text.to_owned()));
    all.push(description.to_owned());
    all.concat()
}

#[cfg(test)]
mod tests {
    use super::{Fmu, Origin};
    use crate::build::graph;
    use crate::graphs::carried;

    /// The token tells apart what differs in the description alone, as layouts of one structure do.
    #[test]
    fn other_descriptions_have_other_tokens() {
        let (_, text) = carried().find(|(path, _)| path.contains("single_arm_2r")).expect("a graph");
        let graph = graph::read_any(text).expect("a graph");
        let token = |layout_sha256: &str| {
            let origin = Origin { name: "robot", layout_sha256, source: "robot.toml", command: "it" };
            let fmu = Fmu::new(&graph, &origin).expect("an FMU");
            let description =
                fmu.entries.iter().find(|entry| entry.path == "modelDescription.xml").expect("a description");
            let xml = String::from_utf8(description.content.clone()).expect("UTF-8");
            let (_, rest) = xml.split_once("instantiationToken=\"").expect("a token");
            rest.split('"').next().expect("its text").to_owned()
        };
        assert_eq!(token("0a"), token("0a"));
        assert_ne!(token("0a"), token("0b"));
    }
}
