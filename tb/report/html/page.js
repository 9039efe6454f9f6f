// The page from the run's data. Texts of others enter by .text() only.
const run = JSON.parse(document.getElementById("run").textContent);
const result = run.result;
const page = d3.select("#page");
const explained = new Set(run.codes.map(each => each.code));

function section(id, title) {
  const part = page.append("section").attr("id", id);
  part.append("h2").text(title);
  return part;
}

// The code of an event or the id of a check, with a link to its row in the last table.
function linked(parent, code) {
  if (!explained.has(code)) return parent.append("span").text(code);
  return parent.append("a").attr("class", "code").attr("href", "#code-" + code).text(code);
}

// Texts of files and folders break after a slash only.
function breaking(parent, path) {
  for (const part of path.split(/(?<=\/)/)) {
    parent.append("span").text(part);
    parent.append("wbr");
  }
}

function cell(parent, content) {
  if (content && content.code) linked(parent, content.code);
  else parent.text(content);
}

// The text of a finding with its line in the firmware, as in the summary.
function withPlace({text, where}) {
  if (!where) return text;
  const line = `at ${where.file ? `${where.file}:${where.line}` : where.pc}`, place = where.function ? `in ${where.function}()` : "";
  if (where.stayed_ns === null) return `${text}, ${line} ${place}`.trim();
  return `${text}, ${place} ${line} for ${timeText(where.stayed_ns * TICKS_PER_NS)}`;
}

