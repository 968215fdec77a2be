// Controls of the page.

/** The time of the last sample that is shown. */
const endOfAll = () => Math.max(current()[1].end, state.beside === null ? 0 : state.lines[state.beside].end);

function setTime(time) {
  const [one, line] = current(), end = endOfAll();
  state.time = Math.min(Math.max(time, 0), end);
  const scrub = element("scrub"), phase = phaseName(line, state.time);
  scrub.max = end;
  scrub.value = state.time;
  scrub.setAttribute("aria-valuetext", `${state.time.toFixed(2)} seconds of ${end.toFixed(0)}, ${phase}`);
  element("clock").replaceChildren(cell("span", `${state.time.toFixed(2)} s of ${end.toFixed(0)} s`), cell("span", phase));
  const overlaps = overlapsAt(one, line, state.time).map(({ bodies }) => bodies.join(" and "));
  canvas.setAttribute("aria-label", `${layoutOf(one).name} and its targets, ${one.name}, at ${state.time.toFixed(2)} s` +
    (overlaps.length ? `; overlapping: ${overlaps.join(", ")}` : ""));
  draw();
  toAddress();
  state.listeners.forEach((tell) => tell());
}

function setPlaying(playing) {
  if (playing && state.time >= endOfAll()) setTime(0);
  state.playing = playing;
  const [sign, word] = element("play").querySelectorAll("span");
  [sign.textContent, word.textContent] = playing ? ["❚❚", "pause"] : ["▶", "play"];
  element("play").setAttribute("aria-pressed", String(playing));
  if (playing) requestAnimationFrame((now) => step(now, now));
}

function step(last, now) {
  if (!state.playing) return;
  setTime(state.time + (now - last) / 1000 * Number(element("speed").value));
  if (state.time >= endOfAll()) setPlaying(false);
  else requestAnimationFrame((next) => step(now, next));
}

const goTo = (time) => { setPlaying(false); setTime(time); };

/** The place of a time on the bar; the slider's thumb is 16 pixels wide. */
const onRail = (time) => `calc(8px + ${time / endOfAll()} * (100% - 16px))`;

/** A mark on the time bar for each impact; a click sets the time. */
function marksOfImpacts() {
  const [, line] = current();
  element("instants").replaceChildren(...line.impacts.flatMap((impact, i) => {
    const mark = cell("button", "▼"), stem = document.createElement("i");
    mark.type = "button";
    mark.title = `impact ${i + 1} of ${line.impacts.length}, ${impact.time.toFixed(3)} s`;
    mark.setAttribute("aria-label", mark.title);
    mark.style.left = stem.style.left = onRail(impact.time);
    mark.addEventListener("click", () => goTo(impact.time));
    return [stem, mark];
  }));
}

/** Depths, m, that cannot be seen in the scene. */
const SHALLOW = 1e-3;

/** A red bar in the time bar while bodies overlap, a thin one where they hardly do. */
function marksOfOverlaps() {
  const [one] = current();
  element("overlaps").replaceChildren(...one.overlaps.map(({ bodies, from, to, depth }) => {
    const bar = document.createElement("span");
    bar.title = `${bodies.join(" and ")} overlap from ${from.toFixed(2)} s to ${to.toFixed(2)} s`;
    if (depth < SHALLOW) bar.className = "shallow";
    bar.style.left = onRail(from);
    bar.style.width = `calc(${(to - from) / endOfAll()} * (100% - 16px))`;
    return bar;
  }));
}

