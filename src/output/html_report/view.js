// The visible part of the plane.

/** Half side lengths of the base. */
const halfBase = ({ base }) => base.size.map((side) => side / 2);

/** The times at which a target is to be visible: its impacts, its closest approach, a grasp that does not close. */
function instants(one, line, target) {
  const own = (pairs) => pairs.filter((pair) => pair.target === target);
  return [
    ...line.impacts.filter((impact) => own(impact.contacts).length).map((impact) => impact.time),
    ...own(one.closest).map((pair) => pair.time),
    ...own(one.open).map(() => line.contact),
  ];
}

/** The bounding box of robot, held targets and impacts, or of everything; about the base in that view. */
function bounds(one, line, view) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = ([x, y], r) => {
    box[0] = Math.min(box[0], x - r); box[1] = Math.min(box[1], y - r);
    box[2] = Math.max(box[2], x + r); box[3] = Math.max(box[3], y + r);
  };
  // a free target counts only around its times, so that a distant one does not make the robot small
  const matters = one.targets.map((_, i) => instants(one, line, i));
  const steps = 160, times = Array.from({ length: steps + 1 }, (_, i) => line.end * i / steps);
  for (const time of [...times, ...matters.flat()]) {
    const now = configuration(line, time), origin = view === "follow" ? now.base.map((part) => -part) : [0, 0];
    add(plus(now.base, origin), Math.hypot(...halfBase(line.layout)));
    now.arms.forEach((arm) => arm.points.forEach((point) => add(plus(point, origin), 0.05)));
    targetPoses(one, line, time).forEach((pose, i) => {
      const held = line.holds.some((hold) => hold.target === i && hold.time <= time);
      const near = matters[i].some((instant) => Math.abs(time - instant) <= 2);
      if (view === "everything" || held || near) add(plus(pose.point, origin), bodyOf(one, i).radius);
    });
  }
  return box;
}

const boxes = new Map();

/** The visible box and the view; of two cases side by side, a box for both. */
function viewOf() {
  const view = element("view").value, shown = state.beside === null ? [state.chosen] : [state.chosen, state.beside].sort();
  const key = `${shown} ${view}`;
  if (!boxes.has(key)) {
    const each = shown.map((i) => bounds(study.cases[i], state.lines[i], view));
    boxes.set(key, [Math.min, Math.min, Math.max, Math.max].map((most, side) => most(...each.map((box) => box[side]))));
  }
  return [boxes.get(key), view];
}

/** Lines of equal x and y, with their coordinates. */
function grid(screen, scale, centre, width, height) {
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find((s) => s * scale > 55) || 100;
  pen.strokeStyle = theme.grid; pen.lineWidth = 1; pen.fillStyle = theme.soft; pen.font = "11px system-ui, sans-serif";
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
    if (sy > 16 && sy < height - 18) pen.fillText(`${y.toFixed(digits)} m`, 4, sy - 3);
  }
}