// rows: a list of cells each, texts, numbers or {code}; heads that end in " #" are numbers.
function table(parent, heads, rows, classOf = () => null) {
  const isNumber = heads.map(each => each.endsWith(" #"));
  const whole = parent.append("div").attr("class", "table").append("table");
  whole.append("thead").append("tr").selectAll("th").data(heads).join("th").attr("scope", "col").attr("class", (_, i) => isNumber[i] ? "number" : null)
    .text(each => each.replace(/ #$/, ""));
  const lines = whole.append("tbody").selectAll("tr").data(rows).join("tr").attr("class", (_, i) => classOf(i));
  lines.selectAll("td").data(each => each).join("td").attr("class", (_, i) => isNumber[i] ? "number" : null)
    .each(function (each) { cell(d3.select(this), each); });
  return whole;
}

function header() {
  const head = page.append("header");
  head.append("p").attr("class", "what").text(`${run.chip}, dsdpv1-sim ${run.version}`);
  head.append("h1").text(result.scenario).append("span").attr("class", `verdict ${result.verdict}`).text(result.verdict_text);
  const met = result.expectations.filter(each => each.passed).length;
  const judged = result.expectations.filter(each => each.passed !== null).length;
  const done = new Set(result.checks.filter(each => each.count > 0).map(each => each.id));
  const violated = new Set(result.checks.filter(each => each.violations > 0).map(each => each.id));
  const facts = [["file", result.file], ["engine, view", `${result.engine}, ${result.view}`], ["simulated", nsText(result.simulated_ns)],
    ["took", trimmed(result.wall_s, 2) + " s" + (result.real_time_factor > 0 ? ", " + paceText(result.real_time_factor) : "")],
    ["telegrams", `${countText(result.telegrams)} right, ${countText(result.wrong_telegrams)} wrong`],
    ["expectations", `${met} of ${judged} met`], ["checks", done.size ? `${done.size - violated.size} of ${done.size} kept` : "none"], ["violations", violationsText()]];
  const list = head.append("dl");
  for (const [name, value] of facts) {
    const item = list.append("div").attr("data-fact", name);
    item.append("dt").text(name);
    breaking(item.append("dd"), value);
  }
}

// "4,789 expected, 0 unexpected": of checks, of the chip and on the bus.
function violationsText() {
  const expected = d3.sum(result.checks, each => each.allowed) + d3.sum(result.violated.filter(each => each.allowed), each => each.count);
  const unjudged = result.violations_not_judged;
  return `${countText(expected)} expected, ${countText(result.violations)} unexpected` + (unjudged ? `, ${countText(unjudged)} not judged` : "");
}

function expectations() {
  const part = section("expectations", "Expectations");
  if (!result.expectations.length) return part.append("p").text("The scenario expects nothing.");
  const groups = [["Not met", false], ["Not judged", null], ["Met", true]];
  for (const [title, passed] of groups) {
    const some = result.expectations.filter(each => each.passed === passed);
    if (!some.length) continue;
    const group = part.append("div").attr("data-group", title).attr("class", passed === false ? "unmet" : null);
    group.append("h3").text(`${title}: ${some.length}`);
    table(group, ["expected", "seen", "line #"], some.map(each => [each.text, each.seen, each.line]), () => passed === false ? "bad" : null).classed("wide", true);
  }
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
  const chart = part.append("div").attr("class", "chart");
  telegramChart(chart, data, flags, data.count > data.rows.length ? d3.max(data.rows, each => each[1]) : end);
}

function times() {
  if (!run.times.length) return;
  const part = section("times", "Times");
  part.append("p").attr("class", "note").text("How often each duration was seen; the counts grow by powers of ten.");
  const grid = part.append("div").attr("class", "grid");
  for (const each of run.times) histogram(grid, each);
}

// Of a rule about a number that, of others a time.
function orNumber(number, ns) {
  return number === null ? nsText(ns) : countText(number);
}

function checks() {
  const part = section("checks", "Checks");
  if (!result.checks.length) return part.append("p").text("No check was on.");
  part.append("p").attr("class", "note").text("The worst margin of each check is the mark, all margins are the strip; left of 0 a check is violated. Violations are expected where the scenario allows them.");
  const names = [...new Set(result.checks.map(each => each.slave))];
  for (const name of names) {
    const own = result.checks.filter(each => each.slave === name && each.count > 0);
    const parent = part.append("div").attr("class", "of-slave").attr("data-slave", name);
    if (names.length > 1) parent.append("h3").text(name);
    margins(parent.append("div").attr("class", "chart"), own);
    const details = parent.append("details");
    details.append("summary").text("Numbers");
    table(details, ["check", "count #", "violations #", "expected #", "limit #", "worst value #", "worst margin #", "when #", "clause"],
      own.map(each => [{code: each.id}, countText(each.count), countText(each.violations), countText(each.allowed), orNumber(each.limit_number, each.limit_ns), orNumber(each.worst_number, each.worst_value_ns),
        nsText(each.worst_margin_ns), each.at_ns === null ? "–" : momentText(each.at_ns * TICKS_PER_NS), each.clause]),
      i => own[i].violations > own[i].allowed ? "bad" : null).classed("checks", true);
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
      span.check ? {code: span.check} : "", span.clause || ""]), i => each.picture.spans[i].margin !== null && each.picture.spans[i].margin < 0 ? "bad" : null)
    .classed("wide spans", true);
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

// A picture is drawn when its details are opened.
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
  linked(summary.append("b"), each.check);
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

function groupsOf(list, keyOf) {
  const groups = new Map();
  for (const each of list) groups.set(keyOf(each), [...(groups.get(keyOf(each)) || []), each]);
  return [...groups.values()];
}

// The first of each check and slave is open, the others are below it.
function violations() {
  const part = section("violations", "Violations");
  if (!run.violations.length && !result.violated.length) return part.append("p").text("There were none.");
  groupsOf(run.violations, each => each.slave + " " + each.check).forEach(([first, ...others], i) => {
    violation(part, first, i < MOST_OPEN);
    if (!others.length) return;
    const more = part.append("details").attr("class", "more");
    more.append("summary").text(`${others.length} more pictures of ${first.check} at ${first.slave}`);
    for (const each of others) violation(more, each, false);
  });
  if (run.not_pictured)
    part.append("p").attr("class", "note").text(`${countText(run.not_pictured)} more have no picture; the counts are in the table of the checks.`);
  if (!result.violated.length) return;
  part.append("h3").text("Of the chip and on the bus");
  repeatedTable(part, result.violated, "unexpected #");
}

// A row for each station and code, at whatever places. `head`: "unexpected #" of violations; refusals are neither.
function repeatedTable(parent, all, head = null) {
  const groups = groupsOf(all, each => each.slave + " " + each.code);
  const unexpected = group => d3.sum(group.filter(each => each.allowed === false), each => each.count);
  const optional = (group, what) => head ? [what(group)] : [];
  table(parent, ["station", "code", "count #", ...optional(null, () => head), "first #", "last #", "what, the first time"],
    groups.map(group => [group[0].slave, {code: group[0].code}, countText(d3.sum(group, each => each.count)), ...optional(group, each => countText(unexpected(each))),
      momentText(group[0].first_ns * TICKS_PER_NS), momentText(d3.max(group, each => each.last_ns) * TICKS_PER_NS), withPlace(group[0])]),
    i => unexpected(groups[i]) ? "bad" : null).classed("wide", true);
}

const MOST_EVENTS = 200;

function eventTable(parent, events) {
  table(parent, ["time #", "station", "code", "severity", "what"],
    events.slice(0, MOST_EVENTS).map(each => [momentText(each.at_ns * TICKS_PER_NS), each.slave, {code: each.code}, each.severity + (each.allowed ? ", expected" : ""), withPlace(each)]),
    i => events[i].severity === "violation" && !events[i].allowed ? "bad" : null);
  if (events.length > MOST_EVENTS) parent.append("p").attr("class", "note").text(`The first ${MOST_EVENTS} of ${countText(events.length)}.`);
}

function events() {
  const part = section("events", "Refusals and events");
  if (result.refused.length) repeatedTable(part, result.refused);
  if (!result.events.length) return part.append("p").text("No event.");
  const details = part.append("details");
  details.append("summary").text(`${countText(result.events.length + result.events_dropped)} events`);
  whenOpen(details, () => eventTable(details, result.events));
}

// Where a code stands in the documents, when the program was built to know where they are.
function documents(parent, each) {
  if (run.documents) parent.append("a").attr("class", "documents").attr("href", `${run.documents}/${each.page}#${each.code.toLowerCase()}`).text(each.page);
}

function codes() {
  if (!run.codes.length) return;
  const part = section("codes", "Checks and codes of this run");
  part.append("p").attr("class", "note").text("All codes: dsdpv1-sim reasons, and the pages reasons.md and checks.md of the documents.");
  const whole = table(part, ["code", "kind", "what", "what to do"], run.codes.map(each => [each.code, each.kind, each.text, each.advice])).classed("wide", true);
  whole.selectAll("tbody tr").attr("id", (_, i) => "code-" + run.codes[i].code);
  whole.selectAll("td:first-child").each(function (_, i) { documents(d3.select(this), run.codes[i]); });
}

for (const draw of [header, expectations, stations, telegrams, times, checks, diagrams, violations, events, codes]) draw();
if (location.hash) location.replace(location.hash);
