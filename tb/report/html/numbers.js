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

// Where in the run, to the nanosecond: "63.280 µs", "5.000021 ms", "120.000 ms".
function momentText(ticks) {
  const [unit, name] = unitOf(ticks);
  return (ticks / unit).toFixed({s: 9, ms: 6}[name] || 3).replace(/(\.\d{3})((?:\d{3})*?)(?:000)+$/, "$1$2") + " " + name;
}

// "2.6 times slower than real time".
function paceText(factor) {
  const times = Math.max(factor, 1 / factor);
  return `${times.toFixed(times < 10 ? 1 : 0)} times ${factor < 1 ? "slower" : "faster"} than real time`;
}

const countText = d3.format(",");
