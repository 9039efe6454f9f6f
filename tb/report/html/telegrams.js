// The telegrams of the run over time: a lane a sender, a bar a telegram. Bars that would be narrower than a pixel and
// follow each other are drawn as one, whose data-count says how many they are.
const LANE = 30, LANE_LEFT = 110, LANE_RIGHT = 26, OVERVIEW = 46;

function telegramsOf(data) {
  return data.rows.map(([start, end, lane, group, words, tsdr]) => ({start, end, lane, group, words, tsdr}));
}

function telegramHint(data, each) {
  const lines = [data.texts[each.words], momentText(each.start) + ", lasts " + timeText(each.end - each.start)];
  if (each.tsdr !== null) lines.push("TSDR " + timeText(each.tsdr));
  return lines.join("\n");
}

// Bars of the part of time that `scale` shows: {lane, group, x, width, count, first}.
function barsOf(telegrams, scale) {
  const [from, to] = scale.domain();
  const open = new Map(), bars = [];
  for (const each of telegrams) {
    if (each.end < from || each.start > to) continue;
    const x = scale(each.start), width = scale(each.end) - x, before = open.get(each.lane);
    if (before && before.group === each.group && x - (before.x + before.width) < 0.75 && width < 1.5) {
      before.width = x + width - before.x;
      ++before.count;
      continue;
    }
    const bar = {lane: each.lane, group: each.group, x, width, count: 1, first: each};
    open.set(each.lane, bar);
    bars.push(bar);
  }
  return bars;
}

// The subject of a telegram is last: "2 -> 5  request SRD low FCB=1 FCV=1  Set_Prm: ...".
function barText(data, bar) {
  const text = data.texts[bar.first.words].split("  ").pop(), room = Math.floor((bar.width - 6) / 6.2);
  if (bar.count > 1 || room < 5) return "";
  return text.length <= room ? text : text.slice(0, room - 1) + "…";
}

function drawBars(plot, data, telegrams, scale) {
  const bars = barsOf(telegrams, scale);
  const place = each => `translate(${each.x},${each.lane * LANE + 4})`;
  const shown = plot.selectAll("g.telegram").data(bars).join(enter => {
    const g = enter.append("g");
    g.append("rect").attr("height", LANE - 8);
    g.append("text").attr("x", 3).attr("y", LANE / 2);
    return g;
  }).attr("class", each => `telegram group${each.group}`).attr("transform", place).attr("data-count", each => each.count);
  shown.select("rect").attr("width", each => Math.max(1, each.width));
  shown.select("text").text(each => barText(data, each));
  hinted(shown, each => each.count === 1 ? telegramHint(data, each.first)
                                         : `${each.count} telegrams, zoom in to see each\nthe first: ${telegramHint(data, each.first)}`);
}

// How many telegrams there are, pixel by pixel, and a brush that selects.
function overview(svg, width, top, telegrams, scale, selected) {
  const bins = d3.histogram().value(each => each.start).domain(scale.domain()).thresholds(Math.floor(width / 2))(telegrams);
  const y = d3.scaleSqrt().domain([0, d3.max(bins, each => each.length) || 1]).range([0, OVERVIEW - 20]);
  const g = svg.append("g").attr("transform", `translate(0,${top})`).attr("class", "overview");
  g.selectAll("rect.density").data(bins.filter(each => each.length)).join("rect").attr("class", "density")
    .attr("x", each => scale(each.x0)).attr("width", each => Math.max(1, scale(each.x1) - scale(each.x0)))
    .attr("y", each => OVERVIEW - 20 - y(each.length)).attr("height", each => y(each.length));
  g.append("g").attr("class", "axis").attr("transform", `translate(0,${OVERVIEW - 20})`).call(timeAxis(scale, width));
  const [left, right] = scale.range();
  const brush = d3.brushX().extent([[left, 0], [right, OVERVIEW - 20]]).on("end", () => {
    const byUser = d3.event.sourceEvent && d3.event.sourceEvent.type !== "zoom";
    if (byUser && d3.event.selection) selected(...d3.event.selection.map(scale.invert));
  });
  const area = g.append("g").attr("class", "brush").call(brush);
  return shown => {
    const part = shown.map(each => Math.min(right, Math.max(left, scale(each))));
    area.call(brush.move, part[1] - part[0] >= right - left - 0.5 ? null : part);
  };
}

