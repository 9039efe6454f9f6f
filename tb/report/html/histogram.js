// How often each duration was seen.
const BINS = 40, PLOT = 130;

// Bit times where it is counted in these, else the unit that fits the longest.
function histogramUnit(times) {
  return times.bit ? [times.bit, "bit times"] : unitOf(times.greatest);
}

// Bins as [{from, to, count}], in the unit. Over two decades they grow.
function binsOf(times, unit) {
  const values = times.values.map(([value, count]) => [value / unit, count]);
  const least = times.least / unit, greatest = times.greatest / unit;
  if (greatest === least) return {scale: d3.scaleLinear().domain([least * 0.98, greatest * 1.02 || 1]), bins: [{from: least, to: least, count: times.count}]};
  const grows = least > 0 && greatest / least > 100;
  const scale = (grows ? d3.scaleLog() : d3.scaleLinear()).domain([least, greatest]).range([0, BINS]);
  const bins = d3.range(BINS).map(bin => ({from: scale.invert(bin), to: scale.invert(bin + 1), count: 0}));
  for (const [value, count] of values) bins[Math.max(0, Math.min(BINS - 1, Math.floor(scale(value))))].count += count;
  return {scale, bins: bins.filter(each => each.count)};
}

// The picture includes the least permitted time, and the greatest if it is in the range.
function withLimit(scale, times, unit) {
  const [least, greatest] = scale.domain();
  if (!times.limits.length || times.limits[0] / unit > least) return scale;
  return scale.domain([times.limits[0] / unit - (greatest - times.limits[0] / unit) / 20, greatest]);
}

function drawLimit(svg, x, limit, top) {
  if (limit < x.domain()[0] || limit > x.domain()[1]) return;
  svg.append("line").attr("class", "limit-line").attr("x1", x(limit)).attr("x2", x(limit)).attr("y1", top).attr("y2", top + PLOT);
  svg.append("text").attr("class", "small").attr("x", x(limit) + 4).attr("y", top + 10).text("limit");
}

function drawHistogram(svg, width, times) {
  const [unit, name] = histogramUnit(times);
  const {scale, bins} = binsOf(times, unit);
  const left = 44, right = width - 16, top = 8;
  setHeight(svg, width, top + PLOT + 40);
  const x = withLimit(scale.copy(), times, unit).range([left, right]);
  const y = d3.scaleSymlog().constant(1).domain([0, d3.max(bins, each => each.count)]).range([top + PLOT, top]);
  const barWidth = each => Math.max(3, x(each.to) - x(each.from) - 1);
  const bars = svg.selectAll("rect.bin").data(bins).join("rect").attr("class", "bin").attr("data-count", each => each.count)
    .attr("x", each => x(each.from)).attr("width", barWidth).attr("y", each => y(each.count)).attr("height", each => top + PLOT - y(each.count));
  const range = each => each.from === each.to ? trimmed(each.from, 3) : `${trimmed(each.from, 3)} to ${trimmed(each.to, 3)}`;
  hinted(bars, each => `${range(each)} ${name}: ${countText(each.count)}`);
  const most = d3.max(bins, each => each.count);
  const powers = d3.range(0, Math.ceil(Math.log10(most + 1)) + 1).map(each => 10 ** each).filter(each => each <= most);
  svg.append("g").attr("class", "axis").attr("transform", `translate(${left},0)`).call(d3.axisLeft(y).tickValues(powers).tickFormat(d3.format("~s")));
  for (const limit of times.limits) drawLimit(svg, x, limit / unit, top);
  const ticks = Math.max(2, Math.floor((right - left) / 70));
  const format = x.tickFormat(ticks, x.base ? "~g" : undefined), withUnit = each => format(each) && format(each) + " " + name;
  const axis = d3.axisBottom(x).ticks(ticks).tickFormat(times.bit ? format : withUnit);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${top + PLOT})`).call(axis);
  if (times.bit) svg.append("text").attr("class", "unit").attr("x", right).attr("y", top + PLOT + 36).attr("text-anchor", "end").text(name);
}

function histogram(parent, times) {
  const figure = parent.append("figure").attr("class", "histogram").attr("data-title", times.title).attr("data-whose", times.whose);
  const [unit, name] = histogramUnit(times);
  const shown = value => times.bit ? `${trimmed(value / unit, 3)}` : timeText(value);
  figure.append("figcaption").text(times.title).append("span").attr("class", "whose").text(times.whose);
  picture(figure, "bins", (svg, width) => drawHistogram(svg, width, times));
  figure.append("p").attr("class", "numbers")
    .text(`${countText(times.count)} times; ${shown(times.least)} to ${shown(times.greatest)}, on average ${shown(times.mean)}${times.bit ? " " + name : ""}`);
}
