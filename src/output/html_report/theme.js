// Colours of the page, light and dark, as the canvas and the plots use them.

const theme = {};

/** Takes the colours from the styles. */
function readTheme() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "soft", "grid", "stage", "accent", "impulse", "overlap", "body", "edge"]) {
    theme[name] = style.getPropertyValue(`--${name}`).trim();
  }
}

function setDark(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  element("dark").checked = dark;
  readTheme();
}

/** Colour `index`: those of the arms, then those of the targets, as in the figures; after the palette comes the ink. */
const colour = (index) => study.palette[index % (study.palette.length + 1)] || theme.ink;
const armColour = (arm) => colour(arm);
const targetColour = (target) => colour(Math.max(arms.length, 2) + target);

/** A colour `#rrggbb` with an opacity. */
const faint = (hexadecimal, opacity) => `${hexadecimal}${Math.round(255 * opacity).toString(16).padStart(2, "0")}`;
