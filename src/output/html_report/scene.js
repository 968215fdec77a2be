// Draws robot and targets of a case at one time.

/** Draws the chosen case, and beside it the second one. */
function draw() {
  const ratio = window.devicePixelRatio || 1;
  for (const [place, chosen] of [[canvas, state.chosen], [element("scene-beside"), state.beside]]) {
    if (chosen === null) continue;
    const width = place.clientWidth, height = place.clientHeight;
    if (place.width !== Math.round(width * ratio) || place.height !== Math.round(height * ratio)) {
      place.width = Math.round(width * ratio);
      place.height = Math.round(height * ratio);
    }
    pen = place.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const shown = drawScene(chosen, width, height);
    pen = screenPen;
    // positions in pixels, for tests
    if (place === canvas) state.shown = shown;
  }
}

/** Draws a case at the current time; returns what it shows. */
function drawScene(chosen, width, height) {
  const one = study.cases[chosen], line = state.lines[chosen], time = Math.min(state.time, line.end), now = configuration(line, time);
  const [box, view] = viewOf();
  const fitting = (across, down) => 0.92 * Math.min(across / (box[2] - box[0]), down / (box[3] - box[1]));
  const [left, low, right, high] = view === "follow" ? [0, 0, 0, 0] : beyondBox(box, 0.8 * fitting(width, height));
  const scale = fitting(width - left - right, height - low - high);
  const middle = [(box[0] + box[2]) / 2 + (right - left) / 2 / scale, (box[1] + box[3]) / 2 + (high - low) / 2 / scale];
  const centre = plus(middle, view === "follow" ? now.base : [0, 0]);
  const screen = ([x, y]) => [width / 2 + scale * (x - centre[0]), height / 2 - scale * (y - centre[1])];
  const held = line.holds.filter((hold) => hold.time <= time);
  const poses = targetPoses(one, line, time);
  const overlapping = new Set(overlapsAt(one, line, time).flatMap(({ bodies }) => bodies));
  const on = (id) => element(id)?.checked;

  // as any other picture, whatever was drawn before
  Object.assign(pen, { lineCap: "round", lineJoin: "round", globalAlpha: 1 });
  grid(screen, scale, centre, width, height);
  if (on("traces")) traces(line, screen);
  poses.forEach((pose, i) => {
    drawTarget(bodyOf(one, i), pose, screen, scale, overlapping, targetColour(i));
    // lines to all holding contacts show closed loops
    pen.strokeStyle = targetColour(i); pen.lineWidth = 2;
    held.filter((hold) => hold.target === i).forEach((hold) => stroke([pose.point, now.arms[hold.arm].end_effector].map(screen)));
  });
  drawBase(line.layout, now, screen, overlapping);
  now.arms.forEach((arm, i) => drawArm(line.layout.arms[i], arm, armColour(i), screen, scale, overlapping));
  held.forEach((hold) => drawAttachment(hold, screen(now.arms[hold.arm].end_effector), scale));
  const notes = new Notes(width, height);
  line.impacts.forEach((impact) => drawImpact(impact, screen, notes));
  const moving = on("velocities") ? drawVelocities(chosen, now, poses, screen, notes) : null;
  const torques = on("forces") ? drawTorques(chosen, now, screen, scale) : null;
  poses.forEach((pose, i) => nameTarget(bodyOf(one, i), pose, now, screen, scale, width, height, targetColour(i), notes));
  const texts = notes.write();
  const arrows = line.impacts.filter(isFresh).flatMap((impact) => impact.contacts);
  return { targets: poses, arms: now.arms, overlapping: [...overlapping], arrows, moving, torques, texts, lines: notes.arrows };
}

function traces(line, screen) {
  const until = place(line, state.time);
  line.end_effectors.forEach(([, xs, ys], i) => {
    pen.strokeStyle = armColour(i); pen.globalAlpha = 0.35; pen.lineWidth = 1.5;
    stroke(xs.slice(0, until + 1).map((x, k) => screen([x, ys[k]])));
    pen.globalAlpha = 1;
  });
}

/** The overlaps of a case that last at a time; one that a contact ends, which is known to 1e-9 s, is over then. */
const overlapsAt = (one, line, time) => one.overlaps.filter(({ from, to }) => from <= time && (time < to - 1e-8 || to > line.end - 1e-8));