/** Shows a case, and beside it another one or none (`null`). */
function choose(chosen, beside = state.beside) {
  Object.assign(state, { chosen, beside: beside === chosen ? null : beside });
  const pair = state.beside !== null;
  element("case").value = chosen;
  if (element("beside")) element("beside").value = pair ? state.beside : "";
  const figure = element("scene-beside").parentElement;
  figure.hidden = !pair;
  document.querySelector("main").classList.toggle("pair", pair);
  element("results").classList.toggle("pair", pair);
  element("other").hidden = !pair;
  const shown = pair ? [["own", canvas, chosen], ["other", element("scene-beside"), state.beside]] : [["own", canvas, chosen]];
  for (const [id, scene, index] of shown) {
    const one = study.cases[index];
    scene.nextElementSibling.textContent = pair ? one.name : "";
    Object.assign(element(id).querySelector(".whose"), { textContent: one.name, hidden: !pair });
    scene.setAttribute("aria-label", `${layoutOf(one).name} and its targets, ${one.name}`);
    contactsTable(element(id), index);
    clearanceTable(element(id), index);
  }
  drawPlots(shown.map(([id, , index]) => [element(id).querySelector(".plots"), index]));
  about();
  origin();
  audit();
  setTime(Math.min(state.time, endOfAll()));
  marksOfImpacts();
  marksOfOverlaps();
}

const nextCase = () => choose((state.chosen + 1) % study.cases.length);

/** The first impact after the time, or the last before it. */
function toImpact(forwards) {
  const times = current()[1].impacts.map(({ time }) => time);
  const to = forwards ? times.find((time) => time > state.time + 1e-9) : times.findLast((time) => time < state.time - 1e-9);
  if (to !== undefined) goTo(to);
}

const KEYS = {
  " ": () => setPlaying(!state.playing),
  ArrowRight: (event) => setTime(state.time + (event.shiftKey ? 1 : 0.1)),
  ArrowLeft: (event) => setTime(state.time - (event.shiftKey ? 1 : 0.1)),
  Home: () => setTime(0),
  End: () => setTime(endOfAll()),
  n: () => toImpact(true),
  p: () => toImpact(false),
  c: nextCase,
  d: () => switchTheme(!element("dark").checked),
  s: savePicture,
};

function pressed(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Escape") element("more").open = false;
  const kind = event.target.tagName, own = event.target.matches("select, pre") || (kind === "INPUT" && event.key === " ");
  if (own || !KEYS[event.key] || (event.key === " " && ["BUTTON", "SUMMARY"].includes(kind))) return;
  event.preventDefault();
  KEYS[event.key](event);
}

function switchTheme(dark) {
  setDark(dark);
  draw();
  plots.forEach((plot) => {
    plot.redraw(false);
    drawMarkers(plot);
  });
  legend();
  [["own", state.chosen], ["other", state.beside]].filter(([, index]) => index !== null).forEach(([id, index]) => contactsTable(element(id), index));
}

/** What colours and signs mean. */
function legend() {
  // the sign has the colour: text would be too faint in some of them
  const word = (text, paint) => {
    const made = cell("span", ` ${text.slice(1).trim()}`), sign = cell("span", text[0]);
    if (paint) sign.style.color = paint;
    made.prepend(sign);
    return made;
  };
  const found = new Set(study.cases.flatMap((one) => one.impacts).flatMap((one) => one.contacts).map((one) => one.kind));
  const words = { rigid: "■ held rigidly", pin: "◯ held by a pin" };
  element("legend").replaceChildren(
    ...arms.map((arm, i) => word(`● ${arm.name}`, armColour(i))),
    ...study.parts[0].targets.map((target, i) => word(`◍ ${target.name}`, targetColour(i))),
    ...Object.keys(words).filter((kind) => found.has(kind)).map((kind) => word(words[kind])),
    ...(found.size ? [word("▼ impact; arrows: impulses on the robot, small ones drawn larger", theme.impulse)] : []),
    ...(study.cases.some((one) => one.overlaps.length) ? [word("▬ overlap", theme.overlap)] : []));
  if (!found.size) element("ellipse")?.parentElement.remove();
}

/** A robot and its targets. */
const described = ({ layout, targets }) => `${layout.name}: base ${layout.base.mass} kg, ` +
  layout.arms.map((arm) => `${arm.name} of ${arm.links.length} ${arm.links.length === 1 ? "link" : "links"}`).join(", ") +
  (targets.length ? `; ${targets.map((target) => `${target.name} ${target.mass} kg`).join(", ")}` : "");

