// The margins of each check: all as a strip, the worst as a mark. Left of 0 are violations.
const ROW = 24, CHECK_LEFT = 250, CHECK_RIGHT = 150;
const FARTHEST = 1e9;  // ns, where the axis ends

function hasMargin(check) {
  return check.worst_margin_ns !== null;
}

function marginHint(check) {
  return [check.rule, `limit ${nsText(check.limit_ns)}, worst ${nsText(check.worst_value_ns)}, margin ${nsText(check.worst_margin_ns)}`,
          `at ${momentText(check.at_ns * TICKS_PER_NS)} at ${check.slave}; ${check.clause}`].join("\n");
}

function drawMargins(svg, width, checks) {
  const left = Math.min(CHECK_LEFT, width * 0.36), right = width - (width < 700 ? 90 : CHECK_RIGHT), bottom = 20 + checks.length * ROW;
  setHeight(svg, width, bottom + 30);
  const least = Math.min(-10, d3.min(checks, each => each.worst_margin_ns));
  const x = d3.scaleSymlog().constant(1).domain([least, FARTHEST]).range([left, right]).clamp(true);
  svg.append("rect").attr("class", "violated").attr("x", left).attr("width", x(0) - left).attr("y", 14).attr("height", bottom - 14);
  svg.append("text").attr("class", "small").attr("x", x(0) + 4).attr("y", 10).text("kept →");
  svg.append("text").attr("class", "small").attr("x", x(0) - 4).attr("y", 10).attr("text-anchor", "end").text("← violated");
  const rows = svg.selectAll("g.margin").data(checks).join("g").attr("class", each => "margin" + (each.worst_margin_ns < 0 ? " bad" : ""))
    .attr("transform", (_, row) => `translate(0,${18 + row * ROW})`).attr("data-id", each => each.id).attr("data-margin", each => each.worst_margin_ns);
  const room = Math.floor((left - 12) / 6.6);
  rows.append("a").attr("href", each => "#code-" + each.id).append("text").attr("class", "label").attr("x", left - 10).attr("y", ROW / 2 + 3)
    .text(each => each.id.length > room ? "…" + each.id.slice(-room + 1) : each.id);
  rows.append("line").attr("class", "rule").attr("x1", left).attr("x2", right).attr("y1", ROW).attr("y2", ROW);
  rows.each(function (check) {
    const begin = each => each.from_ns === null ? check.worst_margin_ns : each.from_ns;  // violations are one part
    const most = d3.max(check.histogram, each => each.count);
    d3.select(this).selectAll("rect").data(check.histogram).join("rect").attr("class", "strip").attr("y", 5).attr("height", ROW - 10)
      .attr("x", each => x(begin(each))).attr("width", each => Math.max(2, x(each.to_ns === null ? FARTHEST : each.to_ns) - x(begin(each))))
      .attr("fill-opacity", each => 0.2 + 0.6 * Math.log(1 + each.count) / Math.log(1 + most));
  });
  rows.append("path").attr("class", "worst").attr("d", `M0,2 L0,${ROW - 2}`).attr("transform", each => `translate(${x(each.worst_margin_ns)},0)`);
  rows.append("text").attr("class", "value").attr("x", right + 8).attr("y", ROW / 2 + 3).text(each => nsText(each.worst_margin_ns));
  hinted(rows, marginHint);
  svg.append("line").attr("class", "zero").attr("x1", x(0)).attr("x2", x(0)).attr("y1", 14).attr("y2", bottom);
  const marks = [1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];
  const values = [...marks.filter(each => each <= -least).map(each => -each).reverse(), 0, ...marks];
  const axis = d3.axisBottom(x).tickValues(thinned(values, x)).tickFormat(each => nsText(each));
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${bottom})`).call(axis);
}

// Those that stand far enough apart to be read; 0 always.
function thinned(values, x) {
  const kept = [0];
  for (const each of values.slice().sort((a, b) => Math.abs(a) - Math.abs(b)))
    if (kept.every(other => Math.abs(x(other) - x(each)) > 52)) kept.push(each);
  return kept.sort((a, b) => a - b);
}

function margins(parent, checks) {
  const shown = checks.filter(hasMargin);
  if (shown.length) picture(parent, "margins", (svg, width) => drawMargins(svg, width, shown));
}
