// Arrows that can be switched on: velocities, joint torques, mean forces of contacts.

/** Twists of base and end effectors at a time: [ω, vx, vy] of the base's COM, and [vx, vy] of each end effector. */
function velocities(line, now, time) {
  const at = (column) => between(line, column, time);
  const [rate, vx, vy] = line.base_twist.map(at);
  // of a point of a body with this rate, from another point of it
  const along = ([x, y], [dx, dy], rate) => [x - rate * dy, y + rate * dx];
  const minus = ([a, b], [c, d]) => [a - c, b - d];
  let joint = 0;
  const end_effectors = now.arms.map((arm, i) => {
    let turning = rate, velocity = along([vx, vy], minus(arm.points[0], now.base), rate);
    arms[i].links.forEach((_, k) => {
      turning += at(line.joint_rates[joint]);
      joint += 1;
      velocity = along(velocity, minus(arm.points[k + 1] || arm.end_effector, arm.points[k]), turning);
    });
    return velocity;
  });
  return { base: [rate, vx, vy], end_effectors };
}

/** Twists of the targets at a time. */
function twistsOfTargets(one, line, time) {
  return one.targets.map(({ twist }, i) =>
    (time >= line.after ? one.post_impact.target_twists[i].map((column) => between(line, column, time, line.before)) : twist));
}

const speed = ([x, y]) => Math.hypot(x, y);

/** The cases that are shown: their arrows have one scale, so that they can be compared. */
const shownCases = () => [state.chosen, state.beside].filter((index) => index !== null);

/** The greatest speed and torque of the cases that are shown. */
function greatestShown() {
  const each = shownCases().map(greatestOf);
  return { speed: Math.max(...each.map(({ speed }) => speed)), torque: Math.max(...each.map(({ torque }) => torque)) };
}

/** The greatest speed and torque in a case, once for each. */
const greatest = new Map();
function greatestOf(chosen) {
  if (!greatest.has(chosen)) {
    const [one, line] = [study.cases[chosen], state.lines[chosen]], times = Array.from({ length: 101 }, (_, i) => line.end * i / 100);
    const speeds = times.flatMap((time) => [
      ...velocities(line, configuration(line, time), time).end_effectors.map(speed),
      ...twistsOfTargets(one, line, time).map((twist) => speed(twist.slice(1))),
    ]);
    const torques = line.joint_torques.map((column) => column.reduce((most, torque) => Math.max(most, Math.abs(torque)), 0));
    greatest.set(chosen, { speed: Math.max(...speeds, 1e-12), torque: Math.max(...torques, 1e-12) });
  }
  return greatest.get(chosen);
}

/** An arrow on the screen; nothing for one of less than 4 pixels. */
function arrow(from, [x, y], paint) {
  const size = Math.hypot(x, y);
  if (size < 4) return;
  const to = plus(from, [x, y]);
  pen.strokeStyle = paint; pen.lineWidth = 2;
  stroke([from, to]);
  arrowHead(to, Math.atan2(y, x), paint);
}

const LONGEST = 70;

/** Velocities of end effectors, base and targets, the greatest of all shown with 70 pixels; those now, in m/s. */
function drawVelocities(chosen, now, poses, screen, notes) {
  const [one, line] = [study.cases[chosen], state.lines[chosen]];
  const scale = LONGEST / greatestShown().speed, { base: [, vx, vy], end_effectors } = velocities(line, now, state.time);
  const draw = (point, [x, y], paint) => {
    const [from, way, size] = [screen(point), [scale * x, -scale * y], speed([x, y])];
    arrow(from, way, paint);
    if (scale * size < 4) return;
    notes.arrow(from, plus(from, way));
    notes.atTip(`${size.toPrecision(2)} m/s`, paint, plus(from, way), way);
  };
  end_effectors.forEach((velocity, arm) => draw(now.arms[arm].end_effector, velocity, armColour(arm)));
  draw(now.base, [vx, vy], theme.edge);
  const free = (i) => !line.holds.some((hold) => hold.target === i && hold.time <= state.time);
  const targets = twistsOfTargets(one, line, state.time).map((twist) => twist.slice(1));
  targets.forEach((velocity, i) => { if (free(i)) draw(poses[i].point, velocity, targetColour(i)); });
  return { base: [vx, vy], end_effectors, targets };
}

/** Joint torques as bent arrows about the joints, the greatest of all shown over three quarters of a turn. */
function drawTorques(chosen, now, screen, scale) {
  const line = state.lines[chosen], turn = 1.5 * Math.PI / greatestShown().torque, radius = thickness(scale) + 8;
  const torques = line.joint_torques.map((column) => between(line, column, state.time));
  let joint = 0;
  now.arms.forEach((arm, i) => arms[i].links.forEach((_, k) => {
    const angle = turn * torques[joint], [x, y] = screen(arm.points[k]), end = -Math.PI / 2 - angle;
    joint += 1;
    if (Math.abs(angle) < 0.05) return;
    pen.strokeStyle = armColour(i); pen.lineWidth = 2; pen.lineCap = "butt";
    pen.beginPath();
    // anticlockwise is positive, and on the screen y points down
    pen.arc(x, y, radius, -Math.PI / 2, end, angle > 0);
    pen.stroke();
    const heading = end + (angle > 0 ? -Math.PI / 2 : Math.PI / 2);
    arrowHead([x + radius * Math.cos(end), y + radius * Math.sin(end)], heading, armColour(i), 6);
  }));
  return torques;
}
