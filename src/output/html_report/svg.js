// A pen with the part of a canvas's interface that the scene uses, which makes SVG.

const SVG = "http://www.w3.org/2000/svg";

class SvgPen {
  constructor(width, height, background) {
    this.root = document.createElementNS(SVG, "svg");
    const set = { xmlns: SVG, viewBox: `0 0 ${width} ${height}`, width, height };
    Object.entries(set).forEach(([name, value]) => this.root.setAttribute(name, value));
    Object.assign(this, { strokeStyle: "none", fillStyle: "none", lineWidth: 1, globalAlpha: 1, lineCap: "butt", lineJoin: "miter", font: TEXT, steps: [] });
    this.shape("rect", { width, height, fill: background });
  }

  shape(kind, attributes, text) {
    const made = document.createElementNS(SVG, kind);
    const short = (value) => (typeof value === "number" ? Number(value.toFixed(2)) : value);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, short(value)));
    if (text !== undefined) made.textContent = text;
    this.root.append(made);
  }

  beginPath() { this.steps = []; }
  moveTo(x, y) { this.steps.push(`M${x.toFixed(2)} ${y.toFixed(2)}`); }
  lineTo(x, y) { this.steps.push(`L${x.toFixed(2)} ${y.toFixed(2)}`); }
  closePath() { this.steps.push("Z"); }
  arc(x, y, radius, from, to, backwards = false) {
    const at = (angle) => `${(x + radius * Math.cos(angle)).toFixed(2)} ${(y + radius * Math.sin(angle)).toFixed(2)}`;
    const turn = Math.abs(to - from), sweep = backwards ? 0 : 1, r = radius.toFixed(2);
    this.steps.push(`M${at(from)}`);
    // an arc that ends where it begins is not drawn
    const middle = (from + to) / 2;
    this.steps.push(turn > Math.PI ? `A${r} ${r} 0 0 ${sweep} ${at(middle)}A${r} ${r} 0 0 ${sweep} ${at(to)}` : `A${r} ${r} 0 0 ${sweep} ${at(to)}`);
  }
  ellipse(x, y, a, b, angle) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)], degrees = angle * 180 / Math.PI;
    const at = (side) => `${(x + side * a * c).toFixed(2)} ${(y + side * a * s).toFixed(2)}`;
    const half = (side) => `A${a.toFixed(2)} ${b.toFixed(2)} ${degrees.toFixed(2)} 0 1 ${at(side)}`;
    this.steps.push(`M${at(-1)}${half(1)}${half(-1)}`);
  }
  line() { return { "stroke-width": this.lineWidth, "stroke-linecap": this.lineCap, "stroke-linejoin": this.lineJoin, opacity: this.globalAlpha }; }
  stroke() { this.shape("path", { d: this.steps.join(""), fill: "none", stroke: this.strokeStyle, ...this.line() }); }
  fill() { this.shape("path", { d: this.steps.join(""), fill: this.fillStyle, opacity: this.globalAlpha }); }
  text(text, x, y, paint) {
    const [size, ...family] = this.font.split(" ");
    this.shape("text", { x, y, "font-size": parseFloat(size), "font-family": family.join(" "), opacity: this.globalAlpha, ...paint }, text);
  }
  fillText(text, x, y) { this.text(text, x, y, { fill: this.fillStyle }); }
  strokeText(text, x, y) { this.text(text, x, y, { fill: "none", stroke: this.strokeStyle, "stroke-width": this.lineWidth, "stroke-linejoin": this.lineJoin }); }
  measureText(text) {
    screenPen.font = this.font;
    return screenPen.measureText(text);
  }
}

/** The picture of a case at the current time. */
function pictureAsSvg(chosen) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const svg = new SvgPen(width, height, theme.stage);
  pen = svg;
  drawScene(chosen, width, height);
  pen = screenPen;
  const one = study.cases[chosen];
  const title = document.createElementNS(SVG, "title");
  title.textContent = `${study.scenario}, ${one.name}, ${state.time.toFixed(2)} s; planar-capture ${study.run.version}, scenario ${study.run.scenario_sha256}`;
  svg.root.prepend(title);
  return new XMLSerializer().serializeToString(svg.root);
}

/** Saves it as a file. */
function savePicture() {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([pictureAsSvg(state.chosen)], { type: "image/svg+xml" }));
  link.download = `${study.scenario}_${study.cases[state.chosen].name}_${state.time.toFixed(2)}s.svg`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
