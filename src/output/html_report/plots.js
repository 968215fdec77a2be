// Plots of the time series.

const DASHES = [[], [6, 4], [2, 3], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2, 1, 2], [1, 2]];
const dash = (i) => DASHES[i % DASHES.length];

/** Names of the joints, arm by arm. */
const joints = arms.flatMap((arm) => arm.links.map((_, k) => `${arm.name} joint ${k + 1}`));

/**
 * The style of each curve: arms and targets have their colours, the joints of an arm, the targets of an arm and the
 * components of a vector their dashes; what is of the base or the whole is in ink.
 */
const ofJoints = arms.flatMap((arm, i) => arm.links.map((_, k) => ({ paint: () => armColour(i), dash: dash(k) })));
const ofWhole = (i) => ({ paint: () => theme.ink, dash: dash(i) });

/** { title, unit, series: [[name, column, style]], span: smallest of the axis, log } of each plot of a case. */
function charts(one, line) {
  const { layout, targets } = partOf(one), masses = [layout.base, ...layout.arms.flatMap((arm) => arm.links), ...targets];
  const mass = masses.reduce((sum, body) => sum + body.mass, 0);
  // smallest span of an axis: a part of the momentum that the kinetic energy could hold, far above rounding errors
  const span = 0.02 * Math.sqrt(2 * mass * Math.max(...line.kinetic_energy)) || 1;
  const alone = one.targets_alone;
  // robot and targets together: the samples of the post-impact motion include the targets
  const whole = (column, share) => column.map((value, i) => value + (i < line.before ? share : 0));
  const named = (columns, names, styles) => columns.map((column, i) => [names[i], column, styles ? styles[i] : ofWhole(i)]);
  const ofTarget = (i, k = 0) => ({ paint: () => targetColour(i), dash: dash(k) });
  const ofPair = ({ arm, target }) => ({ paint: () => armColour(arm), dash: dash(target) });
  const energy = whole(line.kinetic_energy, alone.kinetic_energy);
  const twists = targetTwists(one, line);
  const pair = ({ arm, target }) => `${armName(arm)} · ${targetName(target)}`;
  const chart = (title, unit, series, more = {}) => ({ title, unit, series, ...more });
  const holds = one.post_impact ? one.post_impact.holds : [];
  // zero has no logarithm
  const open = ({ open }) => [...Array(line.before).fill(null), ...open.map((value) => value && Math.max(value, 1e-18))];
  const together = one.targets.length ? " of robot and targets" : "";
  return [
    chart("Joint angles", "rad", named(line.joint_angles, joints, ofJoints)),
    chart("Joint rates", "rad/s", named(line.joint_rates, joints, ofJoints)),
    chart("Joint torques", "N m", named(line.joint_torques, joints, ofJoints)),
    chart("Base yaw", "rad", [["yaw", line.base_pose[0], ofWhole(0)]]),
    chart("Base position", "m", named(line.base_pose.slice(1), ["x", "y"])),
    chart("Base twist", "rad/s, m/s", named(line.base_twist, ["ω", "vx", "vy"])),
    chart("Distances of end effectors from targets", "m", one.distances.map((one) => [pair(one), one.distance, ofPair(one)])),
    chart("Targets' rates", "rad/s", twists.map(([rate], i) => [targetName(i), rate, ofTarget(i)])),
    chart("Targets' velocities", "m/s", twists.flatMap(([, vx, vy], i) => [[`${targetName(i)} vx`, vx, ofTarget(i)], [`${targetName(i)} vy`, vy, ofTarget(i, 1)]])),
    chart(`Angular momentum${together}`, "N m s", [["l", whole(line.angular_momentum, alone.momentum[0]), ofWhole(0)]], { span }),
    chart(`Linear momentum${together}`, "N s",
      named(line.linear_momentum.map((column, i) => whole(column, alone.momentum[i + 1])), ["px", "py"]), { span }),
    // energy less work changes only at impacts
    chart(`Kinetic energy${together}`, "J", [["T", energy, ofWhole(0)], ["T less the work done", energy.map((value, i) => value - line.work[i]), ofWhole(1)]]),
    chart("Openings of constraints", "m or rad", holds.map((hold) => [pair(hold), open(hold), ofPair(hold)]), { log: true }),
  ].filter(({ series }) => series.length);
}

/** A line at the current time, and one at each impact. */
function marks(line) {
  const vertical = (plot, time, paint, dashes) => {
    if (!(time >= plot.scales.x.min && time <= plot.scales.x.max)) return;
    const x = Math.round(plot.valToPos(time, "x", true)), { top, height } = plot.bbox;
    plot.ctx.save();
    plot.ctx.strokeStyle = paint;
    plot.ctx.lineWidth = devicePixelRatio;
    plot.ctx.setLineDash(dashes);
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, top);
    plot.ctx.lineTo(x, top + height);
    plot.ctx.stroke();
    plot.ctx.restore();
  };
  return {
    hooks: {
      draw: [(plot) => {
        line.impacts.forEach((impact) => vertical(plot, impact.time, theme.impulse, [4, 4]));
        vertical(plot, state.time, theme.ink, []);
        // without a cursor in the plot, the legend shows the values at the current time
        if (!(plot.cursor.left >= 0)) showValues(plot, line);
      }],
      ready: [(plot) => {
        plot.over.addEventListener("click", () => setTime(plot.posToVal(plot.cursor.left, "x")));
        showValues(plot, line);
      }],
    },
  };
}

