#include "cosim/random/ruling_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <regex>
#include <sstream>

#include "bus/printable.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/random_cases.hpp"
#include "io/input/read_file.hpp"
#include "tb/bench/ruling_place.hpp"
#include "tb/report/markup.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr tb::FileKind kRulings{"a document of rulings", 16};

std::string event_name(const std::string& code) { return "event " + code; }

/// Its first words.
std::string title_of(const std::string& text) {
  constexpr std::size_t kMost = 90;
  if (text.size() <= kMost) return text;
  return text.substr(0, text.rfind(' ', kMost)) + " ...";
}

std::string not_seen(const RulingCoverage::Ruling& ruling, const char* separator) {
  std::string text;
  for (const auto& [item, count] : ruling.items)
    if (count == 0) text += (text.empty() ? "" : separator) + item;
  return text;
}

const char* word_of(const RulingCoverage::Ruling& ruling) {
  if (ruling.items.empty()) return ruling.pins.empty() ? "nothing shows it" : "by pins alone";
  return ruling.count() == 0 ? "never" : "exercised";
}

std::string escaped(const std::string& text) { return tb::markup_escaped(bus::printable_lines(text)); }

std::string details(const char* summary, const std::string& text) {
  if (text.empty()) return {};
  return fmt::format("<details><summary>{}</summary><pre>{}</pre></details>", summary, escaped(text));
}

}  // namespace

std::uint64_t RulingCoverage::Ruling::count() const {
  std::uint64_t sum = 0;
  for (const auto& each : items) sum += each.second;
  return sum;
}

RulingCoverage::RulingCoverage(const tb::ChipKind& kind, const std::vector<std::string>& documents) : kind_(kind) {
  for (const std::string& document : documents) read(document);
  for (const profibus::Reason reason : kind.reasons()) sources_[profibus::code(reason)] = reason.row().source;
  for (const HostPort& port : kind.random()->words().ports) {
    PlayOptions options = usual_options(kind);
    set_parameters(options, port.set);
    ports_[port.word] = options.chip;
  }
  add_known();
}

/// "- **S3**<a id="s3"></a> [documented in part] A request counts only ..."
void RulingCoverage::read(const std::string& document) {
  static const std::regex kBegin(R"(- \*\*([A-Z]+[0-9]+)\*\*<a id="[a-z0-9]+"></a> \[[^\]]*\] (.*))");
  std::istringstream text(tb::read_file(document, kRulings));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::smatch found;
    if (!std::regex_match(line, found, kBegin)) continue;
    places_[found[1]] = rulings_.size();
    rulings_.push_back({found[1], title_of(found[2]), document, number});
  }
}

void RulingCoverage::add_known() {
  for (const auto& [mode, chip] : ports_)
    for (const Situation& each : kind_.random()->known_situations(*chip)) {
      const std::string code = each.second.substr(0, each.second.find(' '));
      count(rulings_of(each, mode), each.first == "events" ? event_name(code) : each.first + ": " + each.second, 0,
            nullptr);
    }
  for (const tb::PinInfo& pin : kind_.pins())
    for (const std::string& name : tb::names_of(pin.rulings))
      if (const auto place = places_.find(name); place != places_.end()) {
        std::string& pins = rulings_[place->second].pins;
        pins += (pins.empty() ? "" : ", ") + std::string(pin.name);
      }
}

std::string RulingCoverage::rulings_of(const Situation& situation, const std::string& mode) const {
  const auto port = ports_.find(mode.empty() ? kind_.random()->words().ports.front().word : mode);
  return port == ports_.end() ? "" : kind_.random()->rulings_of(situation, *port->second);
}

/// `names`: rulings, and clauses, which are of no document here.
void RulingCoverage::count(const std::string& names, const std::string& item, std::uint64_t times,
                           const std::size_t* run) {
  for (const std::string& name : tb::names_of(names)) {
    const auto place = places_.find(name);
    if (place == places_.end()) continue;
    rulings_[place->second].items[item] += times;
    if (times != 0 && run != nullptr) rulings_[place->second].runs.insert(*run);
  }
}

void RulingCoverage::add(std::size_t run, const Seen& seen) {
  const bool has_states = !seen.situations.counts().empty();  // which say from where to where
  const std::string state = profibus::code(profibus::Reason::kDpState);
  for (const auto& [code, times] : seen.codes)
    if (const auto source = sources_.find(code);
        source != sources_.end() && times != 0 && !(has_states && code == state))
      count(source->second, event_name(code), times, &run);
  for (const auto& [situation, times] : seen.situations.counts())
    if (situation.first != "events" && times != 0)
      count(rulings_of(situation, seen.mode), situation.first + ": " + situation.second, times, &run);
}

tb::coverage::Files RulingCoverage::files() const {
  tb::coverage::Files files;
  for (const Ruling& ruling : rulings_) {
    if (ruling.items.empty()) continue;
    tb::coverage::Reached& file = files[std::filesystem::absolute(ruling.document).lexically_normal().string()];
    file.lines[ruling.line] = ruling.count();
    for (const auto& [item, times] : ruling.items) {
      std::string name = item;
      std::replace(name.begin(), name.end(), ',', ';');  // it ends a name in a tracefile
      file.points[{ruling.line, name}] = times;
    }
  }
  return files;
}

std::string summary(const RulingCoverage& coverage) {
  std::size_t exercised = 0, counted = 0;
  for (const RulingCoverage::Ruling& ruling : coverage.rulings()) {
    counted += ruling.items.empty() ? 0 : 1;
    exercised += ruling.count() != 0 ? 1 : 0;
  }
  return fmt::format("{} of {} rulings with events or situations were exercised; {} of {} have none", exercised,
                     counted, coverage.rulings().size() - counted, coverage.rulings().size());
}

std::string tsv(const RulingCoverage& coverage) {
  std::string text = "ruling\tplace\texercised\tcount\truns\titems seen\titems\toutput pins\ttitle\tnot seen\n";
  for (const RulingCoverage::Ruling& each : coverage.rulings())
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", each.name, tb::ruling_place(each.name),
                        word_of(each), each.count(), each.runs.size(), tb::coverage::reached_of(each.items),
                        each.items.size(), each.pins, bus::printable(each.title), not_seen(each, "; "));
  return text;
}

std::string html(const RulingCoverage& coverage, const std::vector<std::string>& runs) {
  std::string text = "<h2>Rulings: " + escaped(summary(coverage)) + "</h2>\n<table>\n<thead><tr>";
  for (const char* head : {"ruling", "exercised", "count", "runs", "seen"})
    text += fmt::format("<th scope=\"col\">{}</th>", head);
  text += "</tr></thead>\n<tbody>\n";
  for (const RulingCoverage::Ruling& each : coverage.rulings()) {
    std::string names;
    for (const std::size_t run : each.runs) names += runs.at(run) + "\n";
    text += fmt::format("<tr><td>{} {}</td><td>{}{}</td><td>{}</td><td>{}{}</td><td>{} of {}{}</td></tr>\n", each.name,
                        escaped(each.title), word_of(each), each.items.empty() ? " " + each.pins : "", each.count(),
                        each.runs.size(), details("which", names), tb::coverage::reached_of(each.items),
                        each.items.size(), details("not seen", not_seen(each, "\n")));
  }
  return text + "</tbody>\n</table>\n";
}

}  // namespace dsdpv1::cosim
