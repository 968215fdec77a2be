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

/** Whether a segment passes through the rectangle [left, top, right, bottom]. */
function passes([[ax, ay], [bx, by]], [left, top, right, bottom]) {
  let [from, to] = [0, 1];
  for (const [start, way, low, high] of [[ax, bx - ax, left, right], [ay, by - ay, top, bottom]]) {
    if (way === 0) {
      if (start < low || start > high) return false;
      continue;
    }
    const [enter, leave] = [(low - start) / way, (high - start) / way].sort((a, b) => a - b);
    [from, to] = [Math.max(from, enter), Math.min(to, leave)];
  }
  return from <= to;
}

const LINE = 15;

/** The rectangle of text of this width whose baseline begins at a point, with a margin. */
const frameOf = ([x, y], width) => [x - 3, y - 13, x + width + 3, y + 5];

/**
 * The first of some places for text of this width, each inside a picture, where it is neither on an arrow nor on another
 * text; where there is none, a line above or below one of them, as few lines as will do.
 */
function freePlace(places, width, [across, down], arrows, frames) {
  const inside = ([x, y]) => [Math.max(4, Math.min(x, across - 4 - width)), Math.max(14, Math.min(y, down - 6))];
  const isFree = (place) => {
    const frame = frameOf(place, width), [left, top, right, bottom] = frame;
    return !arrows.some((arrow) => passes(arrow, frame)) &&
      !frames.some(([a, b, c, d]) => left < c && a < right && top < d && b < bottom);
  };
  const lines = Array.from({ length: 12 }, (_, i) => (i % 2 ? 1 : -1) * Math.ceil(i / 2));
  const all = lines.flatMap((line) => places.map(([x, y]) => inside([x, y + LINE * line])));
  return all.find(isFree) || all[0];
}

/** The arrows of a picture, and its texts, which are written when all arrows are known: off these. */
class Notes {
  constructor(width, height) { Object.assign(this, { size: [width, height], arrows: [], texts: [] }); }

  /** An arrow that is drawn. */
  arrow(from, to) { this.arrows.push([from, to]); }

  /** A text at the first of some places that is free; each is where it begins, of its width. */
  text(text, paint, places) { this.texts.push({ text, paint, places, alpha: pen.globalAlpha }); }

  /** A text at the tip of an arrow, which points along `way`. */
  atTip(text, paint, [x, y], [across, down]) {
    this.text(text, paint, (width) => {
      const beside = [[x + 10, y + 4], [x - 10 - width, y + 4]], beyond = [x - width / 2, y + (down < 0 ? -10 : 20)];
      return [...(across < 0 ? beside.reverse() : beside), beyond];
    });
  }

  /** Writes all, and returns where. */
  write() {
    const frames = [], alpha = pen.globalAlpha;
    for (const one of this.texts) {
      pen.font = TEXT;
      const width = pen.measureText(one.text).width, at = freePlace(one.places(width), width, this.size, this.arrows, frames);
      frames.push(frameOf(at, width));
      pen.globalAlpha = one.alpha;
      label(one.text, at, one.paint);
    }
    pen.globalAlpha = alpha;
    return frames;
  }
}

function arrowHead([x, y], angle, colour, size = 9) {
  area([0, 2.6, -2.6].map((turn) => [x + size * Math.cos(angle + turn), y + size * Math.sin(angle + turn)]), colour, null);
}