/** The values of the row that is nearest to the current time, in the legend. */
function showValues(plot, line) {
  const time = Math.min(state.time, line.end);
  const before = place(line, time), after = Math.min(before + 1, line.time.length - 1);
  plot.setLegend({ idx: line.time[after] - time < time - line.time[before] ? after : before }, false);
}

/** The range, extended to `span` about its middle if it is smaller. */
function widened(low, high, span) {
  const [middle, half] = [(low + high) / 2, Math.max(high - low, span) / 2];
  return high - low < span ? [middle - half, middle + half] : [low, high];
}

/** A logarithmic axis with every second power of ten. */
const DECADES = {
  splits: (plot, axis, low, high) =>
    [1e-18, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1].filter((value) => low <= value && value <= high),
  filter: (plot, splits) => splits,
  values: (plot, splits) => splits.map((value) => value.toExponential(0)),
};

let plots = [];

/** The plots of the cases that are shown, in their places; those side by side have the same ranges. */
function drawPlots(places) {
  plots.forEach((plot) => plot.destroy());
  const each = places.map(([place, chosen]) => ({ place, line: state.lines[chosen], all: charts(study.cases[chosen], state.lines[chosen]) }));
  const extent = (title) => each.flatMap(({ all }) => all.filter((chart) => chart.title === title))
    .flatMap(({ series, log }) => series.flatMap(([, column]) => column.filter((value) => value !== null && (!log || value > 0))))
    .reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
  const ranges = new Map(each.flatMap(({ all }) => all.map(({ title }) => [title, extent(title)])));
  const spanOf = (title) => Math.max(...each.flatMap(({ all }) => all.filter((chart) => chart.title === title)).map(({ span = 0 }) => span));
  const end = Math.max(...each.map(({ line }) => line.end));
  plots = each.flatMap(({ place, line, all }) => {
    place.replaceChildren();
    return all.map((chart) => plotOf({ ...chart, span: spanOf(chart.title) }, line, place, ranges.get(chart.title), end));
  });
}

/** Lines in the legend as they are in the plot, with their dashes. */
function drawMarkers(plot) {
  plot.root.querySelectorAll(".u-series").forEach((row, i) => {
    const marker = row.querySelector(".u-marker");
    if (i === 0 || !marker) return;
    const sign = document.createElementNS(SVG, "svg"), stroke = document.createElementNS(SVG, "path");
    const set = { d: "M0 4H28", stroke: plot.series[i].stroke(), "stroke-width": 2, "stroke-dasharray": (plot.series[i].dash || []).join(" ") };
    Object.entries(set).forEach(([name, value]) => stroke.setAttribute(name, value));
    Object.entries({ width: 28, height: 8, "aria-hidden": "true" }).forEach(([name, value]) => sign.setAttribute(name, value));
    sign.append(stroke);
    marker.className = "u-marker line";
    marker.replaceChildren(sign);
  });
}

/** Whether curves are level but for rounding errors: within a part of the smallest span of their axis. */
const isFlat = (series, span) => span > 0 && series.every(([, column]) => Math.max(...column) - Math.min(...column) < 1e-6 * span);

function plotOf({ title, unit, series, span = 0, log = false }, line, place, extent, end) {
  const box = document.createElement("div");
  box.className = "plot";
  box.append(cell("h2", `${title} [${unit}]`));
  if (isFlat(series, span)) {
    const note = cell("p", "constant to rounding");
    note.className = "flat";
    box.append(note);
  }
  place.append(box);
  const number = (plot, value) => (value == null ? "–" : value.toPrecision(5));
  const small = (plot, value) => (value == null ? "–" : value.toExponential(1));
  const y = log
    ? { distr: 3, range: () => [Math.min(extent[0], 1e-16) / 3, Math.max(extent[1], 1e-10) * 3] }
    : { range: () => uPlot.rangeNum(...widened(...extent, span), 0.1, true) };
  // all of its own time is the time of all; a part of it is what the reader has chosen
  const [first, last] = [line.time[0], line.time[line.time.length - 1]];
  const x = { time: false, range: (plot, low, high) => (low === first && high === last ? [0, end] : [low, high]) };
  const axis = { stroke: () => theme.soft, grid: { stroke: () => theme.grid, width: 1 }, ticks: { stroke: () => theme.grid, width: 1 } };
  const plot = new uPlot({
    width: box.clientWidth - 20,
    height: 190,
    pxAlign: 0,
    cursor: { sync: { key: "study" }, drag: { x: true, y: false } },
    scales: { x, y },
    axes: [{ ...axis, label: "time [s]", labelSize: 18, size: 34 }, { ...axis, size: 64, ...(log ? DECADES : {}) }],
    series: [
      { label: "time [s]", value: number },
      ...series.map(([label, , style]) => ({ label, value: log ? small : number, stroke: style.paint, width: 1.5, dash: style.dash })),
    ],
    plugins: [marks(line)],
  }, [line.time, ...series.map(([, column]) => column)], box);
  drawMarkers(plot);
  plot.over.setAttribute("role", "img");
  plot.over.setAttribute("aria-label", `${title} over time; the values at the current time are in the table below`);
  return plot;
}
