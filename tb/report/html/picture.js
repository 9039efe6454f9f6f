// Shared by all pictures: a drawing as wide as its place, zoom along time, a hint at the pointer.

// A picture in `parent`: draw(svg, width) is called now and whenever its place has another width.
function picture(parent, name, draw) {
  const svg = parent.append("svg").attr("class", name).attr("role", "img");
  let width = 0;
  const redraw = () => {
    const now = Math.max(300, Math.floor(parent.node().clientWidth));
    if (now === width) return;
    width = now;
    svg.selectAll("*").remove();
    draw(svg.attr("width", width), width);
  };
  redraw();
  new ResizeObserver(redraw).observe(parent.node());
  return svg;
}

function setHeight(svg, width, height) {
  svg.attr("height", height).attr("viewBox", `0 0 ${width} ${height}`);
}

function showHint(text) {
  const hint = document.getElementById("hint");
  hint.textContent = text;
  hint.hidden = false;
  const x = Math.min(d3.event.clientX + 14, innerWidth - hint.offsetWidth - 8);
  const y = Math.min(d3.event.clientY + 16, innerHeight - hint.offsetHeight - 8);
  hint.style.left = Math.max(4, x) + "px";
  hint.style.top = Math.max(4, y) + "px";
}

function hideHint() {
  document.getElementById("hint").hidden = true;
}

// textOf(datum) appears beside the pointer.
function hinted(selection, textOf) {
  return selection.on("mousemove.hint", each => showHint(textOf(each))).on("mouseleave.hint", hideHint);
}

// About so many pixels a text of this length has.
function textWidth(text) {
  return text.length * 6.4;
}

// Zoom and shift of a time axis by wheel (with Ctrl, or once the picture has the focus, so that the page still scrolls),
// by dragging, by keys and by buttons. `redraw(scale)` draws what the scale shows.
function zoomable(parent, svg, scale, most, redraw) {
  const [left, right] = scale.range();
  const zoom = d3.zoom()
    .scaleExtent([1, most])
    .extent([[left, 0], [right, 10]])
    .translateExtent([[left, 0], [right, 10]])
    .filter(() => !d3.event.button && (d3.event.type !== "wheel" || d3.event.ctrlKey || document.activeElement === svg.node()))
    .on("zoom", () => redraw(d3.event.transform.rescaleX(scale)));
  svg.attr("tabindex", 0).call(zoom).on("dblclick.zoom", null);
  const by = factor => svg.call(zoom.scaleBy, factor);
  const keys = {"+": () => by(2), "-": () => by(0.5), "0": () => svg.call(zoom.transform, d3.zoomIdentity),
                ArrowLeft: () => svg.call(zoom.translateBy, 80 / d3.zoomTransform(svg.node()).k, 0),
                ArrowRight: () => svg.call(zoom.translateBy, -80 / d3.zoomTransform(svg.node()).k, 0)};
  svg.on("keydown", () => {
    if (!keys[d3.event.key]) return;
    d3.event.preventDefault();
    keys[d3.event.key]();
  });
  parent.selectAll(".buttons").remove();
  const buttons = parent.insert("div", ":first-child").attr("class", "buttons");
  for (const [key, label] of [["+", "zoom in"], ["-", "zoom out"], ["0", "all"]])
    buttons.append("button").attr("type", "button").attr("title", `${label} (key ${key})`).text(key === "0" ? "all" : key === "-" ? "−" : key)
      .on("click", keys[key]);
  return {
    // Shows from..to of the time.
    show(from, to) {
      const k = Math.min(most, (right - left) / Math.max(1e-9, scale(to) - scale(from)));
      svg.call(zoom.transform, d3.zoomIdentity.scale(k).translate(left / k - scale(from), 0));
    },
  };
}

// Ticks at round numbers of the unit that fits the part shown.
function timeAxis(scale, width) {
  const [from, to] = scale.domain();
  const [unit, name] = unitOf(Math.max(Math.abs(from), Math.abs(to)));
  const count = Math.max(2, Math.floor(width / 130));
  const ticks = d3.ticks(from / unit, to / unit, count);
  const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return d3.axisBottom(scale).tickValues(ticks.map(each => each * unit)).tickFormat(each => (each / unit).toFixed(digits) + " " + name);
}