/** What the shown cases are of, and the values of their own that they have. */
function about() {
  const shown = shownCases().map((index) => study.cases[index]), robots = shown.map((one) => described(partOf(one)));
  const isOne = robots.every((robot) => robot === robots[0]);
  const values = shown.filter(({ set }) => set).map(({ name, set }) => `${name} has values of its own: ${set}`);
  const lines = [...(isOne ? [robots[0]] : robots.map((robot, i) => `${shown[i].name}: ${robot}`)), ...values];
  element("about").replaceChildren(...lines.map((line) => cell("p", line)));
}

/** Where the chosen case comes from. */
function origin() {
  const { version, command, scenario_sha256, scenario_toml, features } = study.run;
  const [one] = current(), { dynamics, layout_sha256, layout_toml, integrator } = partOf(one).run;
  const entries = [
    ["scenario", study.scenario], ["planar-capture", version], ["command", command], ["scenario's sha256", scenario_sha256],
    ...(study.parts.length > 1 ? [["case", one.name]] : []), ...(one.set ? [["its own values", one.set]] : []),
    ["robot's sha256", layout_sha256], ["dynamics", dynamics],
    ["integrator", Object.entries(integrator).map(([phase, name]) => `${phase}: ${name}`).join(", ")],
    ["features", features.join(", ")],
  ];
  element("origin").replaceChildren(...entries.flatMap(([name, value]) => [cell("dt", name), cell("dd", value)]));
  element("scenario").textContent = scenario_toml;
  element("robot").textContent = layout_toml;
}

function begin() {
  const preference = matchMedia("(prefers-color-scheme: dark)");
  setDark(preference.matches);
  for (const id of ["own", "other"]) element(id).append(element("details").content.cloneNode(true));
  study.cases.forEach((one, i) => {
    for (const id of ["case", "beside"]) {
      const option = cell("option", one.set ? `${one.name} · ${one.set}` : one.name);
      option.value = i;
      element(id).append(option);
    }
  });
  if (study.cases.length < 2) element("second").remove();
  legend();

  preference.addEventListener("change", (event) => switchTheme(event.matches));
  element("dark").addEventListener("change", (event) => switchTheme(event.target.checked));
  element("case").addEventListener("change", (event) => choose(Number(event.target.value)));
  element("beside")?.addEventListener("change", (event) => choose(state.chosen, event.target.value === "" ? null : Number(event.target.value)));
  element("play").addEventListener("click", () => setPlaying(!state.playing));
  element("save").addEventListener("click", savePicture);
  element("scrub").addEventListener("input", (event) => goTo(Number(event.target.value)));
  for (const id of ["traces", "view", "ellipse", "velocities", "forces"]) element(id)?.addEventListener("change", draw);
  document.addEventListener("keydown", pressed);
  document.addEventListener("click", (event) => { if (!element("more").contains(event.target)) element("more").open = false; });
  window.addEventListener("hashchange", () => { if (location.hash !== written) open(fromAddress()); });
  const fit = () => {
    plots.forEach((plot) => plot.setSize({ width: plot.root.parentElement.clientWidth - 20, height: 190 }));
    draw();
  };
  window.addEventListener("resize", fit);
  // paper is white, and two plots wide
  let wasDark = false;
  window.addEventListener("beforeprint", () => {
    wasDark = element("dark").checked;
    if (wasDark) switchTheme(false);
    plots.forEach((plot) => plot.setSize({ width: 320, height: 180 }));
  });
  window.addEventListener("afterprint", () => { if (wasDark) switchTheme(true); fit(); });
  state.listeners.push(() => plots.forEach((plot) => plot.redraw(false)));
  open(fromAddress());
}

/** Shows what the address asks for. */
function open({ chosen = state.chosen, beside = null, time = state.time }) {
  state.time = time;
  choose(chosen, beside);
}

begin();
