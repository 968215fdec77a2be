//! Rows of the CSV. Parquet and MCAP: the numbers of the CSV, errors on a full disk, and the message of a build without them.
#![allow(clippy::float_cmp, reason = "what is written is what is computed, bit by bit")]

use crate::{command, run, scenario};
use planar_proof::file;
use tempfile::TempDir;

/// Message of a run that asks for an output which this build lacks.
#[cfg(not(any(feature = "figures", feature = "parquet", feature = "mcap")))]
fn refused(flags: &[&str]) -> String {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let scenario = file("scenarios/raina_shah_2017.toml");
    let output = command().arg("run").arg(scenario).args(flags).arg("--out").arg(&results).output();
    let (code, _, message) = planar_proof::said(output.expect("it runs"));
    assert_eq!(code, 2);
    assert!(!results.exists(), "nothing was computed");
    message
}

#[cfg(not(any(feature = "figures", feature = "parquet", feature = "mcap")))]
#[test]
fn a_build_without_them_says_how_to_get_one_with_all_that_is_asked_for() {
    for (flags, lack, features) in [
        (&["--parquet"][..], "writes no Parquet", "parquet"),
        (&["--mcap"], "writes no MCAP", "mcap"),
        (
            &["--mcap", "--figures", "--parquet"],
            "draws no figures and writes no Parquet and writes no MCAP",
            "figures,parquet,mcap",
        ),
    ] {
        let message = refused(flags);
        assert!(message.starts_with(&format!("error: this build {lack};")), "{message}");
        assert!(message.contains(&format!("cargo run --release --features {features} -- …")), "{message}");
        assert!(message.contains(&format!("cargo install --path . --features {features}")), "{message}");
    }
}

/// The cases of a study in any order by one writer, of a common approach and of one of its own, as each by itself.
#[test]
fn rows_of_a_common_approach_are_those_of_each_case() {
    use planar_capture::output::time_series::{CsvWriter, write_csv};

    let mut scenario = scenario("raina_shah_2017");
    (scenario.approach.step, scenario.post_impact.as_mut().expect("a phase").duration) = (0.05, 1.0);
    let mut study = run(&scenario);
    study.cases[1].approach = Some(study.approach.clone());
    study.cases[1].approach.as_mut().expect("its own").samples[3].state.base_pose[1] = 7.0;
    let mut writer = CsvWriter::new(&scenario, &study);
    for index in [1, 0, 2, 1, 0] {
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        writer.write(&study.cases[index], &mut found).expect("written");
        write_csv(&scenario, &study, &study.cases[index], &mut expected).expect("written");
        assert_eq!(found, expected, "{index}");
        assert!(String::from_utf8(found).expect("text").lines().count() > 400);
    }
}

#[cfg(any(feature = "parquet", feature = "mcap"))]
mod written {
    use super::*;
    use planar_capture::capture::{CaseResult, Study};
    use planar_capture::output::time_series::write_csv;
    use planar_capture::scenario::Scenario;
    use std::io::{self, Write};

    /// A case's CSV: headings, and the cells of each row.
    pub fn csv(scenario: &Scenario, study: &Study, case: &CaseResult) -> (Vec<String>, Vec<Vec<String>>) {
        let mut text = Vec::new();
        write_csv(scenario, study, case, &mut text).expect("written");
        let mut csv = csv::Reader::from_reader(&text[..]);
        let texts = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let headings = texts(csv.headers().expect("a header"));
        (headings, csv.records().map(|row| texts(&row.expect("a row"))).collect())
    }

    pub fn bits(cell: &str) -> u64 {
        cell.parse::<f64>().expect("a number").to_bits()
    }