function drawBase(layout, now, screen, overlapping) {
  const base = halfBase(layout), box = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => [a * base[0], b * base[1]]);
  const corners = (layout.base.outline || box).map((corner) => plus(now.base, rotate(corner, now.yaw)));
  const inside = overlapping.has("base");
  pen.lineWidth = inside ? 3 : 1.5;
  area(corners.map(screen), theme.body, inside ? theme.overlap : theme.edge);
  pen.lineWidth = 1.5; pen.strokeStyle = theme.edge;
  const nose = screen(plus(now.base, rotate([base[0] * 0.7, 0], now.yaw))), middle = screen(now.base);
  stroke([middle, nose]);
  circle(middle, 3.5, theme.edge);
}

const thickness = (scale) => Math.max(3, Math.min(9, 0.06 * scale));

function drawArm(arm, now, colour, screen, scale, overlapping) {
  const thick = thickness(scale);
  pen.lineCap = "round"; pen.lineJoin = "round";
  pen.strokeStyle = colour; pen.lineWidth = thick;
  stroke(now.points.map(screen));
  arm.links.forEach((link, k) => {
    const inside = overlapping.has(`arms/${arm.name}/link${k + 1}`), at = now.points[k];
    if (link.outline) {
      pen.lineWidth = inside ? 3 : 1;
      area(link.outline.map((corner) => screen(plus(at, rotate(corner, now.angles[k])))), null, inside ? theme.overlap : colour);
    } else if (inside) {
      pen.strokeStyle = theme.overlap; pen.lineWidth = thick;
      stroke([at, now.points[k + 1]].map(screen));
    }
  });
  pen.lineWidth = 1.5;
  arm.links.forEach((link, k) => {
    const joint = screen(now.points[k]);
    if (link.length === 0) { // a reaction wheel: the uniform disc of its mass and inertia
      const radius = Math.max(6, scale * Math.sqrt(2 * link.inertia / link.mass));
      circle(joint, radius, null, colour);
      const spoke = [Math.cos(now.angles[k]) * radius, -Math.sin(now.angles[k]) * radius];
      stroke([plus(joint, spoke), joint]);
    }
    circle(joint, thick * 0.62, theme.stage, colour);
  });
  circle(screen(now.end_effector), thick * 0.62, colour);
}

/** A ring for a pin, a square for a rigid contact. */
function drawAttachment(hold, [x, y], scale) {
  const colour = armColour(hold.arm), size = 0.55 * thickness(scale) + 3;
  pen.lineWidth = 2.5;
  if (hold.kind === "pin") circle([x, y], size + 1, theme.stage, colour);
  else area([[x - size, y - size], [x + size, y - size], [x + size, y + size], [x - size, y + size]], colour, theme.stage);
}

function drawTarget(target, pose, screen, scale, overlapping, paint) {
  const middle = screen(pose.point), inside = overlapping.has(`targets/${target.name}`);
  const fill = faint(inside ? theme.overlap : paint, 0.14), edge = inside ? theme.overlap : paint;
  pen.lineWidth = inside ? 3 : 1.5;
  if (target.polygon) {
    area(target.polygon.map((corner) => screen(plus(pose.point, rotate(corner, pose.angle)))), fill, edge);
  } else {
    circle(middle, Math.max(3, target.radius * scale), fill, edge);
    // spokes that show the rotation
    for (const quarter of [1, 0]) {
      const arm = rotate([target.radius, 0], pose.angle + quarter * Math.PI / 2);
      pen.strokeStyle = quarter ? faint(paint, 0.4) : paint;
      stroke([screen(plus(pose.point, [-arm[0], -arm[1]])), screen(plus(pose.point, arm))]);
    }
  }
  circle(middle, 3, paint);
}

