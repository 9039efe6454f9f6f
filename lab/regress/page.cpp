#include "lab/regress/page.hpp"

#include <fmt/format.h>

#include "bus/printable.hpp"
#include "tb/report/markup.hpp"

namespace dsdpv1::tb::regress {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="UTF-8">
<meta name="viewport" content="width=device-width">
<title>dsdpv1-sim regress</title>
<style>
:root { color-scheme: light dark; --line: #8884; --bad: #c0392b; --good: #1e8449 }
body { font: 15px/1.4 system-ui, sans-serif; margin: 1.5rem }
h1 { font-size: 1.25rem }
h2 { font-size: 1.1rem; margin-top: 2rem }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; vertical-align: top; padding: .3rem .7rem .3rem 0; border-bottom: 1px solid var(--line) }
th { cursor: pointer; position: sticky; top: 0; background: Canvas; white-space: nowrap }
th[aria-sort=ascending]::after { content: " \25B2" }
th[aria-sort=descending]::after { content: " \25BC" }
td.number { text-align: right; font-variant-numeric: tabular-nums }
.verdict { font-weight: 600; color: var(--bad) }
.verdict.passed { color: var(--good) }
.verdict.not_run { color: inherit; font-weight: normal }
pre { margin: .3rem 0; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .85rem }
input { font: inherit; padding: .2rem .4rem; width: 20rem }
</style>
</head>
<body>
)";

constexpr const char* kTail = R"(<script>
const body = document.querySelector("tbody"), heads = [...body.parentNode.querySelectorAll("th")];
const key = (row, column) => row.cells[column].dataset.key ?? row.cells[column].textContent;
heads.forEach((head, column) => head.onclick = () => {
  const down = head.getAttribute("aria-sort") === "ascending";
  heads.forEach(each => each.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", down ? "descending" : "ascending");
  const rows = [...body.rows];
  rows.sort((a, b) => key(a, column).localeCompare(key(b, column), "en", {numeric: true}));
  body.append(...(down ? rows.reverse() : rows));
});
document.querySelector("input").oninput = event => {
  const words = event.target.value.toLowerCase().split(" ");
  for (const row of body.rows) row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word));
};
</script>
</body>
</html>
)";

std::string escaped(const std::string& text) { return markup_escaped(bus::printable_lines(text)); }

std::string cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }

/// The reason, and on demand the run's last output and its command.
std::string reason_cell(const Outcome& outcome, const std::string& again) {
  std::string text = "<td>" + escaped(outcome.reason);
  for (const auto& [what, lines] : {std::pair{"output", outcome.output}, std::pair{"end of the log", outcome.log},
                                    std::pair{"again", outcome.passed() || !outcome.was_run() ? "" : again}})
    if (!lines.empty())
      text += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>", what, escaped(lines));
  return text + "</td>";
}

/// Names of these files and folders are plain characters, the program has made them.
std::string files_cell(const Run& run, const Outcome& outcome) {
  std::string links;
  for (const std::string& file : outcome.files)
    links += fmt::format("{}<a href=\"runs/{}/{}\">{}</a>", links.empty() ? "" : " ", run.file_name(), escaped(file),
                         escaped(file));
  return "<td>" + links + "</td>";
}

std::string settings_text(const Run& run) {
  std::string text = run.mode + (run.mode.empty() || run.seed.empty() ? "" : " ");
  if (!run.seed.empty()) text += "seed=" + run.seed;
  for (const auto* words : {&run.options, &run.settings})
    for (const std::string& word : *words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string row(const Report& report, const Run& run, const Outcome& outcome) {
  const char* const verdict = name(outcome.verdict);
  return fmt::format("<tr><td class=\"verdict {0}\">{0}</td>", verdict) + cell(run.scenario) + cell(run.engine) +
         cell(run.view) + cell(settings_text(run)) +
         fmt::format(R"(<td class="number" data-key="{0:.3f}">{0:.2f}</td>)", outcome.seconds) +
         reason_cell(outcome, report.again(run, outcome)) + files_cell(run, outcome) + "</tr>\n";
}

/// What all runs have in common: the RTL, the versions.
std::string facts(const Description& description) {
  std::string text = "dsdpv1-sim " + description.program;
  const OwnRtl& rtl = description.rtl;
  if (rtl.folder.empty()) return text;
  text += fmt::format("; {}; {} of {} as a {}", rtl.verilator, rtl.top, rtl.folder, rtl.chip);
  if (!rtl.pins.empty()) text += ", pins " + rtl.pins;
  for (const auto& pin : rtl.tolerance.items())
    text += fmt::format(", {} within {} cycles", pin.key(), pin.value().get<int>());
  return text;
}

}  // namespace

std::string page(const Report& report) {
  std::string text = kHead;
  text += "<h1>" + escaped(summary(report)) + "</h1>\n<p>" + escaped(facts(report.description)) + "</p>\n";
  text +=
      "<p><input type=\"search\" placeholder=\"filter: words of a row\" "
      "aria-label=\"filter\"></p>\n<table>\n<thead><tr>";
  for (const char* head : {"verdict", "scenario", "engine", "view", "settings", "time / s", "reason", "files"})
    text += fmt::format("<th scope=\"col\">{}</th>", head);
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < report.outcomes.size(); ++i) text += row(report, report.runs()[i], report.outcomes[i]);
  return text + "</tbody>\n</table>\n" + report.more + kTail;
}

}  // namespace dsdpv1::tb::regress
