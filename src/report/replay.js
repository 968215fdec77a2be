"use strict";
// The study's motion at any time, and its picture. Time runs from the start of the approach.

const study = JSON.parse(document.getElementById("data").textContent);
// Okabe and Ito's colours, which colour-blind readers tell apart
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5c00", "#444444"];
const element = (id) => document.getElementById(id);
const rotate = ([x, y], angle) => {
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  return [c * x - s * y, s * x + c * y];
};
const plus = ([a, b], [c, d]) => [a + c, b + d];

/** One case on one axis of time: columns of both phases put end to end. */
function timeline(one) {
  const approach = one.approach || study.approach;
  const phases = [approach, ...(one.post_impact ? [one.post_impact] : [])];
  const join = (key) => {
    const merge = (parts) =>
      Array.isArray(parts[0][0]) ? parts[0].map((_, i) => merge(parts.map((part) => part[i]))) : parts.flat();
    return merge(phases.map((phase) => phase[key]));
  };
  const starts = [0, approach.duration];
  const time = phases.flatMap((phase, i) => phase.time.map((t) => t + starts[i]));
  const columns = { time };
  for (const key of ["base_pose", "base_twist", "joint_angles", "joint_rates", "joint_torques", "tips",
    "linear_momentum", "angular_momentum", "kinetic_energy"]) columns[key] = join(key);
  columns.contact = approach.duration;
  columns.impact = one.post_impact ? approach.duration : Infinity;
  columns.end = phases.reduce((sum, phase) => sum + phase.duration, 0);
  columns.before = approach.time.length;
  return columns;
}

