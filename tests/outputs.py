"""Parquet and MCAP, read by pyarrow and mcap: every value, unit and transform against the CSV.

    python tests/outputs.py [--binary planar-capture] [--keep FOLDER]

needs tests/reference/requirements-reference.txt, and a binary with the features parquet and mcap.
"""

import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import pyarrow.parquet
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

ROOT = Path(__file__).resolve().parent.parent
SCENARIOS = ("raina_shah_2017", "stabilised_capture", "redysim_single_arm_3r")
# End effectors by the chain of transforms, m and rad: rounding of four turns, 2e-15 measured.
BOUND = 1e-13


def read_csv(path):
    """Headings and rows; all cells but the phase are numbers."""
    with path.open(newline="", encoding="utf-8") as file:
        headings, *rows = csv.reader(file)
    return headings, [
        [cell if name == "phase" else float(cell) for name, cell in zip(headings, row, strict=True)] for row in rows
    ]


def unit_of(heading):
    """`base_yaw [rad]`: its unit, `None` for the phase."""
    return heading.split(" [")[1].rstrip("]") if " [" in heading else None


def check_parquet(path, headings, rows, origin):
    """The CSV's columns, names, units and values, exactly, and the name of the scenario."""
    table = pyarrow.parquet.read_table(path)
    assert table.column_names == headings
    columns = list(zip(*rows, strict=True))
    for field, column, wanted in zip(table.schema, table.columns, columns, strict=True):
        if field.name == "phase":
            assert pyarrow.types.is_dictionary(field.type), field
        else:
            assert field.type == pyarrow.float64() and not field.nullable, field
            assert field.metadata == {b"unit": unit_of(field.name).encode()}, field
        assert tuple(column.to_pylist()) == wanted, f"{path}: {field.name}"
    file = pyarrow.parquet.ParquetFile(path).metadata
    said = {key.decode(): value.decode() for key, value in file.metadata.items() if key != b"ARROW:schema"}
    assert said == origin, said
    compressions = {file.row_group(0).column(i).compression for i in range(file.num_columns)}
    assert compressions == {"ZSTD"}, compressions


def read_mcap(path):
    """Messages of each topic as (log time in ns, message), with schema and units; metadata of the file."""
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        summary = reader.get_summary()
        messages = {channel.topic: [] for channel in summary.channels.values()}
        units = {channel.topic: channel.metadata for channel in summary.channels.values()}
        last = 0
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            assert schema.encoding == channel.message_encoding == "protobuf"
            assert message.log_time >= last, "messages in the order of time"
            last = message.log_time
            messages[channel.topic].append((message.log_time, decoded))
        counts = {summary.channels[i].topic: count for i, count in summary.statistics.channel_message_counts.items()}
        assert counts == {topic: len(found) for topic, found in messages.items()}
        schemas = {channel.topic: summary.schemas[channel.schema_id].name for channel in summary.channels.values()}
        (metadata,) = reader.iter_metadata()
    return messages, schemas, units, metadata.metadata


def in_world(transforms):
    """Pose [yaw, x, y] of each frame in the world."""
    poses = {"world": (0.0, 0.0, 0.0)}
    for one in transforms:
        yaw, x, y = poses[one.parent_frame_id]
        turn = 2.0 * math.atan2(one.rotation.z, one.rotation.w)
        dx, dy = one.translation.x, one.translation.y
        poses[one.child_frame_id] = (
            yaw + turn,
            x + math.cos(yaw) * dx - math.sin(yaw) * dy,
            y + math.sin(yaw) * dx + math.cos(yaw) * dy,
        )
    return poses


