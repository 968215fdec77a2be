// The table of the contacts of a case, and the audit.

/** Roles are said: on a phone the table of the contacts is laid out as a grid. */
const CELL_ROLES = { td: "cell", th: "columnheader" };

function cell(kind, text, span = 1) {
  const made = document.createElement(kind);
  made.textContent = text;
  if (CELL_ROLES[kind]) made.setAttribute("role", CELL_ROLES[kind]);
  if (span > 1) {
    made.colSpan = span;
    made.style.setProperty("--span", span);
  }
  return made;
}

function rowOf(cells) {
  const made = document.createElement("tr");
  made.setAttribute("role", "row");
  made.append(...cells);
  return made;
}

/** The head of a row. */
function heading(text) {
  const made = cell("th", text);
  made.scope = "row";
  made.setAttribute("role", "rowheader");
  return made;
}

/** Four digits; rounding errors as zero. */
function digits(value) {
  if (value === null || value === undefined) return "–";
  if (Math.abs(value) < 1e-9) return "0";
  return Math.abs(value) >= 1e4 || Math.abs(value) < 1e-3 ? value.toExponential(2) : value.toPrecision(4);
}

const all = (values) => (values ? values.map(digits).join(", ") : "–");

/** [quantity, its text for a contact]; a row without any text is omitted. */
const ROWS = [
  ["kind", (c) => (c.restitution === null ? c.kind : `${c.kind}, e = ${c.restitution}`)],
  ["impulse on the robot |f| [N s]", (c) => digits(force(c.impulse))],
  ["– fx, fy [N s]", (c) => all(c.impulse.slice(1))],
  ["– moment n [N m s]", (c) => (c.kind === "rigid" ? digits(c.impulse[0]) : null)],
  ["– |f| by the paper's equations", (c) => c.literal_impulse && digits(force(c.literal_impulse))],
  ["mean force |f| [N]", (c) => c.mean_force && (force(c.impulse) < 1e-9 ? "0" : digits(force(c.mean_force)))],
  ["closing speed [m/s]", (c) => digits(c.closing_speed)],
  ["end effector relative to target before: ω [rad/s]", (c) => digits(c.relative_twist[0])],
  ["– vx, vy [m/s]", (c) => all(c.relative_twist.slice(1))],
  ["effective mass of the robot [kg]", (c) => c.effective_masses && digits(c.effective_masses[0])],
  ["– of the target", (c) => c.effective_masses && digits(c.effective_masses[1])],
  ["– of both", (c) => c.effective_masses && digits(c.effective_masses[2])],
  ["impulse index [N s per m/s]", (c) => c.impulse_index !== null && digits(c.impulse_index)],
  ["impulse ellipse, semi-axes [N s per m/s]", (c) => all(c.impulse_ellipse.semi_axes)],
];

/** How many digits after the point tell times apart, three at least. */
function timeDigits(times) {
  const gaps = times.slice(1).map((time, i) => time - times[i]).filter((gap) => gap > 0);
  return Math.min(9, Math.max(3, Math.ceil(-Math.log10(Math.min(...gaps, 1) / 2))));
}

/** A column for each contact, under its impact. */
function contactsTable(place, chosen) {
  const one = study.cases[chosen], line = state.lines[chosen], table = place.querySelector(".impact");
  table.replaceChildren();
  const contacts = line.impacts.flatMap((impact) => impact.contacts);
  place.querySelector(".missed").replaceChildren(...missed(one).map((text) => cell("p", text)));
  place.querySelector(".contacts").hidden = !one.targets.length;
  if (!contacts.length) return;
  table.style.setProperty("--contacts", contacts.length);
  const places = timeDigits(line.impacts.map((impact) => impact.time));
  const row = (cells) => table.append(rowOf(cells));
  const perImpact = (name, text) =>
    row([heading(name), ...line.impacts.map((impact, i) => cell("td", text(impact, i), impact.contacts.length))]);
  row([cell("th", "impact at"), ...line.impacts.map((impact) => {
    const head = cell("th", "", impact.contacts.length), go = cell("button", `${impact.time.toFixed(places)} s`);
    go.type = "button";
    go.addEventListener("click", () => { setPlaying(false); setTime(impact.time); });
    head.append(go);
    return head;
  })]);
  row([cell("th", "contact"), ...contacts.map((contact) => {
    const head = cell("th", `${armName(contact.arm)} · ${targetName(contact.target)}`);
    head.style.boxShadow = `inset 0 -3px ${armColour(contact.arm)}`;
    return head;
  })]);
  for (const [name, of] of ROWS) {
    const texts = contacts.map(of);
    if (texts.some((text) => text)) row([heading(name), ...texts.map((text) => cell("td", text || "–"))]);
  }
  perImpact("kinetic energy before [J]", ({ exact }) => digits(exact.kinetic_energy_before));
  perImpact("– after", ({ exact }) => digits(exact.kinetic_energy_after));
  perImpact("– lost", ({ exact: { kinetic_energy_before: a, kinetic_energy_after: b } }) =>
    (a - b > 1e-9 * a ? `${digits(a - b)} (${(100 * (a - b) / a).toPrecision(3)} %)` : "0"));
}