    /// A disk that is full after so many bytes.
    pub struct Full(pub usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let fits = bytes.len().min(self.0);
            self.0 -= fits;
            if fits == 0 && !bytes.is_empty() { Err(io::ErrorKind::StorageFull.into()) } else { Ok(fits) }
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    /// A full disk is an error at any byte: never a panic, never a truncated file taken for a complete one.
    pub fn assert_survives_a_full_disk(whole: usize, write: impl Fn(Full) -> io::Result<()>) {
        for room in [0, 3, 4, 1000, whole / 2, whole - 1] {
            let error = write(Full(room)).expect_err("the disk is full");
            assert_eq!(error.kind(), io::ErrorKind::StorageFull, "room for {room} of {whole} bytes: {error}");
        }
        write(Full(whole)).expect("there is room");
    }

    #[test]
    fn run_writes_them_beside_the_csv() {
        let folder = TempDir::new().expect("a folder");
        let results = folder.path().join("results");
        let mut command = command();
        command.arg("run").arg(file("scenarios/redysim_single_arm_3r.toml")).arg("--out").arg(&results);
        let mut expected = vec!["redysim_single_arm_3r.csv".to_owned(), "summary.json".to_owned()];
        for (there, kind) in [(cfg!(feature = "parquet"), "parquet"), (cfg!(feature = "mcap"), "mcap")] {
            if there {
                command.arg(format!("--{kind}"));
                expected.push(format!("redysim_single_arm_3r.{kind}"));
            }
        }
        assert!(command.output().expect("it runs").status.success());
        let names = std::fs::read_dir(&results).expect("results").map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = names.map(|name| name.into_string().expect("UTF-8")).collect();
        names.sort();
        expected.sort();
        assert_eq!(names, expected);
    }
}

#[cfg(feature = "parquet")]
mod parquet_files {
    use super::written::{assert_survives_a_full_disk, bits, csv};
    use crate::{manifest, run, scenario};
    use arrow_array::cast::AsArray;
    use arrow_array::types::{Float64Type, Int8Type};
    use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
    use planar_capture::output::time_series::write_parquet;

    #[test]
    fn have_the_csvs_columns_and_values() {
        let scenario = scenario("stabilised_capture");
        let study = run(&scenario);
        let origin = manifest(&scenario);
        for case in &study.cases {
            let mut bytes = Vec::new();
            write_parquet(&scenario, &study, case, &origin, &mut bytes).expect("written");
            assert_survives_a_full_disk(bytes.len(), |to| write_parquet(&scenario, &study, case, &origin, to));
            let path = tempfile::NamedTempFile::new().expect("a file");
            std::fs::write(path.path(), &bytes).expect("written");
            let reader =
                ParquetRecordBatchReaderBuilder::try_new(path.reopen().expect("it is there")).expect("Parquet");
            let entries = reader.metadata().file_metadata().key_value_metadata().expect("metadata").clone();
            let entry = |key: &str| entries.iter().find(|entry| entry.key == key).and_then(|entry| entry.value.clone());
            assert_eq!(entry("scenario").as_deref(), Some("stabilised_capture"));
            assert_eq!(entry("layout").as_ref(), Some(&scenario.layout.name));
            assert_eq!(entry("layout_sha256"), Some(scenario.layout.sha256()));
            assert_eq!(entry("case").as_ref(), Some(&case.name));
            assert_eq!(entry("planar_capture_version").as_deref(), Some(env!("CARGO_PKG_VERSION")));
            for (key, value) in origin.entries() {
                assert_eq!(entry(&key), Some(value), "{key}");
            }

            let (headings, rows) = csv(&scenario, &study, case);
            assert!(headings.iter().any(|heading| heading == "base_torque [N m]"), "{headings:?}");
            let schema = reader.schema().clone();
            let names: Vec<&String> = schema.fields().iter().map(|field| field.name()).collect();
            assert_eq!(names, headings.iter().collect::<Vec<_>>());
            for field in schema.fields().iter().filter(|field| field.name() != "phase") {
                let unit = field.metadata().get("unit").expect("a unit");
                assert!(field.name().ends_with(&format!(" [{unit}]")), "{field:?}");
            }
            let mut row = rows.iter();
            for batch in reader.with_batch_size(1000).build().expect("a reader") {
                let batch = batch.expect("a batch");
                for i in 0..batch.num_rows() {
                    for ((heading, cell), column) in
                        headings.iter().zip(row.next().expect("a row")).zip(batch.columns())
                    {
                        if heading == "phase" {
                            let phases = column.as_dictionary::<Int8Type>();
                            let key = usize::try_from(phases.keys().value(i)).expect("a key");
                            assert_eq!(phases.values().as_string::<i32>().value(key), cell);
                        } else {
                            assert_eq!(
                                column.as_primitive::<Float64Type>().value(i).to_bits(),
                                bits(cell),
                                "{heading}"
                            );
                        }
                    }
                }
            }
            assert_eq!(row.next(), None);
        }
    }
}

#[cfg(feature = "mcap")]
mod mcap_files {
    use super::written::{assert_survives_a_full_disk, bits, csv};
    use crate::{manifest, run, scenario};
    use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate, Timestamp};
    use planar_capture::capture::{CaseResult, LaterImpact, Study};
    use planar_capture::outline::Outline;
    use planar_capture::output::mcap::write_mcap;
    use planar_capture::output::time_series::Columns;
    use planar_capture::scenario::Scenario;
    use planar_proof::{assert_close, tolerance};
    use prost::Message;
    use std::collections::{BTreeMap, BTreeSet};

