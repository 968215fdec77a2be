"use strict";
// The motion of a study at any time since the start of the approach.

const study = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const rotate = ([x, y], angle) => {
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  return [c * x - s * y, s * x + c * y];
};
const plus = ([a, b], [c, d]) => [a + c, b + d];
/** Magnitude of the force part of [n, fx, fy]. */
const force = ([, fx, fy]) => Math.hypot(fx, fy);
// The cases of a part share a robot, targets and what computed them. The parts differ in numbers alone: names and counts
// of arms, links and targets are the same in all.
const { arms } = study.parts[0].layout;
const armName = (index) => arms[index].name;
const targetName = (index) => study.parts[0].targets[index].name;
/** What the cases of its part share. */
const partOf = (one) => study.parts[one.part];
const layoutOf = (one) => partOf(one).layout;
/** Its own, or that of its part. */
const approachOf = (one) => one.approach || partOf(one).approach;
/** A target as a body; `one.targets[index]` is its motion. */
const bodyOf = (one, index) => partOf(one).targets[index];

/** One case on one axis of time: the concatenated columns of both phases. */
function timeline(one) {
  const approach = approachOf(one);
  const phases = [approach, ...(one.post_impact ? [one.post_impact] : [])];
  const join = (key) => {
    const merge = (parts) =>
      Array.isArray(parts[0][0]) ? parts[0].map((_, i) => merge(parts.map((part) => part[i]))) : parts.flat();
    return merge(phases.map((phase) => phase[key]));
  };
  const starts = [0, approach.duration];
  const time = phases.flatMap((phase, i) => phase.time.map((t) => t + starts[i]));
  const columns = { time, layout: layoutOf(one) };
  for (const key of ["base_pose", "base_twist", "joint_angles", "joint_rates", "joint_torques", "end_effectors",
    "linear_momentum", "angular_momentum", "kinetic_energy"]) columns[key] = join(key);
  const done = approach.work[approach.work.length - 1] || 0;
  columns.work = phases.flatMap((phase, i) => phase.work.map((work) => work + (i ? done : 0)));
  columns.contact = approach.duration;
  columns.end = phases.reduce((sum, phase) => sum + phase.duration, 0);
  columns.before = approach.time.length;
  columns.after = one.post_impact ? approach.duration : Infinity;
  columns.impacts = one.impacts.map((impact) => ({ ...impact, time: time[columns.before + impact.sample] }));
  // the contacts that hold, each with its start
  columns.holds = columns.impacts.flatMap(({ time, contacts }) =>
    contacts.filter(({ holds }) => holds).map(({ arm, target, kind }) => ({ time, arm, target, kind })));
  return columns;
}

/** Index of the last sample at or before a time; at an impact, of the sample after it. */
function place(line, time) {
  let [low, high] = [0, line.time.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (line.time[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

/** The interpolated value of a column whose first sample is that of index `first` of the line. */
function between(line, column, time, first = 0) {
  const i = place(line, time), j = Math.min(i + 1, line.time.length - 1);
  const span = line.time[j] - line.time[i];
  const part = span > 0 ? Math.min((time - line.time[i]) / span, 1) : 0;
  return column[i - first] + part * (column[j - first] - column[i - first]);
}

/** Poses of the bodies of the robot, composed along the tree of frames. */
function configuration(line, time) {
  const at = (column) => between(line, column, time);
  const [yaw, x, y] = line.base_pose.map(at);
  const poses = [];
  for (const { parent, pose: [angle, px, py], joint } of line.layout.frames) {
    const from = poses[parent];
    poses.push(from === undefined ? { angle: yaw, point: [x, y] } : {
      angle: from.angle + angle + (joint === null ? 0 : at(line.joint_angles[joint])),
      point: plus(from.point, rotate([px, py], from.angle)),
    });
  }
  const placed = arms.map((_, arm) => {
    const own = poses.filter((_, i) => line.layout.frames[i].arm === arm);
    return { points: own.map(({ point }) => point), angles: own.map(({ angle }) => angle), end_effector: own[own.length - 1].point };
  });
  return { yaw, base: [x, y], arms: placed };
}

/** Pose of each target's COM: free motion until the first impact, then the samples. */
function targetPoses(one, line, time) {
  return one.targets.map(({ pose: [yaw, x, y], twist: [omega, vx, vy] }, i) => {
    if (time >= line.after) {
      const [angle, px, py] = one.post_impact.targets[i].map((column) => between(line, column, time, line.before));
      return { angle, point: [px, py] };
    }
    const ago = time - line.contact;
    return { angle: yaw + omega * ago, point: [x + vx * ago, y + vy * ago] };
  });
}

/** Twist of each target's COM at each of the line's samples. */
function targetTwists(one, line) {
  return one.targets.map(({ twist }, i) => twist.map((value, part) =>
    line.time.map((_, k) => (k < line.before ? value : one.post_impact.target_twists[i][part][k - line.before]))));
}

/** The name of the phase at a time. */
function phaseName(line, time) {
  const passed = line.impacts.filter((impact) => impact.time <= time).length;
  if (passed === 0) return time < line.after ? "approach" : "after the approach";
  return line.impacts.length === 1 ? "after the impact" : `after impact ${passed} of ${line.impacts.length}`;
}

const state = { chosen: 0, beside: null, time: 0, playing: false, lines: study.cases.map(timeline), listeners: [] };
const current = () => [study.cases[state.chosen], state.lines[state.chosen]];
