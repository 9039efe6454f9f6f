// Pins over time, and what is measured between their edges. Times are counted from the picture's anchor.
const PIN = 28, SPAN = 32, PIN_LEFT = 84, PIN_RIGHT = 26, SLOPE = 3, ARROW = 18;

// A pin as [{from, to, level}] over the whole picture.
function segmentsOf(pin, picture) {
  const segments = [];
  let from = picture.from, level = pin.first;
  for (const [at, next] of pin.steps) {
    if (at > from) segments.push({from: from - picture.anchor, to: at - picture.anchor, level});
    from = at;
    level = next;
  }
  segments.push({from: from - picture.anchor, to: picture.to - picture.anchor, level});
  return segments;
}

const HIGH = 6, LOW = PIN - 6, MIDDLE = PIN / 2;

function levelY(level) {
  return level === "1" ? HIGH : level === "0" ? LOW : MIDDLE;
}

function wirePath(segments, x) {
  return segments.map((each, i) => `${i ? "L" : "M"}${x(each.from)},${levelY(each.level)}L${x(each.to)},${levelY(each.level)}`).join("");
}

// A bus: two lines that cross where the value changes, one in the middle where it floats.
function busPath(each, x) {
  const from = x(each.from), to = x(each.to), slope = Math.min(SLOPE, (to - from) / 2);
  if (each.level === "z") return `M${from},${MIDDLE}L${to},${MIDDLE}`;
  return `M${from},${MIDDLE}L${from + slope},${HIGH}L${to - slope},${HIGH}L${to},${MIDDLE}L${to - slope},${LOW}L${from + slope},${LOW}Z`;
}

function drawPin(row, pin, picture, x) {
  const segments = segmentsOf(pin, picture);
  row.selectAll("*").remove();
  if (pin.width === 1) {
    row.append("path").attr("class", "wire").attr("d", wirePath(segments, x));
    return;
  }
  const [from, to] = x.domain();
  const shown = segments.filter(each => each.to > from && each.from < to);
  row.selectAll("path").data(shown).join("path").attr("class", each => `bus level-${each.level === "z" ? "z" : each.level === "x" ? "x" : "value"}`)
    .attr("d", each => busPath(each, x));
  const centre = each => (Math.max(x.range()[0], x(each.from)) + Math.min(x.range()[1], x(each.to))) / 2;
  const room = each => Math.min(x.range()[1], x(each.to)) - Math.max(x.range()[0], x(each.from));
  row.selectAll("text").data(shown.filter(each => each.level !== "z" && room(each) > textWidth(each.level) + 4)).join("text").attr("class", "level")
    .attr("x", centre).attr("y", MIDDLE + 4).text(each => each.level);
}

function limitText(span) {
  const limits = [];
  if (span.exact !== null) limits.push("= " + timeText(span.exact));
  if (span.least !== null) limits.push("≥ " + timeText(span.least));
  if (span.greatest !== null) limits.push("≤ " + timeText(span.greatest));
  return limits.join(", ");
}

function spanText(span) {
  const limit = limitText(span);
  return `${span.name} ${timeText(span.to - span.from)}${limit ? ` (${limit})` : ""}`;
}

// Most limits are counted from the anchor, so back from the end of a span that ends there; TSDR from the request.
function isCountedBack(span, picture) {
  return span.to === picture.anchor && !span.is_tsdr;
}

function limitAt(span, limit, picture) {
  return (isCountedBack(span, picture) ? span.to - limit : span.from + limit) - picture.anchor;
}

// The text is right of its arrow, else left of it, else above it.
function placeText(text, from, to, left, right) {
  const width = textWidth(text);
  if (to + 8 + width <= right) return {x: to + 8, y: ARROW + 4, anchor: "start"};
  if (from - 8 - width >= left) return {x: from - 8, y: ARROW + 4, anchor: "end"};
  const middle = Math.min(right - width / 2, Math.max(left + width / 2, (from + to) / 2));
  return {x: middle, y: ARROW - 7, anchor: "middle"};
}