/** Next to the target; at the edge for one outside, with its distance from the base. */
function nameTarget(target, pose, now, screen, scale, width, height, paint, notes) {
  const [x, y] = screen(pose.point), size = target.radius * scale, edge = 16;
  if (x > -size && x < width + size && y > -size && y < height + size) {
    notes.text(target.name, theme.ink, (wide) => [[x + 6, y - 6], [x - 6 - wide, y - 6], [x + 6, y + 16]]);
    return;
  }
  const at = [Math.min(Math.max(x, edge), width - edge), Math.min(Math.max(y, edge), height - edge)];
  arrowHead(at, Math.atan2(y - at[1], x - at[0]), paint);
  const away = Math.hypot(pose.point[0] - now.base[0], pose.point[1] - now.base[1]);
  const low = at[1] + (at[1] < height / 2 ? 14 : -6);
  notes.text(`${target.name}, ${away.toFixed(1)} m away`, theme.ink, (wide) => [[at[0] > width / 2 ? at[0] - 12 - wide : at[0] + 12, low]]);
}

const SHOWN_FOR = 4;
const isFresh = (impact) => state.time >= impact.time && state.time <= impact.time + SHOWN_FOR;

/** Pixels per N s, so that the arrows and visible ellipses of all shown cases fit. */
function impulseScale() {
  const contacts = shownCases().flatMap((index) => state.lines[index].impacts.flatMap((impact) => impact.contacts)), most = (of) => Math.max(...contacts.map(of));
  return Math.min(80 / most((one) => force(one.impulse)), element("ellipse")?.checked ? 110 / most((one) => ellipse(one)[0]) : Infinity);
}

/** The way of an impulse's arrow, pixels, y downwards; at least 14 long. */
function wayOf({ impulse }, scale) {
  const f = force(impulse), [, fx, fy] = impulse;
  return [fx, -fy].map((part) => part / f * Math.max(scale * f, 14));
}

/** By how many pixels the arrows of impulses go beyond a box at a scale: on the left, below, on the right, above. */
function beyondBox([left, low, right, high], scale) {
  const contacts = shownCases().flatMap((index) => state.lines[index].impacts.flatMap((impact) => impact.contacts));
  const size = impulseScale(), beyond = [0, 0, 0, 0];
  for (const contact of contacts.filter(({ impulse }) => force(impulse) >= 1e-9)) {
    const [wx, wy] = wayOf(contact, size), [x, y] = contact.end_effector;
    [scale * (left - x) - wx, scale * (low - y) + wy, scale * (x - right) + wx, scale * (y - high) - wy]
      .forEach((over, side) => { beyond[side] = Math.max(beyond[side], over + 4); });
  }
  return beyond;
}

/** Semi-axes of the impulse ellipse at the closing speed of a contact, N s. */
const ellipse = ({ impulse_ellipse: { semi_axes }, relative_twist }) => semi_axes.map((axis) => axis * force(relative_twist));

/** For four seconds after an impact: the impulse on the robot at each contact, and the impulse ellipse. */
function drawImpact(impact, screen, notes) {
  if (!isFresh(impact)) return;
  const scale = impulseScale();
  pen.globalAlpha = Math.min(1, impact.time + SHOWN_FOR - state.time);
  for (const contact of impact.contacts) {
    const from = screen(contact.end_effector), f = force(contact.impulse);
    // rounding error
    if (f < 1e-9) {
      circle(from, 9, null, theme.impulse);
      notes.atTip("no impulse", theme.impulse, from, [1, 0]);
      continue;
    }
    if (element("ellipse")?.checked) {
      const [long, short] = ellipse(contact).map((axis) => axis * scale);
      pen.beginPath();
      pen.ellipse(...from, long, short, -contact.impulse_ellipse.direction, 0, 2 * Math.PI);
      pen.strokeStyle = theme.impulse; pen.fillStyle = faint(theme.impulse, 0.08); pen.lineWidth = 1.2;
      pen.fill();
      pen.stroke();
    }
    const way = wayOf(contact, scale), to = plus(from, way);
    pen.strokeStyle = theme.impulse; pen.lineWidth = 3;
    stroke([from, to]);
    const angle = Math.atan2(way[1], way[0]);
    arrowHead(to, angle, theme.impulse);
    notes.arrow(from, to);
    const mean = element("forces").checked && contact.mean_force ? `, ${force(contact.mean_force).toPrecision(3)} N` : "";
    notes.atTip(`${f.toPrecision(3)} N s${mean}`, theme.impulse, to, way);
  }
  pen.globalAlpha = 1;
}
