// Time series beside the picture, its table, and what the page answers to.

const DASHES = [[], [6, 4], [2, 3], [9, 3, 2, 3]];

/** Names of the joints, arm by arm. */
const joints = study.layout.arms.flatMap((arm) => arm.links.map((_, k) => `${arm.name} joint ${k + 1}`));

/** [title, unit, [[name, column]], least span of the axis] of each plot of a case. */
function charts(one, line) {
  const masses = [study.layout.base, ...study.layout.arms.flatMap((arm) => arm.links), ...study.targets];
  const mass = masses.reduce((sum, body) => sum + body.mass, 0);
  // momentum that nothing changes is a line, not the rounding in it: a part of what the bodies' energy could hold
  const span = 0.02 * Math.sqrt(2 * mass * Math.max(...line.kinetic_energy)) || 1;
  const alone = one.targets_alone || { momentum: [0, 0, 0], kinetic_energy: 0 };
  // robot and targets together: after the impact the robot holds them
  const whole = (column, share) => column.map((value, i) => value + (i < line.before ? share : 0));
  const named = (columns, names) => columns.map((column, i) => [names[i], column]);
  return [
    ["Joint angles", "rad", named(line.joint_angles, joints)],
    ["Joint rates", "rad/s", named(line.joint_rates, joints)],
    ["Joint torques", "N m", named(line.joint_torques, joints)],
    ["Base yaw", "rad", [["yaw", line.base_pose[0]]]],
    ["Base position", "m", named(line.base_pose.slice(1), ["x", "y"])],
    ["Base twist", "rad/s, m/s", named(line.base_twist, ["ω", "vx", "vy"])],
    ["Angular momentum of robot and targets", "N m s", [["l", whole(line.angular_momentum, alone.momentum[0])]], span],
    ["Linear momentum of robot and targets", "N s",
      named(line.linear_momentum.map((column, i) => whole(column, alone.momentum[i + 1])), ["px", "py"]), span],
    ["Kinetic energy of robot and targets", "J", [["T", whole(line.kinetic_energy, alone.kinetic_energy)]]],
  ];
}

/** A line at the current time, and one at the impact. */
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
        vertical(plot, line.impact, "#b3261e", [4, 4]);
        vertical(plot, state.time, "#1c2733", []);
        // the legend says what is at the current time while no cursor is in a plot
        if (!(plot.cursor.left >= 0)) plot.setLegend({ idx: place(line, state.time) }, false);
      }],
      ready: [(plot) => plot.over.addEventListener("click", () => setTime(plot.posToVal(plot.cursor.left, "x")))],
    },
  };
}

/** The range, or one of at least `span` about its middle. */
function widened(low, high, span) {
  const [middle, half] = [(low + high) / 2, Math.max(high - low, span) / 2];
  return high - low < span ? [middle - half, middle + half] : [low, high];
}

let plots = [];

function drawPlots() {
  plots.forEach((plot) => plot.destroy());
  const [one, line] = current(), place = element("plots");
  place.replaceChildren();
  plots = charts(one, line).map(([title, unit, series, span = 0]) => {
    const box = document.createElement("div");
    box.className = "plot";
    const heading = document.createElement("h2");
    heading.textContent = `${title} [${unit}]`;
    box.append(heading);
    place.append(box);
    const number = (plot, value) => (value == null ? "–" : value.toPrecision(5));
    return new uPlot({
      width: box.clientWidth - 20,
      height: 190,
      cursor: { sync: { key: "study" }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y: { range: (plot, low, high) => uPlot.rangeNum(...widened(low, high, span), 0.1, true) } },
      axes: [{ label: "time [s]", labelSize: 18, size: 34 }, { size: 64 }],
      series: [
        { label: "time [s]", value: number },
        ...series.map(([label], i) => ({
          label, value: number, stroke: COLOURS[i % COLOURS.length], width: 1.5,
          dash: DASHES[Math.floor(i / COLOURS.length) % DASHES.length],
        })),
      ],
      plugins: [marks(line)],
    }, [line.time, ...series.map(([, column]) => column)], box);
  });
}

function cell(kind, text) {
  const made = document.createElement(kind);
  made.textContent = text;
  return made;
}

/** What the impact did. */
function impactTable() {
  const [one] = current(), table = element("impact"), number = (x) => x.toPrecision(4);
  table.replaceChildren();
  if (!one.impact) return;
  const row = (kind, texts) => {
    const made = document.createElement("tr");
    made.append(...texts.map((text) => cell(kind, text)));
    table.append(made);
  };
  row("th", ["impulse on the robot", "n [N m s]", "fx [N s]", "fy [N s]", "|f| [N s]", "paper eqs. |f|"]);
  study.layout.arms.forEach((arm, i) => {
    const [exact, paper] = [one.impact.exact.impulses[i], one.impact.paper.impulses[i]];
    if (exact) row("td", [arm.name, ...exact.map(number), number(Math.hypot(exact[1], exact[2])), number(Math.hypot(paper[1], paper[2]))]);
  });
  const { kinetic_energy_before: before, kinetic_energy_after: after } = one.impact.exact;
  row("td", ["kinetic energy [J]", "", "", "before", number(before), ""]);
  row("td", ["", "", "", "after", number(after), ""]);
}

function audit() {
  const [one] = current(), shown = element("audit");
  const of = (name, phase) => (phase ? [`${name}: momentum drift ${phase.momentum_drift.toExponential(1)}, energy error ${phase.energy_error.toExponential(1)}`] : []);
  shown.textContent = [...of("approach", one.approach || study.approach), ...of("after the impact", one.post_impact), ...study.objections].join(" · ");
  shown.className = study.objections.length ? "bad" : "";
}

function choose(index) {
  state.chosen = index;
  element("case").value = index;
  drawPlots();
  impactTable();
  audit();
  setTime(Math.min(state.time, current()[1].end));
}

element("about").textContent = `${study.layout.name}: base ${study.layout.base.mass} kg, ` +
  study.layout.arms.map((arm) => `${arm.name} of ${arm.links.length} links`).join(", ");
study.layout.arms.forEach((arm, i) => {
  const mark = cell("span", `● ${arm.name}   `);
  mark.style.color = COLOURS[i % COLOURS.length];
  element("legend").append(mark);
});
study.cases.forEach((one, i) => {
  const option = cell("option", one.name);
  option.value = i;
  element("case").append(option);
});
element("case").addEventListener("change", (event) => choose(Number(event.target.value)));
element("play").addEventListener("click", () => setPlaying(!state.playing));
element("scrub").addEventListener("input", (event) => { setPlaying(false); setTime(Number(event.target.value)); });
for (const id of ["traces", "follow"]) element(id).addEventListener("change", draw);
document.addEventListener("keydown", (event) => {
  if (event.target.tagName === "SELECT" || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === " " && event.target.tagName !== "BUTTON") { event.preventDefault(); setPlaying(!state.playing); }
  if (event.target.type === "range") return;
  if (event.key === "ArrowRight") setTime(state.time + 0.1);
  if (event.key === "ArrowLeft") setTime(state.time - 0.1);
});
window.addEventListener("resize", () => { plots.forEach((plot) => plot.setSize({ width: plot.root.parentElement.clientWidth - 20, height: 190 })); draw(); });
state.listeners.push(() => plots.forEach((plot) => plot.redraw(false)));
choose(0);