/** Index of the last sample at or before a time; after the impact from the impact on. */
function place(line, time) {
  let [low, high] = [0, line.time.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (line.time[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

/** A column's value between its samples, the first of which is the line's number `first`. */
function between(line, column, time, first = 0) {
  const i = place(line, time), j = Math.min(i + 1, line.time.length - 1);
  const span = line.time[j] - line.time[i];
  const part = span > 0 ? Math.min((time - line.time[i]) / span, 1) : 0;
  return column[i - first] + part * (column[j - first] - column[i - first]);
}

/** Where every body is. */
function configuration(line, time) {
  const at = (column) => between(line, column, time);
  const [yaw, x, y] = line.base_pose.map(at);
  let joint = 0;
  const arms = study.layout.arms.map((arm) => {
    let angle = yaw + arm.mount_angle, point = plus([x, y], rotate(arm.mount, yaw));
    const points = [point], angles = [];
    for (const link of arm.links) {
      angle += at(line.joint_angles[joint++]);
      angles.push(angle);
      point = plus(point, rotate([link.length, 0], angle));
      points.push(point);
    }
    return { points, angles };
  });
  return { yaw, base: [x, y], arms };
}

/** Pose of each target's COM: it flies freely until it is touched, then as it was computed. */
function targetPoses(one, line, time) {
  return one.targets.map(({ pose: [yaw, x, y], twist: [omega, vx, vy] }, i) => {
    if (one.impact && time >= one.impact.time) {
      const since = line.before, columns = one.post_impact.targets[i];
      const at = (column) => between(line, column, time, since);
      const [angle, px, py] = columns.map(at);
      return { angle, point: [px, py] };
    }
    const ago = time - line.contact;
    return { angle: yaw + omega * ago, point: [x + vx * ago, y + vy * ago] };
  });
}

const state = { chosen: 0, time: 0, playing: false, lines: study.cases.map(timeline), listeners: [] };
const current = () => [study.cases[state.chosen], state.lines[state.chosen]];

/** Half the sides of the base: it reaches to its mounts, and is a body of its mass and inertia else. */
const base = (() => {
  const gyration = Math.sqrt(study.layout.base.inertia / study.layout.base.mass);
  const half = gyration * Math.sqrt(1.5);
  const reach = (i) => Math.max(...study.layout.arms.map((arm) => Math.abs(arm.mount[i])));
  return [Math.max(reach(0), half), Math.max(reach(1), half)];
})();

/** The part of the plane that everything stays in. */
function bounds(one, line) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = ([x, y], r) => {
    box[0] = Math.min(box[0], x - r); box[1] = Math.min(box[1], y - r);
    box[2] = Math.max(box[2], x + r); box[3] = Math.max(box[3], y + r);
  };
  const steps = 120;
  for (let i = 0; i <= steps; i++) {
    const time = line.end * i / steps, now = configuration(line, time);
    add(now.base, Math.hypot(...base));
    now.arms.forEach((arm) => arm.points.forEach((point) => add(point, 0.05)));
    // a target far away before its capture does not shrink the robot to a dot
    if (time >= line.impact - 2) targetPoses(one, line, time).forEach((pose, k) => pose && add(pose.point, study.targets[k].radius));
  }
  return box;
}

const canvas = element("scene"), pen = canvas.getContext("2d");
const boxes = study.cases.map((one, i) => bounds(one, state.lines[i]));

function draw() {
  const [one, line] = current(), now = configuration(line, state.time);
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  const box = boxes[state.chosen];
  const scale = 0.92 * Math.min(width / (box[2] - box[0]), height / (box[3] - box[1]));
  const centre = element("follow").checked ? now.base : [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
  const screen = ([x, y]) => [width / 2 + scale * (x - centre[0]), height / 2 - scale * (y - centre[1])];

  grid(screen, scale, centre, width, height);
  if (element("traces").checked) traces(line, screen);
  targetPoses(one, line, state.time).forEach((pose, i) => pose && drawTarget(study.targets[i], pose, screen, scale, i));
  drawBase(now, screen, scale);
  now.arms.forEach((arm, i) => drawArm(study.layout.arms[i], arm, COLOURS[i % COLOURS.length], screen, scale));
  if (one.impact) impulses(one, line, now, screen, scale);
}

function grid(screen, scale, centre, width, height) {
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find((s) => s * scale > 55) || 100;
  pen.strokeStyle = "#e6ebf0"; pen.lineWidth = 1; pen.fillStyle = "#8a98a6"; pen.font = "11px system-ui, sans-serif";
  const [left, right] = [centre[0] - width / 2 / scale, centre[0] + width / 2 / scale];
  const [low, high] = [centre[1] - height / 2 / scale, centre[1] + height / 2 / scale];
  const digits = step < 1 ? 1 : 0;
  for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
    const [sx] = screen([x, 0]);
    stroke([[sx, 0], [sx, height]]);
    pen.fillText(x.toFixed(digits), sx + 3, height - 5);
  }
  for (let y = Math.ceil(low / step) * step; y <= high; y += step) {
    const [, sy] = screen([0, y]);
    stroke([[0, sy], [width, sy]]);
    if (sy < height - 18) pen.fillText(`${y.toFixed(digits)} m`, 4, sy - 3);
  }
}

function stroke(points) {
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

function circle([x, y], radius, fill, edge) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (edge) { pen.strokeStyle = edge; pen.stroke(); }
}

function traces(line, screen) {
  const until = place(line, state.time);
  line.tips.forEach(([, xs, ys], i) => {
    pen.strokeStyle = COLOURS[i % COLOURS.length]; pen.globalAlpha = 0.35; pen.lineWidth = 1.5;
    stroke(xs.slice(0, until + 1).map((x, k) => screen([x, ys[k]])));
    pen.globalAlpha = 1;
  });
}

function drawBase(now, screen, scale) {
  const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => screen(plus(now.base, rotate([a * base[0], b * base[1]], now.yaw))));
  pen.beginPath();
  corners.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.closePath();
  pen.fillStyle = "#dfe6ed"; pen.fill();
  pen.strokeStyle = "#44525f"; pen.lineWidth = 1.5; pen.stroke();
  const nose = screen(plus(now.base, rotate([base[0] * 0.7, 0], now.yaw))), middle = screen(now.base);
  stroke([middle, nose]);
  circle(middle, 3.5, "#44525f");
}

function drawArm(arm, now, colour, screen, scale) {
  const thick = Math.max(3, Math.min(9, 0.06 * scale));
  pen.lineCap = "round"; pen.lineJoin = "round";
  pen.strokeStyle = colour; pen.lineWidth = thick;
  stroke(now.points.map(screen));
  pen.lineWidth = 1.5;
  arm.links.forEach((link, k) => {
    const joint = screen(now.points[k]);
    if (link.length === 0) { // a wheel, as large as its inertia makes it
      const radius = Math.max(6, scale * Math.sqrt(2 * link.inertia / link.mass));
      circle(joint, radius, null, colour);
      const spoke = [Math.cos(now.angles[k]) * radius, -Math.sin(now.angles[k]) * radius];
      stroke([plus(joint, spoke), joint]);
    }
    circle(joint, thick * 0.62, "#ffffff", colour);
  });
  circle(screen(now.points[now.points.length - 1]), thick * 0.62, colour);
}

function drawTarget(target, pose, screen, scale, i) {
  const middle = screen(pose.point);
  pen.lineWidth = 1.5;
  if (target.polygon) {
    pen.beginPath();
    for (const corner of target.polygon) pen.lineTo(...screen(plus(pose.point, rotate(corner, pose.angle))));
    pen.closePath();
    pen.fillStyle = "rgba(120,120,120,0.18)"; pen.fill();
    pen.strokeStyle = "#6d6d6d"; pen.stroke();
    circle(middle, 3, "#6d6d6d");
  } else {
    circle(middle, Math.max(3, target.radius * scale), "rgba(120,120,120,0.18)", "#6d6d6d");
  }
  for (const quarter of target.polygon ? [] : [0, 1]) {
    const arm = rotate([target.radius, 0], pose.angle + quarter * Math.PI / 2);
    pen.strokeStyle = quarter ? "#c2c2c2" : "#6d6d6d";
    stroke([screen(plus(pose.point, [-arm[0], -arm[1]])), screen(plus(pose.point, arm))]);
  }
  pen.fillStyle = "#4a4a4a"; pen.font = "12px system-ui, sans-serif";
  pen.fillText(target.name, middle[0] + 6, middle[1] - 6);
}

/** For four seconds after the impact: the impulse on the robot at each contact. */
function impulses(one, line, now, screen, scale) {
  const since = state.time - one.impact.time;
  if (since < 0 || since > 4) return;
  const forces = one.impact.exact.impulses;
  const largest = Math.max(...forces.map((f) => (f ? Math.hypot(f[1], f[2]) : 0)), 1e-12);
  pen.globalAlpha = Math.min(1, 4 - since);
  forces.forEach((force, arm) => {
    if (!force) return;
    const from = screen(one.impact.tips[arm].slice(1));
    const size = Math.hypot(force[1], force[2]), length = 20 + 60 * size / largest;
    const way = [force[1] / (size || 1) * length, -force[2] / (size || 1) * length];
    const to = plus(from, way);
    pen.strokeStyle = pen.fillStyle = "#b3261e"; pen.lineWidth = 3;
    stroke([from, to]);
    const angle = Math.atan2(way[1], way[0]);
    pen.beginPath();
    for (const turn of [0, 2.6, -2.6]) pen.lineTo(to[0] + 9 * Math.cos(angle + turn), to[1] + 9 * Math.sin(angle + turn));
    pen.fill();
    pen.font = "12px system-ui, sans-serif";
    pen.fillText(`${size.toPrecision(3)} N s`, to[0] + 8, to[1]);
  });
  pen.globalAlpha = 1;
}

function setTime(time) {
  const [, line] = current();
  state.time = Math.min(Math.max(time, 0), line.end);
  element("scrub").max = line.end;
  element("scrub").value = state.time;
  const phase = state.time < line.impact ? "approach" : "after the impact";
  element("clock").textContent = `${state.time.toFixed(2)} s of ${line.end.toFixed(0)} s, ${phase}`;
  draw();
  state.listeners.forEach((tell) => tell());
}

function setPlaying(playing) {
  const [, line] = current();
  if (playing && state.time >= line.end) setTime(0);
  state.playing = playing;
  element("play").textContent = playing ? "❚❚ pause" : "▶ play";
  element("play").setAttribute("aria-pressed", String(playing));
  if (playing) requestAnimationFrame((now) => step(now, now));
}

function step(last, now) {
  if (!state.playing) return;
  setTime(state.time + (now - last) / 1000 * Number(element("speed").value));
  if (state.time >= current()[1].end) setPlaying(false);
  else requestAnimationFrame((next) => step(now, next));
}
