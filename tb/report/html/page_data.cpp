#include "tb/report/html/page_data.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "io/input/suggest.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb::html {
namespace {

using Json = nlohmann::ordered_json;

Json optional_of(const std::optional<Tick>& tick) { return tick ? Json(*tick) : Json(); }

Json telegrams_of(const TelegramList& list) {
  Json rows = Json::array();
  for (const ListedTelegram& each : list.kept())
    rows.push_back({each.start, each.end, each.lane, static_cast<int>(each.group), each.words, optional_of(each.tsdr)});
  Json groups = Json::array();
  for (std::size_t i = 0; i < kTelegramGroups; ++i) groups.push_back(name(static_cast<TelegramGroup>(i)));
  return {
      {"count", list.count()}, {"groups", groups}, {"lanes", list.lanes()}, {"texts", list.texts()}, {"rows", rows}};
}

Json times_of(const TimesOf& of) {
  const Distribution& times = of.times;
  Json values = Json::array();
  for (const auto& [value, count] : times.values()) values.push_back({value, count});
  return {{"title", of.title},
          {"whose", of.whose},
          {"bit", of.unit},
          {"limits", of.limits},
          {"count", times.count()},
          {"least", times.least()},
          {"greatest", times.greatest()},
          {"mean", times.mean()},
          {"step", times.step()},
          {"values", values}};
}

Json pins_of(const PinTable& pins, const std::vector<PinTrace>& traces) {
  Json list = Json::array();
  for (const PinTrace& trace : traces) {
    const PinInfo& pin = pins[trace.pin];
    Json steps = Json::array();
    for (const PinStep& step : trace.steps) steps.push_back({step.at, level_text(pin, step.level)});
    list.push_back(
        {{"name", pin.name}, {"width", pin.width}, {"first", level_text(pin, trace.first)}, {"steps", steps}});
  }
  return list;
}

/// Null: not a check of the chip.
const checks::Rule* rule_of(const ChipKind& kind, const char* id) {
  for (const checks::Rule& rule : kind.rules())
    if (id != nullptr && std::string(rule.id) == id) return &rule;
  return nullptr;
}

Json span_of(const ChipKind& kind, const DiagramSpan& span, const MeasuredSpan& measured) {
  const checks::Rule* const rule = rule_of(kind, span.check);
  const char* const clause = rule != nullptr ? rule->clause : span.clause;
  return {{"name", span.name},
          {"check", rule != nullptr ? Json(rule->id) : Json()},
          {"clause", clause != nullptr ? Json(clause) : Json()},
          {"exact", span.exact != 0 ? Json(span.exact) : Json()},
          {"from", optional_of(measured.from)},
          {"to", optional_of(measured.to)},
          {"is_tsdr", span.tsdr},
          {"least", optional_of(measured.limits.least)},
          {"greatest", optional_of(measured.limits.greatest)},
          {"margin", optional_of(measured.margin())}};
}

Json diagram_of(const ChipKind& kind, const std::string& slave, const DiagramWatch& watch) {
  const TimingDiagram& diagram = watch.diagram();
  Json json = {{"id", diagram.id}, {"title", diagram.title},         {"text", diagram.text},
               {"slave", slave},   {"instances", watch.instances()}, {"picture", nullptr}};
  if (!watch.worst()) return json;
  const DiagramPicture& worst = *watch.worst();
  Json spans = Json::array();
  for (std::size_t i = 0; i < diagram.spans.size(); ++i)
    spans.push_back(span_of(kind, diagram.spans[i], worst.instance.spans[i]));
  json["picture"] = {{"anchor", worst.instance.anchor},
                     {"from", worst.from},
                     {"to", worst.to},
                     {"spans", spans},
                     {"pins", pins_of(kind.pins(), worst.pins)}};
  return json;
}

Json code_of(const CodeText& each) {
  return {{"code", each.code},
          {"kind", each.severity},
          {"text", each.example.empty() ? each.text : "such as: " + each.example},
          {"advice", each.advice},
          {"page", "reasons.md"}};
}

Json code_of(const checks::Rule& rule) {
  return {{"code", rule.id},
          {"kind", "check"},
          {"text", fmt::format("{} ({})", rule.rule, rule.clause)},
          {"advice", rule.advice},
          {"page", "checks.md"}};
}

/// The meaning of the run's checks and events; the checks first.
Json codes_of(const RunResult& result, const ChipKinds& kinds) {
  std::set<std::string> used;
  for (const CheckResult& each : result.checks) used.insert(each.rule->id);
  for (const Occurrence& each : result.occurrences) used.insert(each.code);
  for (const Repeated& each : result.refused) used.insert(each.code);
  for (const Repeated& each : result.violated) used.insert(each.code);
  Json codes = Json::array();
  std::vector<CodeTable> tables;
  for (const ChipKind* kind : kinds) {
    for (const checks::Rule& rule : kind->rules())
      if (used.erase(rule.id) != 0) codes.push_back(code_of(rule));
    tables.insert(tables.end(), kind->codes().begin(), kind->codes().end());
  }
  tables.push_back({"", "", scenario::flag_codes()});
  tables.push_back({"", "", {scenario::host_code()}});
  for (const CodeTable& table : tables)
    for (const CodeText& each : table.codes)
      if (used.erase(each.code) != 0) codes.push_back(code_of(each));
  return codes;
}

Json violation_of(const scenario::Scenario& scenario, const ViolationPicture& picture) {
  const scenario::Slave& slave = scenario.slaves[picture.slave];
  const checks::Rule& rule = slave.kind->rules()[picture.violation.check.index];
  return {{"slave", slave.name.text},
          {"check", rule.id},
          {"rule", rule.rule},
          {"clause", rule.clause},
          {"advice", rule.advice},
          {"text", with_place(picture.violation.text, picture.violation.where)},
          {"at", picture.violation.at},
          {"found", picture.violation.found},
          {"margin", optional_of(picture.violation.margin)},
          {"from", picture.from},
          {"to", picture.to},
          {"of_rule", picture.of_rule},
          {"pins", pins_of(slave.kind->pins(), picture.pins)}};
}

std::string titles_of(const ChipKinds& kinds) {
  std::vector<std::string> titles;
  for (const ChipKind* kind : kinds) titles.emplace_back(kind->title());
  return join(titles);
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string without_tags(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace

std::string page_data(const RunResult& result, const RunRecorder& recorder, const std::string& version) {
  const scenario::Scenario& scenario = recorder.scenario();
  const ChipKinds kinds = scenario::kinds(scenario);
  Json times = Json::array(), diagrams = Json::array(), violations = Json::array();
  for (const TimesOf* each : recorder.times()) times.push_back(times_of(*each));
  for (std::size_t slave = 0; slave < scenario.slaves.size(); ++slave)
    for (const DiagramWatch& each : recorder.diagrams(slave))
      diagrams.push_back(diagram_of(*scenario.slaves[slave].kind, scenario.slaves[slave].name.text, each));
  for (const ViolationPicture& each : recorder.pictures()) violations.push_back(violation_of(scenario, each));
  const Json json = {{"version", version},
                     {"chip", titles_of(kinds)},
                     {"documents", DSDPV1_DOCUMENTS_URL},
                     {"codes", codes_of(result, kinds)},
                     {"telegrams", telegrams_of(recorder.telegrams())},
                     {"times", times},
                     {"diagrams", diagrams},
                     {"violations", violations},
                     {"not_pictured", recorder.not_pictured()}};
  const std::string own = text_of(json);
  return without_tags(own.substr(0, own.size() - 1) + ",\"result\":" + result_json(result) + "}");
}

}  // namespace dsdpv1::tb::html