    /// (time in ns, message) of each topic; number, name and unit of its fields.
    struct File {
        messages: BTreeMap<String, Vec<(u64, Vec<u8>)>>,
        fields: BTreeMap<String, BTreeMap<u32, String>>,
        units: BTreeMap<String, BTreeMap<String, String>>,
    }

    fn record(scenario: &Scenario, study: &Study, case: &CaseResult) -> (Vec<u8>, File) {
        let mut bytes = Vec::new();
        write_mcap(scenario, study, case, &manifest(scenario), &mut bytes).expect("written");
        let mut file = File { messages: BTreeMap::new(), fields: BTreeMap::new(), units: BTreeMap::new() };
        let mut latest = 0;
        for message in mcap::MessageStream::new(&bytes).expect("MCAP") {
            let message = message.expect("a message");
            assert!(message.log_time >= latest, "{} ns after {latest} ns", message.log_time);
            latest = message.log_time;
            let topic = message.channel.topic.clone();
            let schema = message.channel.schema.clone().expect("a schema");
            assert_eq!((message.channel.message_encoding.as_str(), schema.encoding.as_str()), ("protobuf", "protobuf"));
            file.fields.entry(topic.clone()).or_insert_with(|| fields(&schema.data));
            file.units.entry(topic.clone()).or_insert_with(|| message.channel.metadata.clone());
            file.messages.entry(topic).or_default().push((message.log_time, message.data.to_vec()));
        }
        (bytes, file)
    }

    /// Name and value of each field of a message of numbers.
    fn numbers(file: &File, topic: &str, mut message: &[u8]) -> Vec<(String, f64)> {
        let mut found = Vec::new();
        while !message.is_empty() {
            let (tag, kind) = prost::encoding::decode_key(&mut message).expect("a key");
            let mut value = 0.0;
            prost::encoding::double::merge(kind, &mut value, &mut message, prost::encoding::DecodeContext::default())
                .expect("a double");
            found.push((file.fields[topic][&tag].clone(), value));
        }
        found
    }

    /// Number and name of each field of a schema's first message.
    fn fields(schema: &[u8]) -> BTreeMap<u32, String> {
        let schema = prost_types::FileDescriptorSet::decode(schema).expect("a schema");
        let fields = &schema.file[0].message_type[0].field;
        fields.iter().map(|field| (field.number().try_into().expect("from 1"), field.name().to_owned())).collect()
    }

    /// Poses [yaw, x, y] of all frames in the world.
    fn poses(message: &[u8]) -> BTreeMap<String, [f64; 3]> {
        let mut poses = BTreeMap::from([("world".to_owned(), [0.0; 3])]);
        for transform in FrameTransforms::decode(message).expect("transforms").transforms {
            let [yaw, x, y] = poses[&transform.parent_frame_id];
            let (translation, rotation) = (transform.translation.expect("one"), transform.rotation.expect("one"));
            assert_eq!((translation.z, rotation.x, rotation.y), (0.0, 0.0, 0.0), "it stays in the plane");
            let (sin, cos) = f64::sin_cos(yaw);
            let turn = 2.0 * rotation.z.atan2(rotation.w);
            let place = [
                yaw + turn,
                x + cos * translation.x - sin * translation.y,
                y + sin * translation.x + cos * translation.y,
            ];
            assert_eq!(poses.insert(transform.child_frame_id, place), None, "each frame has one parent");
        }
        poses
    }

