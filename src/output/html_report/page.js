// Controls of the page.

function setTime(time) {
  const [, line] = current();
  state.time = Math.min(Math.max(time, 0), line.end);
  element("scrub").max = line.end;
  element("scrub").value = state.time;
  element("clock").textContent = `${state.time.toFixed(2)} s of ${line.end.toFixed(0)} s, ${phaseName(line, state.time)}`;
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

/** A mark on the time bar for each impact; a click sets the time. */
function marksOfImpacts() {
  const [, line] = current();
  element("instants").replaceChildren(...line.impacts.map((impact, i) => {
    const mark = cell("button", "▼");
    mark.type = "button";
    mark.title = `impact ${i + 1} of ${line.impacts.length}, ${impact.time.toFixed(3)} s`;
    mark.setAttribute("aria-label", mark.title);
    // the slider's thumb is 16 pixels wide
    mark.style.left = `calc(8px + ${impact.time / line.end} * (100% - 16px))`;
    mark.addEventListener("click", () => { setPlaying(false); setTime(impact.time); });
    return mark;
  }));
}

/** A red bar under the time bar while bodies overlap. */
function marksOfOverlaps() {
  const [one, line] = current();
  element("overlaps").replaceChildren(...one.overlaps.map(({ bodies, from, to }) => {
    const bar = document.createElement("span");
    bar.title = `${bodies.join(" and ")} overlap from ${from.toFixed(2)} s to ${to.toFixed(2)} s`;
    bar.style.left = `calc(8px + ${from / line.end} * (100% - 16px))`;
    bar.style.width = `calc(${(to - from) / line.end} * (100% - 16px))`;
    return bar;
  }));
}

function choose(index) {
  state.chosen = index;
  element("case").value = index;
  drawPlots();
  contactsTable();
  marksOfImpacts();
  marksOfOverlaps();
  clearanceTable();
  audit();
  setTime(Math.min(state.time, current()[1].end));
}

element("origin").textContent = `planar-capture ${study.run.version}: ${study.run.command}.`;
element("about").textContent = `${study.layout.name}: base ${study.layout.base.mass} kg, ` +
  study.layout.arms.map((arm) => `${arm.name} of ${arm.links.length} links`).join(", ") +
  (study.targets.length ? `; ${study.targets.map((target) => `${target.name} ${target.mass} kg`).join(", ")}` : "");
study.layout.arms.forEach((arm, i) => {
  const mark = cell("span", `● ${arm.name}   `);
  mark.style.color = COLOURS[i % COLOURS.length];
  element("legend").append(mark);
});
{
  const found = new Set(study.cases.flatMap((one) => one.impacts).flatMap((one) => one.contacts).map((one) => one.kind));
  const words = { rigid: "■ held rigidly   ", pin: "◯ held by a pin   " };
  element("legend").append(...Object.keys(words).filter((kind) => found.has(kind)).map((kind) => words[kind]));
  if (found.size) element("legend").append("▼ impact; arrows: impulses on the robot");
  else element("choices").querySelector("#ellipse").parentElement.remove();
}
study.cases.forEach((one, i) => {
  const option = cell("option", one.name);
  option.value = i;
  element("case").append(option);
});
element("case").addEventListener("change", (event) => choose(Number(event.target.value)));
element("play").addEventListener("click", () => setPlaying(!state.playing));
element("scrub").addEventListener("input", (event) => { setPlaying(false); setTime(Number(event.target.value)); });
for (const id of ["traces", "view", "ellipse"]) element(id)?.addEventListener("change", draw);
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
