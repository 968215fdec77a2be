// Case and time in the address: `#case=NAME&t=SECONDS`, and `&beside=NAME` for a second case.

const caseIndex = (name) => study.cases.findIndex((one) => one.name === name);

/** What the address asks for; what it does not say is absent. */
function fromAddress() {
  const asked = new URLSearchParams(location.hash.slice(1)), time = Number(asked.get("t"));
  const found = (key) => (caseIndex(asked.get(key)) >= 0 ? caseIndex(asked.get(key)) : undefined);
  return { chosen: found("case"), beside: found("beside"), time: asked.has("t") && Number.isFinite(time) ? time : undefined };
}

let written = "", waiting = null;

/** Writes it, not more often than browsers allow. */
function toAddress() {
  if (waiting !== null) return;
  waiting = setTimeout(() => {
    waiting = null;
    const parts = new URLSearchParams({ case: study.cases[state.chosen].name, t: String(Number(state.time.toFixed(3))) });
    if (state.beside !== null) parts.set("beside", study.cases[state.beside].name);
    written = `#${parts}`;
    // without an entry in the history for each time
    if (location.hash !== written) history.replaceState(null, "", written);
  }, 300);
}