    #[test]
    fn have_every_number_of_the_csv_at_its_time() {
        let scenario = scenario("stabilised_capture");
        let study = run(&scenario);
        let (bytes, file) = record(&scenario, &study, &study.cases[0]);
        assert_eq!(bytes, record(&scenario, &study, &study.cases[0]).0, "the same study, the same bytes");
        let summary = mcap::Summary::read(&bytes).expect("MCAP").expect("a summary");
        let metadata = mcap::read::metadata(&bytes, &summary.metadata_indexes[0]).expect("metadata").metadata;
        for (key, value) in manifest(&scenario).entries() {
            assert_eq!(metadata.get(&key), Some(&value), "{key}");
        }
        assert_survives_a_full_disk(bytes.len(), |to| {
            write_mcap(&scenario, &study, &study.cases[0], &manifest(&scenario), to)
        });
        let (headings, rows) = csv(&scenario, &study, &study.cases[0]);
        let columns = Columns::of(&scenario, &study.cases[0]);
        let topics: BTreeSet<String> = columns.list().iter().map(|column| format!("/{}", column.group)).collect();
        assert_eq!(Vec::from_iter(&topics), ["/energy", "/momentum", "/state", "/targets", "/tips"]);
        for (i, row) in rows.iter().enumerate() {
            let mut found = BTreeMap::new();
            for topic in &topics {
                let (time, message) = &file.messages[topic][i];
                #[allow(clippy::cast_precision_loss, reason = "seconds")]
                let seconds = *time as f64 * 1e-9;
                assert!((seconds - row[0].parse::<f64>().expect("a time")).abs() < 1e-9);
                for (name, value) in numbers(&file, topic, message) {
                    let heading = format!("{name} [{}]", file.units[topic][&name]);
                    assert_eq!(found.insert(heading, value.to_bits()), None, "each is there once");
                }
            }
            let expected: BTreeMap<String, u64> =
                headings.iter().zip(row).skip(2).map(|(heading, cell)| (heading.clone(), bits(cell))).collect();
            assert_eq!(found, expected, "row {i}");
        }
        assert_eq!(file.messages["/tf"].len(), rows.len());
        // what has a time in the message has that at which it is logged
        let nanoseconds = |time: Option<Timestamp>| {
            let time = time.expect("a time");
            u64::from(time.sec()) * 1_000_000_000 + u64::from(time.nsec())
        };
        for (time, message) in &file.messages["/tf"] {
            let transforms = FrameTransforms::decode(&message[..]).expect("transforms").transforms;
            assert!(transforms.into_iter().all(|transform| nanoseconds(transform.timestamp) == *time), "{time}");
        }
        assert!(file.messages["/tf"].iter().any(|(time, _)| time % 1_000_000_000 != 0));
        let impact = numbers(&file, "/impact", &file.messages["/impact"][0].1);
        let exact = &study.cases[0].capture.as_ref().expect("a capture").impact.exact;
        assert!(impact.contains(&("kinetic_energy_after".to_owned(), exact.kinetic_energy_after)), "{impact:?}");
        let [l, px, py] = exact.momentum_jump;
        for (name, value) in [
            ("angular_momentum_jump", l),
            ("linear_momentum_jump_x", px),
            ("linear_momentum_jump_y", py),
            ("kinetic_energy_before", exact.kinetic_energy_before),
        ] {
            assert!(impact.contains(&(name.to_owned(), value)), "{name}: {impact:?}");
        }
        let said: Vec<_> = file.messages["/log"].iter().map(|(_, log)| Log::decode(&log[..]).expect("a log")).collect();
        let said: Vec<_> = said.iter().map(|log| log.message.as_str()).collect();
        assert_eq!(said, ["approach begins", "post_impact begins"]);
        let fx = exact.impulses.iter().flatten().next().expect("an impulse")[1];
        assert!(impact.iter().any(|(name, value)| name.ends_with("_impulse_fx") && value.to_bits() == fx.to_bits()));
    }

