// Lines, areas and text on the canvas, in pixels.

const TEXT = "12px system-ui, sans-serif";
const canvas = element("scene"), screenPen = canvas.getContext("2d");
// what draws: the canvas of a case, or an SVG
let pen = screenPen;

function path(points) {
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
}

function stroke(points) {
  path(points);
  pen.stroke();
}

function area(points, fill, edge) {
  path(points);
  pen.closePath();
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (edge) { pen.strokeStyle = edge; pen.stroke(); }
}

function circle([x, y], radius, fill, edge) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (edge) { pen.strokeStyle = edge; pen.stroke(); }
}

/** Text with an outline, readable on any background. */
function label(text, [x, y], colour) {
  pen.font = TEXT; pen.lineJoin = "round";
  pen.strokeStyle = faint(theme.stage, 0.85); pen.lineWidth = 3;
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
}

/** Where text begins that is to begin at `left`, and to be inside a picture of this width. */
function textStart(text, left, width, edge = 4) {
  pen.font = TEXT;
  return Math.max(edge, Math.min(left, width - edge - pen.measureText(text).width));
}

/** A place for text of this width, below the labels there are at the one that is wanted. */
function below(labels, [x, y], width) {
  const line = 15, near = labels.filter(([left, , right]) => left < x + width && x < right).sort(([, a], [, b]) => a - b);
  for (const [, other] of near) if (Math.abs(y - other) < line) y = other + line;
  labels.push([x, y, x + width]);
  return [x, y];
}

function arrowHead([x, y], angle, colour, size = 9) {
  area([0, 2.6, -2.6].map((turn) => [x + size * Math.cos(angle + turn), y + size * Math.sin(angle + turn)]), colour, null);
}
