#include "lab/replay/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain.hpp"
#include "bus/time_text.hpp"
#include "io/input/units.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb::replay {
namespace {

constexpr std::size_t kMostBytes = 32;
constexpr const char* kStarted =
    ", with a Set_Prm and Chk_Cfg of its own: the capture begins in the middle of a data exchange";

std::string line(const std::string& heading, const std::string& what) {
  return fmt::format("{:<17} {}\n", heading, what);
}

/// "12M", "12M and 1.5M".
std::string rates_text(const Result& result) {
  std::string text;
  for (const int baud : result.bauds) text += (text.empty() ? "" : " and ") + std::string(bus::baud(baud).name);
  return text;
}

std::string in_words(const bus::Bytes& bytes) {
  const bus::Decoded decoded = bus::decode(bytes);
  const std::string words = decoded.error == bus::DecodeError::kNone
                                ? bus::explain_line(decoded.telegram)
                                : fmt::format("wrong telegram, {}", bus::describe(decoded.error));
  return fmt::format("{} ({})", words, bytes_text(bytes, kMostBytes));
}

std::string answer_text(const std::optional<Answer>& answer) {
  if (!answer) return "no answer";
  return fmt::format("{}, TSDR {:.2f} bit times", in_words(answer->bytes), answer->tsdr_bits());
}

// --- TSDR ------------------------------------------------------------------------------------------------------------

/// Bit times.
struct Spread {
  double min = 0, median = 0, max = 0;
};

/// TSDR of the compared requests that both have answered; absent without one.
template <class Side>
std::optional<Spread> spread_of(const Result& result, const Side& side) {
  std::vector<double> times;
  for (const RequestResult& each : result.requests)
    if (is_compared(each.verdict) && each.recorded && each.model) times.push_back(side(each).tsdr_bits());
  if (times.empty()) return std::nullopt;
  std::sort(times.begin(), times.end());
  return Spread{times.front(), times[times.size() / 2], times.back()};
}

std::optional<Spread> recorded_spread(const Result& result) {
  return spread_of(
      result, [](const RequestResult& each) -> const Answer& { return *each.recorded; });
}

std::optional<Spread> model_spread(const Result& result) {
  return spread_of(
      result, [](const RequestResult& each) -> const Answer& { return *each.model; });
}

std::string spread_text(const std::optional<Spread>& spread) {
  if (!spread) return "-";
  return fmt::format("{:.2f} / {:.2f} / {:.2f}", spread->min, spread->median, spread->max);
}

std::string rule_text(const Result& result) {
  if (result.rule.tolerance_bits) return fmt::format("at most {:g} bit times apart", *result.rule.tolerance_bits);
  std::string most;
  for (const int baud : result.bauds)
    most += fmt::format("{}{}", most.empty() ? "" : " and ", bus::baud(baud).max_tsdr_bits);
  return fmt::format("both from min_TSDR to max_TSDR, {} bit times", most);
}

// --- tables ----------------------------------------------------------------------------------------------------------

/// The counts of one service.
struct Counts {
  std::size_t requests = 0, compared = 0, equal = 0, silent = 0, missing = 0, unexpected = 0, bytes = 0, tsdr = 0;

  void count(Verdict verdict) {
    ++requests;
    compared += is_compared(verdict) ? 1 : 0;
    switch (verdict) {
      case Verdict::kEqual: ++equal; break;
      case Verdict::kBothSilent: ++silent; break;
      case Verdict::kMissing: ++missing; break;
      case Verdict::kUnexpected: ++unexpected; break;
      case Verdict::kBytes: ++bytes; break;
      case Verdict::kTsdr: ++tsdr; break;
      default: break;
    }
  }
  std::vector<std::string> row(const std::string& service) const {
    std::vector<std::string> cells = {service};
    for (const std::size_t each : {requests, compared, equal, silent, missing, unexpected, bytes, tsdr})
      cells.push_back(std::to_string(each));
    return cells;
  }
};

std::string services_table(const Result& result) {
  std::map<std::string, Counts> services;
  Counts all;
  for (const RequestResult& each : result.requests) {
    services[each.service].count(each.verdict);
    all.count(each.verdict);
  }
  TextTable table({"service", "requests", "compared", "equal", "both silent", "missing", "unexpected", "other bytes",
                   "other TSDR"});
  for (const auto& [service, counts] : services) table.add(counts.row(service));
  if (services.size() > 1) table.add(all.row("all"));
  return table.text();
}

/// The reasons why requests were not compared, with their numbers.
std::vector<std::pair<Verdict, std::size_t>> left_aside(const Result& result) {
  std::vector<std::pair<Verdict, std::size_t>> all;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (!is_compared(verdict) && result.count(verdict) != 0) all.emplace_back(verdict, result.count(verdict));
  }
  return all;
}

std::string first_text(const Result& result) {
  if (const RequestResult* first = result.first_difference())
    return line("first difference", fmt::format("at {}, telegram {} of the capture: {}", bus::moment_text(first->start),
                                                first->telegram + 1, first->why)) +
           line("  request", in_words(first->request)) + line("  recorded", answer_text(first->recorded)) +
           line("  model", answer_text(first->model));
  return "";
}

std::string unasked_text(const Result& result) {
  if (result.unasked.empty()) return "";
  const Answer& first = result.unasked.front();
  return line("unasked", fmt::format("the model sent {} telegrams without a request to it, the first at {}: {}",
                                     result.unasked.size(), bus::moment_text(first.start), in_words(first.bytes)));
}

