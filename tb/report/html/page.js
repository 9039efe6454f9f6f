// The page from the run's data. Texts of others enter by .text() only.
const run = JSON.parse(document.getElementById("run").textContent);
const result = run.result;
const page = d3.select("#page");

function section(id, title) {
  const part = page.append("section").attr("id", id);
  part.append("h2").text(title);
  return part;
}

// rows: a list of cells each, texts or numbers; heads that end in " #" are numbers.
function table(parent, heads, rows, classOf = () => null) {
  const isNumber = heads.map(each => each.endsWith(" #"));
  const whole = parent.append("div").attr("class", "table").append("table");
  whole.append("thead").append("tr").selectAll("th").data(heads).join("th").attr("scope", "col").attr("class", (_, i) => isNumber[i] ? "number" : null)
    .text(each => each.replace(/ #$/, ""));
  const lines = whole.append("tbody").selectAll("tr").data(rows).join("tr").attr("class", (_, i) => classOf(i));
  lines.selectAll("td").data(each => each).join("td").attr("class", (_, i) => isNumber[i] ? "number" : null).text(each => each);
  return whole;
}

function header() {
  const head = page.append("header");
  head.append("p").attr("class", "what").text(`${run.chip}, dsdpv1-sim ${run.version}`);
  head.append("h1").text(result.scenario).append("span").attr("class", `verdict ${result.verdict}`).text(result.verdict_text);
  const met = result.expectations.filter(each => each.passed).length;
  const judged = result.expectations.filter(each => each.passed !== null).length;
  const broken = d3.sum(result.checks, each => each.violations), allowed = d3.sum(result.checks, each => each.allowed);
  const facts = [["file", result.file], ["engine, view", `${result.engine}, ${result.view}`], ["simulated", nsText(result.simulated_ns)],
    ["took", `${trimmed(result.wall_s, 2)} s, ${trimmed(result.real_time_factor, 2)} × real time`],
    ["telegrams", `${countText(result.telegrams)} right, ${countText(result.wrong_telegrams)} wrong`],
    ["expectations", `${met} of ${judged} met`], ["checks violated", countText(broken) + (allowed ? `, of these ${countText(allowed)} allowed` : "")],
    ["violations that count", countText(result.violations)]];
  const list = head.append("dl");
  for (const [name, value] of facts) {
    const item = list.append("div").attr("data-fact", name);
    item.append("dt").text(name);
    item.append("dd").text(value);
  }
}

function expectations() {
  const part = section("expectations", "Expectations");
  if (!result.expectations.length) return part.append("p").text("The scenario expects nothing.");
  const words = each => each.passed === null ? "not judged" : each.passed ? "met" : "not met";
  table(part, ["verdict", "expected", "seen", "line #"], result.expectations.map(each => [words(each), each.text, each.seen, each.line]),
    i => ({true: "good", false: "bad"})[result.expectations[i].passed]);
}

function stations() {
  const part = section("stations", "Stations");
  const tsdr = each => each.tsdr ? `${trimmed(each.tsdr.min_bits, 2)} .. ${trimmed(each.tsdr.max_bits, 2)}` : "–";
  table(part, ["slave", "address #", "DP state", "baud", "exchanges #", "overwritten #", "TSDR / bit times #", "chip waited #", "user waited #", "longest hold #"],
    result.slaves.map(each => [each.name, each.address, each.dp_state, each.baud, countText(each.data_exchanges), countText(each.outputs_overwritten), tsdr(each),
      nsText(each.handshake.chip_longest_wait_ns), nsText(each.handshake.user_longest_wait_ns), nsText(each.handshake.user_longest_hold_ns)]));
  if (result.masters.length)
    table(part, ["master", "address #", "cycles #"], result.masters.map(each => [each.name, each.address, countText(each.cycles)]));
}

function telegrams() {
  const part = section("telegrams", "Telegrams"), data = run.telegrams;
  if (!data.rows.length) return part.append("p").text("There were none.");
  const flags = result.events.filter(each => each.slave === "bus" && each.severity === "violation");
  part.append("p").attr("class", "note").text("Drag in the strip below, or zoom with + and −, Ctrl and the wheel, or the wheel after a click. A triangle is a violation on the bus.");
  if (data.count > data.rows.length)
    part.append("p").attr("class", "note limited").text(`The first ${countText(data.rows.length)} of ${countText(data.count)} telegrams are shown.`);
  telegramLegend(part, data);
  const end = Math.max(result.simulated_ns * TICKS_PER_NS, d3.max(data.rows, each => each[1]));
  telegramChart(part.append("div").attr("class", "chart"), data, flags, data.count > data.rows.length ? d3.max(data.rows, each => each[1]) : end);
}

function times() {
  if (!run.times.length) return;
  const part = section("times", "Times");
  part.append("p").attr("class", "note").text("How often each duration was seen; the counts grow by powers of ten.");
  const grid = part.append("div").attr("class", "grid");
  for (const each of run.times) histogram(grid, each);
}

function checks() {
  const part = section("checks", "Checks");
  if (!result.checks.length) return part.append("p").text("No check was on.");
  part.append("p").attr("class", "note").text("The worst margin of each check is the mark, all margins are the strip; left of 0 a check is violated.");
  const names = [...new Set(result.checks.map(each => each.slave))];
  for (const name of names) {
    const own = result.checks.filter(each => each.slave === name && each.count > 0);
    const parent = part.append("div").attr("class", "of-slave").attr("data-slave", name);
    if (names.length > 1) parent.append("h3").text(name);
    margins(parent.append("div").attr("class", "chart"), own);
    const details = parent.append("details");
    details.append("summary").text("Numbers");
    table(details, ["check", "count #", "violations #", "allowed #", "limit #", "worst value #", "worst margin #", "when #", "clause"],
      own.map(each => [each.id, countText(each.count), countText(each.violations), countText(each.allowed), nsText(each.limit_ns), nsText(each.worst_value_ns),
        nsText(each.worst_margin_ns), each.at_ns === null ? "–" : momentText(each.at_ns * TICKS_PER_NS), each.clause]),
      i => own[i].violations ? "bad" : null).attr("class", "checks");
  }
}

function diagram(parent, each) {
  const figure = parent.append("figure").attr("class", "diagram").attr("data-id", each.id).attr("data-slave", each.slave);
  figure.append("figcaption").text(each.title).append("span").attr("class", "whose").text(each.slave);
  if (!each.picture) return figure.append("p").attr("class", "note").text("Not seen in this run.");
  const limited = each.picture.spans.some(span => span.margin !== null);
  figure.append("p").attr("class", "note")
    .text(`${each.text} The ${limited ? "one with the least margin" : "longest"} of ${countText(each.instances)}, at ${momentText(each.picture.anchor)}.`);
  timingPicture(figure.append("div").attr("class", "chart"), {...each.picture, marks: [], strong: Infinity}, null);
  const seen = span => span.from !== null && span.to !== null;
  table(figure, ["", "measured #", "limit #", "margin #", "check", "clause"],
    each.picture.spans.map(span => [span.name, seen(span) ? timeText(span.to - span.from) : "longer than waited for", limitText(span), span.margin === null ? "" : timeText(span.margin),
      span.check || "", span.clause || ""]), i => each.picture.spans[i].margin !== null && each.picture.spans[i].margin < 0 ? "bad" : null);
}

function diagrams() {
  if (!run.diagrams.length) return;
  const part = section("diagrams", "Timing, measured");
  part.append("p").attr("class", "note").text("Times are counted from the moment named. A shaded part must be kept free: the least time that is allowed; a line is the longest.");
  for (const each of run.diagrams.filter(one => one.slave === run.diagrams[0].slave)) diagram(part, each);
  const others = run.diagrams.filter(one => one.slave !== run.diagrams[0].slave);
  for (const name of new Set(others.map(each => each.slave))) {
    const details = part.append("details");
    details.append("summary").text(`The same at ${name}`);
    whenOpen(details, () => { for (const each of others.filter(one => one.slave === name)) diagram(details, each); });
  }
}

// Pictures that nobody looks at are not drawn.
function whenOpen(details, draw) {
  let drawn = false;
  const open = () => {
    if (drawn || !details.property("open")) return;
    drawn = true;
    draw();
  };
  details.on("toggle", open);
  open();
}

function violation(parent, each, open) {
  const details = parent.append("details").attr("class", "violation").attr("data-id", each.check).property("open", open);
  const summary = details.append("summary");
  summary.append("b").text(each.check);
  summary.append("span").text(` at ${momentText(each.at)} (${each.slave}): ${each.text}`);
  whenOpen(details, () => {
    details.append("p").text(`${each.rule} (${each.clause}).`);
    const marks = [{at: each.at, name: "here"}];
    if (each.found > each.at) marks.push({at: each.found, name: "seen"});
    const before = 0.4 * 12000, last = Math.min(each.found, each.to) - each.at;
    timingPicture(details.append("div").attr("class", "chart"), {anchor: each.at, from: each.from, to: each.to, pins: each.pins, spans: [], marks: marks, strong: each.of_rule},
      [-Math.max(before, last * 0.2), last + Math.max(before, last * 0.2)]);
    details.append("p").attr("class", "advice").text(each.advice);
  });
}

const MOST_OPEN = 40;

// The first of each check is open.
function violations() {
  const part = section("violations", "Violations");
  const others = result.events.filter(each => each.severity === "violation");
  if (!run.violations.length && !others.length) return part.append("p").text("There were none.");
  const kinds = run.violations.map(each => each.slave + " " + each.check);
  run.violations.forEach((each, i) => violation(part, each, i < MOST_OPEN && kinds.indexOf(kinds[i]) === i));
  if (run.not_pictured)
    part.append("p").attr("class", "note").text(`${countText(run.not_pictured)} more have no picture; the counts are in the table of the checks.`);
  if (!others.length) return;
  part.append("h3").text("Of the chip and on the bus");
  eventTable(part, others);
}

const MOST_EVENTS = 200;

function eventTable(parent, events) {
  table(parent, ["time #", "station", "code", "severity", "what"],
    events.slice(0, MOST_EVENTS).map(each => [momentText(each.at_ns * TICKS_PER_NS), each.slave, each.code, each.severity + (each.allowed ? ", allowed" : ""), each.text]),
    i => events[i].severity === "violation" && !events[i].allowed ? "bad" : null);
  if (events.length > MOST_EVENTS) parent.append("p").attr("class", "note").text(`The first ${MOST_EVENTS} of ${countText(events.length)}.`);
}

function events() {
  const part = section("events", "Refusals and events");
  if (result.refused.length)
    table(part, ["refused", "station", "count #", "first #", "last #", "what"],
      result.refused.map(each => [each.code, each.slave, countText(each.count), momentText(each.first_ns * TICKS_PER_NS), momentText(each.last_ns * TICKS_PER_NS), each.text]));
  if (!result.events.length) return part.append("p").text("No event.");
  const details = part.append("details");
  details.append("summary").text(`${countText(result.events.length + result.events_dropped)} events`);
  whenOpen(details, () => eventTable(details, result.events));
}

for (const draw of [header, expectations, stations, telegrams, times, checks, diagrams, violations, events]) draw();