def check_mcap(path, headings, rows, summary, origin):
    """The CSV's numbers at the CSV's times; returns the error of the end effectors."""
    messages, schemas, units, metadata = read_mcap(path)
    assert metadata == origin, metadata
    known = {"/tf": "FrameTransforms", "/scene": "SceneUpdate", "/log": "Log", "/impulses": "SceneUpdate"}
    for topic, schema in schemas.items():
        if topic.startswith("/outlines/"):
            assert schema == "foxglove.PointCloud"
        elif topic in known:
            assert schema == f"foxglove.{known[topic]}"
        else:
            assert schema == f"planar_capture.{topic[1:].title()}"
    series = [topic for topic, schema in schemas.items() if schema.startswith("planar_capture.") and topic != "/impact"]
    assert {"/state", "/tips", "/momentum", "/energy"} <= set(series)
    times = [round(row[0] * 1e9) for row in rows]
    for topic in ("/tf", *series):
        assert [time for time, _ in messages[topic]] == times, topic

    fields = {}
    for topic in series:
        names = [field.name for field in messages[topic][0][1].DESCRIPTOR.fields]
        fields |= {f"{name} [{units[topic][name]}]": (topic, name) for name in names}
    assert sorted(fields) == sorted(heading for heading in headings if heading not in ("time [s]", "phase"))
    for heading, (topic, name) in fields.items():
        place = headings.index(heading)
        found = [getattr(message, name) for _, message in messages[topic]]
        assert found == [row[place] for row in rows], f"{path}: {heading}"

    impact = summary.get("impact")
    starts = [0] + [times[i] for i in range(1, len(rows)) if rows[i][1] != rows[i - 1][1]]
    assert [time for time, _ in messages["/log"]] == starts
    if impact:
        time, message = messages["/impact"][0]
        assert [time] == starts[1:]
        assert message.kinetic_energy_after == impact["exact"]["kinetic_energy_after"]
        impulses = [value for impulse in impact["exact"]["impulses"] for value in impulse or (0.0, 0.0, 0.0)]
        assert [getattr(message, f.name) for f in message.DESCRIPTOR.fields if "_impulse_" in f.name] == impulses
    return max(strays(messages["/tf"], headings, rows), default=0.0)


def strays(transforms, headings, rows):
    """Largest error of the end effectors against the CSV, m and rad."""
    for (_, message), row in zip(transforms, rows, strict=True):
        for frame, (yaw, x, y) in in_world(message.transforms).items():
            if frame.endswith("/tip"):
                arm = frame.split("/")[1]
                value = [row[headings.index(f"{arm}_tip_{part}")] for part in ("yaw [rad]", "x [m]", "y [m]")]
                turn = math.remainder(yaw - value[0], math.tau)
                yield from (abs(turn), abs(x - value[1]), abs(y - value[2]))


def main():
    """Exit code 1 with the differences."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, default=ROOT / "target" / "debug" / "planar-capture")
    parser.add_argument("--keep", type=Path, help="where the files stay")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for scenario in SCENARIOS:
            out = (options.keep or Path(folder)) / scenario
            run = [options.binary, "run", ROOT / "scenarios" / f"{scenario}.toml", "--out", out, "--parquet", "--mcap"]
            subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
            summary = json.loads((out / "summary.json").read_text())
            version = subprocess.run([options.binary, "--version"], check=True, capture_output=True, text=True).stdout
            for case in summary["cases"]:
                headings, rows = read_csv(out / f"{case['name']}.csv")
                origin = {
                    "scenario": scenario,
                    "layout": summary["layout"]["name"],
                    "layout_sha256": summary["layout"]["sha256"],
                    "case": case["name"],
                    "planar_capture_version": version.split()[1],
                }
                # the manifest of the run; what is no text is JSON
                for key, value in summary["run"].items():
                    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False)
                    origin[key] = value if isinstance(value, str) else text
                check_parquet(out / f"{case['name']}.parquet", headings, rows, origin)
                stray = check_mcap(out / f"{case['name']}.mcap", headings, rows, case, origin)
                assert stray <= BOUND, f"{scenario}, {case['name']}: a tip is {stray:.1e} off"
                print(
                    f"{scenario}, {case['name']}: {len(rows)} rows of {len(headings)} columns, tips within {stray:.1e}",
                    file=sys.stderr,
                )


if __name__ == "__main__":
    main()