function drawSpan(row, span, picture, x) {
  row.selectAll("*").remove();
  const [left, right] = x.range(), y = ARROW;
  const from = x(span.from - picture.anchor), to = x(span.to - picture.anchor);
  const inside = at => Math.min(right + 20, Math.max(left - 20, at));
  if (span.least !== null) {
    const ends = [x(limitAt(span, span.least, picture)), isCountedBack(span, picture) ? to : from].sort((a, b) => a - b);
    row.append("rect").attr("class", "limit least").attr("x", inside(ends[0])).attr("width", Math.max(1.5, inside(ends[1]) - inside(ends[0])))
      .attr("y", ARROW - 8).attr("height", 16);
  }
  for (const limit of [span.greatest, span.exact])
    if (limit !== null)
      row.append("path").attr("class", "limit greatest").attr("d", `M${inside(x(limitAt(span, limit, picture)))},${ARROW - 10} v20`);
  const arrow = row.append("g").attr("class", span.margin !== null && span.margin < 0 ? "arrow bad" : "arrow");
  arrow.append("path").attr("d", `M${inside(from)},${y} L${inside(to)},${y} M${from},${y - 6} v12 M${to},${y - 6} v12`);
  const head = to - from > 16;
  if (head) arrow.append("path").attr("class", "head").attr("d", `M${from},${y} l6,-3 v6 Z M${to},${y} l-6,-3 v6 Z`);
  const text = spanText(span), place = placeText(text, inside(from), inside(to), left, right);
  row.append("text").attr("class", "span").attr("x", place.x).attr("y", place.y).attr("text-anchor", place.anchor).text(text);
}

// {anchor, from, to, pins, spans, marks: [{at, name}]}; `first`: the part shown first, counted from the anchor.
function timingPicture(parent, data, first) {
  const spans = data.spans.filter(each => each.from !== null && each.to !== null);
  const id = "clip-" + timingPicture.count++;
  picture(parent, "timing", (svg, width) => {
    const top = data.marks.length ? 18 : 4, pinsEnd = top + data.pins.length * PIN, axisAt = pinsEnd + 4;
    const height = axisAt + 28 + spans.length * SPAN;
    setHeight(svg, width, height);
    const scale = d3.scaleLinear().domain([data.from - data.anchor, data.to - data.anchor]).range([PIN_LEFT, width - PIN_RIGHT]);
    svg.append("clipPath").attr("id", id).append("rect").attr("x", PIN_LEFT).attr("width", width - PIN_RIGHT - PIN_LEFT).attr("height", height);
    svg.selectAll("text.label").data(data.pins).join("text").attr("class", (_, i) => "label" + (i < data.strong ? "" : " other"))
      .attr("x", PIN_LEFT - 10).attr("y", (_, i) => top + i * PIN + MIDDLE + 4).text(each => each.name);
    const plot = svg.append("g").attr("clip-path", `url(#${id})`);
    plot.append("rect").attr("class", "ground").attr("x", PIN_LEFT).attr("width", width - PIN_RIGHT - PIN_LEFT).attr("height", height);
    const guides = plot.append("g").attr("class", "guides");
    const rows = plot.selectAll("g.pin").data(data.pins).join("g").attr("class", "pin").attr("transform", (_, i) => `translate(0,${top + i * PIN})`)
      .attr("data-pin", each => each.name);
    const spanRows = plot.selectAll("g.measured").data(spans).join("g").attr("class", "measured").attr("data-name", each => each.name)
      .attr("data-margin", each => each.margin).attr("transform", (_, i) => `translate(0,${axisAt + 24 + i * SPAN})`);
    const axis = svg.append("g").attr("class", "axis").attr("transform", `translate(0,${axisAt})`);
    const redraw = x => {
      rows.each(function (pin) { drawPin(d3.select(this), pin, data, x); });
      spanRows.each(function (span) { drawSpan(d3.select(this), span, data, x); });
      drawGuides(guides, data, spans, x, top, axisAt);
      axis.call(timeAxis(x, width - PIN_LEFT));
    };
    const control = zoomable(parent, svg, scale, Math.max(2, (data.to - data.from) / 240), redraw);
    redraw(scale);
    if (first) control.show(...first);
  });
}
timingPicture.count = 0;

// Dashed lines from the pins down to the arrows, and the named marks.
function drawGuides(guides, data, spans, x, top, axisAt) {
  const lines = spans.flatMap((span, i) => [span.from, span.to].map(at => ({at, end: axisAt + 24 + i * SPAN + ARROW + 6})));
  guides.selectAll("line.guide").data(lines).join("line").attr("class", "guide").attr("y1", top).attr("y2", each => each.end)
    .attr("x1", each => x(each.at - data.anchor)).attr("x2", each => x(each.at - data.anchor));
  guides.selectAll("line.mark").data(data.marks).join("line").attr("class", "mark").attr("y1", 4).attr("y2", axisAt)
    .attr("x1", each => x(each.at - data.anchor)).attr("x2", each => x(each.at - data.anchor));
  guides.selectAll("text.mark").data(data.marks).join("text").attr("class", "mark").attr("y", 13)
    .attr("x", (each, i) => x(each.at - data.anchor) + (i ? 4 : -4)).attr("text-anchor", (_, i) => i ? "start" : "end").text(each => each.name);
}