function drawFlags(plot, flags, scale) {
  const [from, to] = scale.domain();
  const shown = flags.filter(each => each.at_ns * TICKS_PER_NS >= from && each.at_ns * TICKS_PER_NS <= to);
  hinted(plot.selectAll("path.flag").data(shown).join("path").attr("class", "flag").attr("d", "M-5,-9 L5,-9 L0,0 Z")
    .attr("transform", each => `translate(${scale(each.at_ns * TICKS_PER_NS)},2)`), each => `${each.code}\n${each.text}`);
}

// The first exchange of data and what is round it, as [from, to]; of a run without one its first telegram.
function firstExchange(data, telegrams, end) {
  const found = telegrams.findIndex(each => data.groups[each.group] === "data exchange");
  const first = telegrams[Math.max(0, found)], answer = telegrams.slice(found + 1, found + 3).find(each => each.lane !== first.lane) || first;
  const length = answer.end - first.start, from = Math.max(0, first.start - 4 * length);
  return [from, Math.min(end, from + 12 * length)];
}

function telegramChart(parent, data, flags, end) {
  const telegrams = telegramsOf(data);
  const lanes = data.lanes.length;
  picture(parent, "telegrams", (svg, width) => {
    const bottom = 14 + lanes * LANE;
    setHeight(svg, width, bottom + 24 + OVERVIEW + 4);
    const scale = d3.scaleLinear().domain([0, end]).range([LANE_LEFT, width - LANE_RIGHT]);
    const clip = svg.append("clipPath").attr("id", "telegrams-clip");
    clip.append("rect").attr("x", LANE_LEFT).attr("y", -14).attr("width", width - LANE_RIGHT - LANE_LEFT).attr("height", bottom + 14);
    const names = svg.append("g").attr("transform", "translate(0,14)").selectAll("g").data(data.lanes).join("g")
      .attr("transform", (_, lane) => `translate(0,${lane * LANE})`);
    names.append("text").attr("class", "label").attr("x", LANE_LEFT - 8).attr("y", LANE / 2 + 4)
      .text(each => each.length > 15 ? each.slice(0, 14) + "…" : each).append("title").text(each => each);
    names.append("line").attr("class", "rule").attr("x1", LANE_LEFT).attr("x2", width - LANE_RIGHT).attr("y1", LANE).attr("y2", LANE);
    const plot = svg.append("g").attr("transform", "translate(0,14)").append("g").attr("clip-path", "url(#telegrams-clip)");
    plot.append("rect").attr("class", "ground").attr("x", LANE_LEFT).attr("width", width - LANE_RIGHT - LANE_LEFT).attr("height", lanes * LANE);
    const axis = svg.append("g").attr("class", "axis main").attr("transform", `translate(0,${bottom})`);
    let showPart = () => {};
    const redraw = shown => {
      drawBars(plot, data, telegrams, shown);
      drawFlags(plot, flags, shown);
      axis.call(timeAxis(shown, width - LANE_LEFT));
      svg.attr("data-from", shown.domain()[0]).attr("data-to", shown.domain()[1]);
      showPart(shown.domain());
    };
    const control = zoomable(parent, svg, scale, Math.max(2, end / (2 * 12000)), redraw);
    showPart = overview(svg, width, bottom + 26, telegrams, scale, control.show);
    redraw(scale);
    control.show(...firstExchange(data, telegrams, end));
  });
}

function telegramLegend(parent, data) {
  const counts = data.groups.map((_, group) => data.rows.filter(row => row[3] === group).length);
  const items = data.groups.map((name, group) => ({name, group, count: counts[group]})).filter(each => each.count);
  const list = parent.append("ul").attr("class", "legend").selectAll("li").data(items).join("li");
  list.append("span").attr("class", each => `swatch group${each.group}`);
  list.append("span").text(each => `${each.name} ${countText(each.count)}`);
}