/** Sentences on grasps that do not close and end effectors that meet no target. */
function missed(one) {
  const open = one.open.map(({ arm, target }) => `${armName(arm)} does not close on ${targetName(target)}.`);
  const away = one.closest.map(({ arm, target, distance, time }) =>
    `The end effector of ${armName(arm)} never meets ${targetName(target)}; the smallest distance is ${digits(distance)} m, at ${time.toFixed(2)} s.`);
  return [...open, ...away, ...(one.targets.length && !one.impacts.length ? ["There is no impact."] : [])];
}

/** The least distance of bodies that are not joined, where it is no overlap's, and their overlaps. */
function clearanceTable(place, chosen) {
  const one = study.cases[chosen], table = place.querySelector(".clearance"), least = one.least;
  const row = (bodies, ...texts) => rowOf([heading(bodies), ...texts.map((text) => cell("td", text))]);
  const box = table.closest("section"), count = one.overlaps.length;
  box.hidden = !least;
  box.querySelector("h2").textContent = `Clearance${count > 1 ? `: ${count} overlaps` : ""}`;
  if (!least) return;
  const deepest = one.overlaps.find(({ bodies, from, to }) => `${bodies}` === `${least.bodies}` && from <= least.time && least.time <= to);
  const overlaps = one.overlaps.map((overlap) => {
    const { bodies, from, to, depth, default_outline } = overlap, mark = overlap === deepest ? " (least)" : "";
    const made = row(bodies.join(" – ") + (default_outline ? " *" : ""), digits(-depth) + mark, `${from.toFixed(2)} to ${to.toFixed(2)}`);
    made.className = "bad";
    return made;
  });
  const apart = deepest ? [] : [row(least.bodies.join(" – "), `${digits(least.least_distance)} (least)`, least.time.toFixed(2))];
  table.replaceChildren(rowOf(["bodies", "distance [m]", "time [s]"].map((text) => cell("th", text))), ...apart, ...overlaps);
  place.querySelector(".defaults").hidden = !one.overlaps.some(({ default_outline }) => default_outline);
}

/** What the audit says of the shown cases. */
function audit() {
  element("audit").replaceChildren(...shownCases().flatMap((index, _, all) => {
    const one = study.cases[index];
    return auditOf(one, all.length > 1 ? `${one.name}: ` : "");
  }));
}

function auditOf(one, whose) {
  const of = (name, phase) => {
    if (!phase) return [];
    const numbers = [["momentum drift", phase.momentum_drift], ["energy error", phase.energy_error],
      ["centre-of-mass drift", phase.center_of_mass_drift]];
    if (one.post_impact === phase && phase.holds.length) numbers.push(["constraints open by", Math.max(...phase.constraint_errors)]);
    return [`${name}: ${numbers.map(([what, value]) => `${what} ${value.toExponential(1)}`).join(", ")}`];
  };
  const after = one.impacts.length ? "after the impact" : "after the approach";
  // without the objections to other cases
  const others = study.cases.filter((other) => other !== one).map((other) => other.name);
  const objections = partOf(one).objections.filter((text) => !others.some((name) => text.startsWith(`${name}:`) || text.startsWith(`${name},`)));
  const phases = [approachOf(one), one.post_impact].filter(Boolean);
  const [shownSamples, samples] = phases.reduce(([part, all], phase) => [part + phase.time.length, all + phase.samples], [0, 0]);
  const thinned = shownSamples < samples ? [`animation and plots show ${shownSamples} of ${samples} samples`] : [];
  return [cell("p", whose + [...of("approach", phases[0]), ...of(after, one.post_impact), ...thinned].join(" · ")),
    ...objections.map((text) => Object.assign(cell("p", text), { className: "bad" }))];
}