    #[test]
    fn have_the_pose_of_every_body() {
        let mut scenario = scenario("raina_shah_2017");
        scenario.cases[1].target_twists = vec![[0.3, 0.02, -0.01], [-0.2, 0.0, 0.03]];
        let mut study = run(&scenario);
        // the same motion with the first joint's zero elsewhere: a mount angle
        scenario.layout.arms[0].mount_angle = 0.5;
        let phases = std::iter::once(&mut study.approach)
            .chain(study.cases.iter_mut().filter_map(|case| Some(&mut case.capture.as_mut()?.post_impact)));
        for sample in phases.flat_map(|phase| &mut phase.samples) {
            sample.state.joint_angles[0] -= 0.5;
        }
        let (_, file) = record(&scenario, &study, &study.cases[1]);
        let captured = study.cases[1].capture.as_ref().expect("a capture");
        let samples: Vec<_> = study.approach.samples.iter().chain(&captured.post_impact.samples).collect();
        assert_eq!(file.messages["/tf"].len(), samples.len());
        let before = study.approach.samples.len();
        let contact_sample = study.approach.end();
        assert_eq!(captured.impact.contacts.len(), 2);
        for (i, (sample, (time, message))) in samples.iter().zip(&file.messages["/tf"]).enumerate() {
            let poses = poses(message);
            for (arm, end_effector) in scenario.layout.arms.iter().zip(&sample.end_effector_poses) {
                let pose = poses[&format!("arms/{}/tip", arm.name)];
                let turns = (pose[0] - end_effector[0]) / std::f64::consts::TAU;
                assert_close("yaw, but for whole turns", &[turns], &[turns.round()], tolerance::TRANSFORMS);
                assert_close("tip", &pose[1..], &end_effector[1..], tolerance::TRANSFORMS);
            }
            for result in &captured.impact.contacts {
                let (target, arm) = (result.contact.target, result.contact.arm);
                let (name, start) = (&scenario.targets[target].name, study.cases[1].targets[target].pose[0]);
                let [yaw, x, y] = poses[&format!("targets/{name}")];
                let (end_effector, end) = (sample.end_effector_poses[arm], contact_sample.end_effector_poses[arm]);
                // the contact point, which rotates with the target
                let ((sin, cos), [rx, ry]) = ((yaw - start).sin_cos(), result.contact.offset);
                if i + 1 >= before {
                    let held = [x + cos * rx - sin * ry, y + sin * rx + cos * ry];
                    assert_close(
                        "the target moves with the end effector",
                        &held,
                        &end_effector[1..],
                        tolerance::TRANSFORMS,
                    );
                    let turns = (yaw - start - (end_effector[0] - end[0])) / std::f64::consts::TAU;
                    assert_close("it turns with it", &[turns], &[turns.round()], tolerance::TRANSFORMS);
                } else {
                    let twist = scenario.cases[1].target_twists[target];
                    let left = contact_sample.time - sample.time;
                    let meets = [x + twist[1] * left + rx, y + twist[2] * left + ry];
                    assert_close(
                        "the contact point reaches the end effector",
                        &meets,
                        &end[1..],
                        tolerance::TRANSFORMS,
                    );
                    let turns = (yaw + twist[0] * left - start) / std::f64::consts::TAU;
                    assert_close("by its spin", &[turns], &[turns.round()], tolerance::TRANSFORMS);
                }
            }
            if i == before {
                assert_eq!((*time, file.messages["/impulses"][0].0), (20_000_000_000, 20_000_000_000));
            }
        }
    }