std::string capture_text(const Result& result) {
  std::string text =
      fmt::format("{}: {} telegrams from {} to {} at {}, {}", bus::printable(result.capture), result.telegrams,
                  bus::moment_text(result.begin), bus::moment_text(result.end), rates_text(result), result.form);
  if (result.left_out != 0) text += fmt::format(", {} at other rates left out", result.left_out);
  return text;
}

std::string resolution_text(const Result& result) {
  const double resolution =
      static_cast<double>(result.resolution) / static_cast<double>(bus::baud(result.bauds.front()).bit);
  if (resolution < 0.5) return "";
  return line("times", fmt::format("the capture's are whole multiples of {}, {:.1f} bit times",
                                   time_text(result.resolution), resolution));
}

std::string verdict_text(const Result& result, const RunResult& run) {
  if (result.compared() == 0) return "\nNOTHING JUDGED: nothing could be compared\n";
  if (!result.equal()) return "\nDIFFERENT\n";
  if (tb::verdict(run) == tb::Verdict::kFailed)
    return fmt::format("\nFAILED: equal, but {} violations\n", run.violations);
  return (result.interrupted ? "\nINTERRUPTED, equal so far" : "\nEQUAL") + not_judged(run) + "\n";
}

// --- for programs ----------------------------------------------------------------------------------------------------

double nanoseconds_of(Tick at) { return static_cast<double>(at) / static_cast<double>(bus::kTicksPerNs); }

nlohmann::ordered_json to_json(const std::optional<Answer>& answer) {
  if (!answer) return nullptr;
  return {{"at_ns", nanoseconds_of(answer->start)},
          {"tsdr_bits", answer->tsdr_bits()},
          {"bytes", bytes_text(answer->bytes, answer->bytes.size())}};
}

nlohmann::ordered_json to_json(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"min", spread->min}, {"median", spread->median}, {"max", spread->max}};
}

nlohmann::ordered_json to_json(const RequestResult& request) {
  return {{"telegram", request.telegram + 1},
          {"at_ns", nanoseconds_of(request.start)},
          {"service", request.service},
          {"verdict", name(request.verdict)},
          {"why", request.why},
          {"request", bytes_text(request.request, request.request.size())},
          {"recorded", to_json(request.recorded)},
          {"model", to_json(request.model)}};
}

std::string cells(const std::optional<Answer>& answer) {
  if (!answer) return "\t";
  return fmt::format("{:.3f}\t{}", answer->tsdr_bits(), bytes_text(answer->bytes, answer->bytes.size()));
}

const char* inputs_text(const Result& result) {
  if (!result.inputs_recorded)
    return "those of the scenario's user CPU, without the script; --inputs recorded: the capture's";
  return result.diagnoses_recorded ? "the recorded ones, and the recorded diagnoses"
                                   : "the recorded ones; the program of this chip hands over no diagnoses";
}

}  // namespace

std::string text(const Result& result, const RunResult& run) {
  std::string text = line("capture", capture_text(result));
  text += resolution_text(result);
  text += line("model", result.station);
  text += line("inputs", inputs_text(result));
  text += line("lead-in", bus::moment_text(result.lead_in) + (result.started ? kStarted : ""));
  text += line("TSDR / bit times",
               fmt::format("recorded {}, model {} (min / median / max); {}", spread_text(recorded_spread(result)),
                           spread_text(model_spread(result)), rule_text(result)));
  for (const auto& [verdict, count] : left_aside(result))
    text += line("not compared", fmt::format("{}: {}", count, name(verdict)));
  text += first_text(result) + unasked_text(result);
  text += "\n" + services_table(result);
  return text + verdict_text(result, run);
}

std::string json(const Result& result) {
  nlohmann::ordered_json root;
  root["version"] = 1;
  root["equal"] = result.equal();
  root["interrupted"] = result.interrupted;
  root["capture"] = bus::printable(result.capture);
  root["form"] = result.form;
  root["slave"] = result.slave;
  root["baud"] = bus::baud(result.bauds.front()).name;
  for (const int baud : result.bauds) root["bauds"].push_back(bus::baud(baud).name);
  root["resolution_ns"] = nanoseconds_of(result.resolution);
  root["station"] = result.station;
  root["parameterised_by_lead_in"] = result.started;
  root["lead_in_ns"] = nanoseconds_of(result.lead_in);
  root["compared"] = result.compared();
  for (std::size_t i = 0; i < kVerdicts; ++i)
    root["verdicts"][name(static_cast<Verdict>(i))] = result.count(static_cast<Verdict>(i));
  root["tsdr_bits"]["recorded"] = to_json(recorded_spread(result));
  root["tsdr_bits"]["model"] = to_json(model_spread(result));
  root["first_difference"] =
      result.first_difference() == nullptr ? nlohmann::ordered_json() : to_json(*result.first_difference());
  root["differences"] = nlohmann::ordered_json::array();
  for (const RequestResult& each : result.requests)
    if (is_difference(each.verdict)) root["differences"].push_back(to_json(each));
  root["unasked"] = nlohmann::ordered_json::array();
  for (const Answer& each : result.unasked) root["unasked"].push_back(to_json(std::optional(each)));
  return root.dump(2) + "\n";
}

std::string table(const Result& result) {
  std::string text =
      "telegram\tat_ns\tservice\tverdict\trequest\trecorded_tsdr_bits\trecorded\tmodel_tsdr_bits\tmodel\twhy\n";
  for (const RequestResult& each : result.requests)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", each.telegram + 1, nanoseconds(each.start), each.service,
                        name(each.verdict), bytes_text(each.request, each.request.size()), cells(each.recorded),
                        cells(each.model), each.why);
  return text;
}

}  // namespace dsdpv1::tb::replay
