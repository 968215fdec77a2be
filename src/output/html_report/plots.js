// Plots of the time series.

const DASHES = [[], [6, 4], [2, 3], [9, 3, 2, 3]];

/** Names of the joints, arm by arm. */
const joints = study.layout.arms.flatMap((arm) => arm.links.map((_, k) => `${arm.name} joint ${k + 1}`));

/** { title, unit, series: [[name, column]], span: smallest of the axis, log } of each plot of a case. */
function charts(one, line) {
  const masses = [study.layout.base, ...study.layout.arms.flatMap((arm) => arm.links), ...study.targets];
  const mass = masses.reduce((sum, body) => sum + body.mass, 0);
  // smallest span of an axis: a part of the momentum that the kinetic energy could hold, far above rounding errors
  const span = 0.02 * Math.sqrt(2 * mass * Math.max(...line.kinetic_energy)) || 1;
  const alone = one.targets_alone;
  // robot and targets together: the samples of the post-impact motion include the targets
  const whole = (column, share) => column.map((value, i) => value + (i < line.before ? share : 0));
  const named = (columns, names) => columns.map((column, i) => [names[i], column]);
  const energy = whole(line.kinetic_energy, alone.kinetic_energy);
  const twists = targetTwists(one, line);
  const pair = ({ arm, target }) => `${armName(arm)} · ${targetName(target)}`;
  const chart = (title, unit, series, more = {}) => ({ title, unit, series, ...more });
  const holds = one.post_impact ? one.post_impact.holds : [];
  // zero has no logarithm
  const open = ({ open }) => [...Array(line.before).fill(null), ...open.map((value) => value && Math.max(value, 1e-18))];
  const together = one.targets.length ? " of robot and targets" : "";
  return [
    chart("Joint angles", "rad", named(line.joint_angles, joints)),
    chart("Joint rates", "rad/s", named(line.joint_rates, joints)),
    chart("Joint torques", "N m", named(line.joint_torques, joints)),
    chart("Base yaw", "rad", [["yaw", line.base_pose[0]]]),
    chart("Base position", "m", named(line.base_pose.slice(1), ["x", "y"])),
    chart("Base twist", "rad/s, m/s", named(line.base_twist, ["ω", "vx", "vy"])),
    chart("Distances of end effectors from targets", "m", one.distances.map((one) => [pair(one), one.distance])),
    chart("Targets' rates", "rad/s", twists.map(([rate], i) => [targetName(i), rate])),
    chart("Targets' velocities", "m/s", twists.flatMap(([, vx, vy], i) => [[`${targetName(i)} vx`, vx], [`${targetName(i)} vy`, vy]])),
    chart(`Angular momentum${together}`, "N m s", [["l", whole(line.angular_momentum, alone.momentum[0])]], { span }),
    chart(`Linear momentum${together}`, "N s",
      named(line.linear_momentum.map((column, i) => whole(column, alone.momentum[i + 1])), ["px", "py"]), { span }),
    // energy less work changes only at impacts
    chart(`Kinetic energy${together}`, "J", [["T", energy], ["T less the work done", energy.map((value, i) => value - line.work[i])]]),
    chart("Openings of constraints", "m or rad", holds.map((hold) => [pair(hold), open(hold)]), { log: true }),
  ].filter(({ series }) => series.length);
}

/** A line at the current time, and one at each impact. */
function marks(line) {
  const vertical = (plot, time, colour, dash) => {
    if (!(time >= plot.scales.x.min && time <= plot.scales.x.max)) return;
    const x = Math.round(plot.valToPos(time, "x", true)), { top, height } = plot.bbox;
    plot.ctx.save();
    plot.ctx.strokeStyle = colour;
    plot.ctx.lineWidth = devicePixelRatio;
    plot.ctx.setLineDash(dash);
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, top);
    plot.ctx.lineTo(x, top + height);
    plot.ctx.stroke();
    plot.ctx.restore();
  };
  return {
    hooks: {
      draw: [(plot) => {
        line.impacts.forEach((impact) => vertical(plot, impact.time, IMPULSE, [4, 4]));
        vertical(plot, state.time, "#1c2733", []);
        // without a cursor in the plot, the legend shows the values at the current time
        if (!(plot.cursor.left >= 0)) plot.setLegend({ idx: place(line, state.time) }, false);
      }],
      ready: [(plot) => plot.over.addEventListener("click", () => setTime(plot.posToVal(plot.cursor.left, "x")))],
    },
  };
}

/** The range, extended to `span` about its middle if it is smaller. */
function widened(low, high, span) {
  const [middle, half] = [(low + high) / 2, Math.max(high - low, span) / 2];
  return high - low < span ? [middle - half, middle + half] : [low, high];
}

/** A logarithmic axis with every second power of ten. */
const DECADES = {
  splits: () => [1e-18, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1],
  filter: (plot, splits) => splits,
  values: (plot, splits) => splits.map((value) => value.toExponential(0)),
};

let plots = [];

function drawPlots() {
  plots.forEach((plot) => plot.destroy());
  const [one, line] = current(), place = element("plots");
  place.replaceChildren();
  plots = charts(one, line).map(({ title, unit, series, span = 0, log = false }) => {
    const box = document.createElement("div");
    box.className = "plot";
    const heading = document.createElement("h2");
    heading.textContent = `${title} [${unit}]`;
    box.append(heading);
    place.append(box);
    const number = (plot, value) => (value == null ? "–" : value.toPrecision(5));
    const small = (plot, value) => (value == null ? "–" : value.toExponential(1));
    const y = log
      ? { distr: 3, range: (plot, low, high) => [Math.min(low, 1e-16) / 3, Math.max(high, 1e-10) * 3] }
      : { range: (plot, low, high) => uPlot.rangeNum(...widened(low, high, span), 0.1, true) };
    return new uPlot({
      width: box.clientWidth - 20,
      height: 190,
      pxAlign: 0,
      cursor: { sync: { key: "study" }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y },
      axes: [{ label: "time [s]", labelSize: 18, size: 34 }, { size: 64, ...(log ? DECADES : {}) }],
      series: [
        { label: "time [s]", value: number },
        ...series.map(([label], i) => ({
          label, value: log ? small : number, stroke: COLOURS[i % COLOURS.length], width: 1.5,
          // dashes keep coinciding curves visible
          dash: DASHES[series.length <= DASHES.length ? i : Math.floor(i / COLOURS.length) % DASHES.length],
        })),
      ],
      plugins: [marks(line)],
    }, [line.time, ...series.map(([, column]) => column)], box);
  });
}
