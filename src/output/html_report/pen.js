// Lines, areas and text on the canvas, in pixels.

const INK = "#44525f", TARGET = "#6d6d6d", IMPULSE = "#b3261e", OVERLAP = "#d00000", TEXT = "12px system-ui, sans-serif";
const canvas = element("scene"), pen = canvas.getContext("2d");

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
  pen.strokeStyle = "rgba(251,252,253,0.85)"; pen.lineWidth = 3;
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
}

function arrowHead([x, y], angle, colour) {
  area([0, 2.6, -2.6].map((turn) => [x + 9 * Math.cos(angle + turn), y + 9 * Math.sin(angle + turn)]), colour, null);
}