    #[test]
    fn draw_each_body_in_its_frame() {
        let scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let (_, file) = record(&scenario, &study, &study.cases[0]);
        let mut frames: Vec<String> = poses(&file.messages["/tf"][0].1).into_keys().collect();
        frames.retain(|frame| frame != "world" && !frame.ends_with("/tip"));
        let scene = SceneUpdate::decode(&file.messages["/scene"][0].1[..]).expect("a scene");
        let mut drawn: Vec<_> = scene.entities.iter().map(|entity| entity.frame_id.clone()).collect();
        drawn.sort();
        assert_eq!(drawn, frames);
        let mut discs = 0;
        for entity in &scene.entities {
            let shapes = [entity.cubes.len(), entity.cylinders.len(), entity.triangles.len()];
            assert_eq!(shapes.iter().sum::<usize>(), 1, "{}", entity.id);
            assert!(entity.frame_locked);
            let cloud = &file.messages[&format!("/outlines/{}", entity.frame_id)][0].1[..];
            let cloud = PointCloud::decode(cloud).expect("points");
            assert_eq!(cloud.frame_id, entity.frame_id);
            let points: Vec<[f32; 3]> = cloud
                .data
                .chunks(cloud.point_stride as usize)
                .map(|point| [0, 4, 8].map(|at| f32::from_le_bytes(point[at..at + 4].try_into().expect("four bytes"))))
                .collect();
            let reach = points.iter().fold(0.0_f32, |most, [x, y, _]| most.max(x.hypot(*y)));
            // the circle about the frame's origin through the farthest corner, or within the sum of the sides
            let corners = entity.triangles.iter().flat_map(|prism| &prism.points).map(|p| p.x.hypot(p.y));
            let farthest = corners.fold(0.0, f64::max);
            let [cube, cylinder] =
                [entity.cubes.first().and_then(|cube| cube.size), entity.cylinders.first().and_then(|c| c.size)];
            let [low, high] = match (cube, cylinder) {
                (Some(size), _) => [size.x / 2.0, size.x + size.y],
                (_, Some(size)) => {
                    // diameters
                    assert!(size.x > 0.0 && size.x.to_bits() == size.y.to_bits(), "{}", entity.id);
                    discs += 1;
                    [0.999 * size.x / 2.0, 1.001 * size.x / 2.0]
                }
                _ => [0.9 * farthest, 1.001 * farthest],
            };
            assert!((low..high).contains(&f64::from(reach)), "{}: {reach}", entity.id);
            assert!(points.iter().all(|[_, _, z]| *z == 0.0));
            // every part of the outline is near a point
            let outline = &entity.lines[0];
            let thickness = 2.0 * outline.pose.expect("a pose").position.expect("one").z;
            for (from, to) in outline.points.iter().zip(&outline.points[1..]) {
                for part in [0.25, 0.5, 0.75, 0.9] {
                    let [x, y] = [from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)];
                    let distance = |p: &[f32; 3]| (f64::from(p[0]) - x).hypot(f64::from(p[1]) - y);
                    let nearest = points.iter().map(distance).fold(f64::MAX, f64::min);
                    assert!(nearest < 0.25 * thickness, "{}: {nearest} m from ({x}, {y})", entity.id);
                }
            }
        }
        assert!(discs >= 2, "both targets are discs");
        let impulses = SceneUpdate::decode(&file.messages["/impulses"][0].1[..]).expect("a scene");
        assert_eq!(impulses.entities.len(), 2);
        // as long as the impulses are large, the longest a quarter of the longest arm
        let magnitudes = study.cases[0].capture.as_ref().expect("a capture").impact.exact.impulse_magnitudes();
        let magnitudes: Vec<f64> = magnitudes.into_iter().flatten().collect();
        let largest = magnitudes.iter().copied().fold(0.0, f64::max);
        assert!(magnitudes.iter().any(|magnitude| *magnitude < 0.95 * largest), "{magnitudes:?}");
        for (entity, magnitude) in impulses.entities.iter().zip(&magnitudes) {
            let arrow = &entity.arrows[0];
            let expected = 0.25 * 3.0 * magnitude / largest;
            assert_close("length", &[arrow.shaft_length + arrow.head_length], &[expected], tolerance::TRANSFORMS);
            assert_eq!(entity.texts[0].text, format!("{magnitude:.3e} N s"));
        }
        for (entity, impulse) in
            impulses.entities.iter().zip(&study.cases[0].capture.as_ref().expect("a capture").impact.exact.impulses)
        {
            let [_, fx, fy] = impulse.expect("both arms capture");
            let turn = entity.arrows[0].pose.expect("a pose").orientation.expect("a turn");
            let yaw = 2.0 * turn.z.atan2(turn.w);
            assert_close(
                "the arrow",
                &[yaw.cos(), yaw.sin()],
                &[fx / fx.hypot(fy), fy / fx.hypot(fy)],
                tolerance::TRANSFORMS,
            );
        }
    }

    /// Repeated bounces, in which not every arm takes part.
    #[test]
    fn have_every_impact() {
        let scenario = scenario("raina_shah_2017");
        let mut study = run(&scenario);
        let captured = study.cases[0].capture.as_mut().expect("a capture");
        let mut second = captured.impact.clone();
        second.exact.impulses[0] = None;
        captured.later_impacts.push(LaterImpact { time: 10.0, impact: second });
        let captured = study.cases[0].capture.as_ref().expect("a capture");
        let (_, file) = record(&scenario, &study, &study.cases[0]);
        let times = |topic: &str| file.messages[topic].iter().map(|(time, _)| *time).collect::<Vec<_>>();
        assert_eq!(times("/impact"), [20_000_000_000, 30_000_000_000]);
        assert_eq!(times("/impulses"), times("/impact"));
        let sample = captured.post_impact.samples.iter().find(|sample| sample.time >= 10.0).expect("it goes on");
        for (message, arms, end_effectors) in [
            (0, &["arm1", "arm2"][..], &captured.post_impact.samples[0].end_effector_poses),
            (1, &["arm2"], &sample.end_effector_poses),
        ] {
            let scene = SceneUpdate::decode(&file.messages["/impulses"][message].1[..]).expect("a scene");
            assert_eq!(scene.entities.iter().map(|entity| entity.id.as_str()).collect::<Vec<_>>(), arms);
            let place = scene.entities.last().expect("an arrow").arrows[0].pose.expect("a pose").position.expect("one");
            assert_eq!([place.x, place.y], end_effectors[1][1..], "it starts at the end effector");
            let numbers: BTreeMap<_, _> =
                numbers(&file, "/impact", &file.messages["/impact"][message].1).into_iter().collect();
            let [n, fx, fy] = captured.impact.exact.impulses[0].filter(|_| message == 0).unwrap_or_default();
            for (part, value) in [("n", n), ("fx", fx), ("fy", fy)] {
                assert_eq!(numbers[&format!("arm1_impulse_{part}")].to_bits(), value.to_bits());
            }
        }
    }

    #[test]
    fn draw_polygons_by_their_edges() {
        let mut scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        // not convex
        let corners = vec![[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.0, -0.5], [0.0, 0.0], [0.5, 0.0]];
        scenario.targets[0].outline = Outline::polygon(corners.clone()).expect("a polygon");
        let (_, file) = record(&scenario, &study, &study.cases[0]);
        let scene = SceneUpdate::decode(&file.messages["/scene"][0].1[..]).expect("a scene");
        let entity = scene.entities.iter().find(|entity| entity.id == "targets/target1").expect("the target");
        let edge: Vec<[f64; 2]> = entity.lines[0].points.iter().map(|point| [point.x, point.y]).collect();
        assert_eq!(edge[..6], corners, "anticlockwise already");
        assert_eq!(edge[6], corners[0], "closed");
        let walls = &entity.triangles[0].points;
        assert_eq!(walls.len(), 6 * corners.len());
        for (wall, (from, to)) in walls.chunks(6).zip(edge.iter().zip(&edge[1..])) {
            for end in [from, to] {
                let there: Vec<f64> = wall.iter().filter(|p| [p.x, p.y] == *end).map(|point| point.z).collect();
                assert_eq!(there.len(), 3);
                assert!(there.contains(&there[0].abs()) && there.contains(&-there[0].abs()), "from face to face");
            }
        }
    }

    #[test]
    fn of_an_approach_alone_have_no_impact() {
        let scenario = scenario("redysim_single_arm_3r");
        let study = run(&scenario);
        let (_, file) = record(&scenario, &study, &study.cases[0]);
        assert_eq!(file.messages["/log"].len(), 1);
        assert!(!file.messages.contains_key("/impact") && !file.messages.contains_key("/impulses"));
        assert_eq!(file.messages["/tf"].len(), study.approach.samples.len());
    }
}
