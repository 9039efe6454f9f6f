// Numbers as texts. Times are ticks of 1/12 ns.
const TICKS_PER_NS = 12;

function trimmed(value, digits) {
  return value.toFixed(digits).replace(/\.?0+$/, "");
}

// The unit in which a time of this length is best read: [ticks of one, its name].
function unitOf(ticks) {
  const ns = Math.abs(ticks) / TICKS_PER_NS;
  if (ns < 1000) return [TICKS_PER_NS, "ns"];
  if (ns < 1e6) return [TICKS_PER_NS * 1e3, "µs"];
  if (ns < 1e9) return [TICKS_PER_NS * 1e6, "ms"];
  return [TICKS_PER_NS * 1e9, "s"];
}

// "12.5 ns", "1.003 µs"; null for none.
function timeText(ticks) {
  if (ticks === null || ticks === undefined) return "–";
  const [unit, name] = unitOf(ticks);
  return trimmed(ticks / unit, 3) + " " + name;
}

function nsText(ns) {
  return ns === null ? "–" : timeText(ns * TICKS_PER_NS);
}

// Where in the run: always in microseconds, as the log has it.
function momentText(ticks) {
  return (ticks / TICKS_PER_NS / 1000).toFixed(3) + " µs";
}

const countText = d3.format(",");
