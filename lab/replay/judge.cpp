#include "lab/replay/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus/baud.hpp"
#include "bus/telegram/explain.hpp"
#include "lab/replay/services.hpp"

namespace dsdpv1::tb::replay {
namespace {

constexpr std::size_t kHeadOfSd2 = 4;

bus::Telegram telegram_of(const bus::Bytes& bytes) { return bus::decode(bytes).telegram; }

bool is_acyclic(const bus::Telegram& request) { return request.dsap && *request.dsap <= bus::sap::kMs1; }

/// The first byte that differs; with different lengths the end of the shorter one.
std::size_t first_difference(const bus::Bytes& a, const bus::Bytes& b) {
  const std::size_t both = std::min(a.size(), b.size());
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(both), b.begin()).first - a.begin());
}

std::string meaning_of(const bus::Bytes& bytes, std::size_t at, std::optional<bool> dpv1) {
  const std::vector<bus::ExplainedByte> words = bus::explain_bytes(bus::decode(bytes), dpv1);
  return at < words.size() ? words[at].meaning : "behind its end";
}

}  // namespace

Judge::Judge(const Recording& recording, const Firmware& firmware, const std::vector<Supply>& supplies,
             const JudgeOptions& options)
    : recording_(recording),
      firmware_(firmware),
      supplies_(supplies),
      options_(options),
      beginning_(beginning_of(recording)),
      min_tsdr_(recording.baud) {
  if (options.started) beginning_.comparable = beginning_.first_answer;
  supplied_.now = supplied_.before = firmware.inputs;
  old_faults_ = kCfgFault | kNotSupported | kPrmFault;
}

std::vector<RequestResult> Judge::judge(const Listener& listener) {
  std::vector<RequestResult> results;
  results.reserve(recording_.requests.size());
  for (std::size_t i = 0; i < recording_.requests.size(); ++i) {
    const RecordedRequest& request = recording_.requests[i];
    const Heard* heard = listener.of(request.telegram);
    results.push_back(result_of(request, heard));
    request_end_ = recording_.request(request).end;
    follow_supplies(request_end_);
    min_tsdr_.take(recording_.request(request).decoded.telegram, recording_.answer(request));
    follow_dpv1(results.back());
    results.back().verdict = verdict(i, results.back(), heard);
    follow_set_up(results.back());
  }
  return results;
}

RequestResult Judge::result_of(const RecordedRequest& request, const Heard* heard) const {
  const RecordedTelegram& telegram = recording_.request(request);
  RequestResult result;
  result.telegram = request.telegram;
  result.start = telegram.start;
  result.request = telegram.bytes;
  result.service = bus::explain_service(telegram.decoded.telegram);
  if (result.service.empty()) result.service = "FDL status";
  if (const RecordedTelegram* answer = recording_.answer(request))
    result.recorded =
        Answer{answer->start, answer->start - telegram.end, telegram.baud, answer->right(), answer->bytes};
  if (heard != nullptr) result.model = heard->answer;
  return result;
}

Verdict Judge::verdict(std::size_t index, RequestResult& result, const Heard* heard) {
  if (index < beginning_.first_answer || recording_.requests[index].searching) return Verdict::kBeforeFirstAnswer;
  if (index < beginning_.comparable) return Verdict::kNotParameterised;
  if (heard == nullptr || !heard->whole) return Verdict::kDisturbed;
  if (!heard->has_rate) return Verdict::kNoRate;
  if (capture_ends_after(recording_.requests[index])) return Verdict::kCaptureEnds;
  if (slave_restarts()) return Verdict::kRestart;
  const Verdict found = compare(result);
  return options_.from && result.start < *options_.from ? Verdict::kBeforeWindow : found;
}

bool Judge::capture_ends_after(const RecordedRequest& request) const {
  const std::size_t last = recording_.telegrams.size() - 1;
  const RecordedTelegram* answer = recording_.answer(request);
  return answer == nullptr ? request.telegram == last : *request.answer == last && !answer->right();
}

Verdict Judge::compare(RequestResult& result) {
  if (!result.recorded && !result.model) return Verdict::kBothSilent;
  if (!result.model) {
    result.why = "the model does not answer";
    return Verdict::kMissing;
  }
  if (!result.recorded) {
    result.why = "only the model answers";
    return Verdict::kUnexpected;
  }
  const Verdict bytes = compare_bytes(result);
  return bytes == Verdict::kEqual ? compare_tsdr(result) : bytes;
}

Verdict Judge::compare_bytes(RequestResult& result) {
  const bool users_dpv1 = is_users_dpv1(result);
  const bool equal = result.recorded->bytes == result.model->bytes && result.recorded->right == result.model->right;
  if (equal) return Verdict::kEqual;
  if (users_dpv1) return Verdict::kUserDpv1;
  if (only_old_faults_differ(result)) return Verdict::kOldFault;
  if (user_was_late(result)) return Verdict::kUserLate;
  result.why = difference_words(result);
  return Verdict::kBytes;
}

Verdict Judge::compare_tsdr(RequestResult& result) const {
  const double recorded = result.recorded->tsdr_bits(), model = result.model->tsdr_bits();
  const bus::Baud& rate = bus::baud(result.recorded->baud);
  const double resolution = static_cast<double>(recording_.resolution) / static_cast<double>(rate.bit);
  const double unsure = std::max(2 * resolution, 0.5);  // both ends of a recorded time
  if (options_.tsdr.tolerance_bits) {
    if (std::abs(recorded - model) <= *options_.tsdr.tolerance_bits) return Verdict::kEqual;
    result.why = fmt::format("TSDR: recorded {:.2f} bit times, model {:.2f}, expected at most {:g} apart", recorded,
                             model, *options_.tsdr.tolerance_bits);
    return Verdict::kTsdr;
  }
  const int max_tsdr = rate.max_tsdr_bits, min_tsdr = std::min(min_tsdr_.least(), max_tsdr);
  const auto right = [&](double tsdr) { return tsdr >= min_tsdr - unsure && tsdr <= max_tsdr + unsure; };
  if (right(recorded) && right(model)) return Verdict::kEqual;
  result.why = fmt::format("TSDR: recorded {:.2f} bit times, model {:.2f}, expected min_TSDR {} to max_TSDR {}",
                           recorded, model, min_tsdr, max_tsdr);
  return Verdict::kTsdr;
}

/// Between a restart of the recorded slave and its next data exchange; the model does not restart.
bool Judge::slave_restarts() const {
  return std::any_of(
      firmware_.restarts.begin(), firmware_.restarts.end(),
      [this](const Restart& restart) { return request_end_ > restart.from && request_end_ < restart.until; });
}

/// True when the model's answer is right for a user CPU that has not yet delivered the new data.
bool Judge::user_was_late(const RequestResult& result) const {
  if (!result.recorded->right || !result.model->right) return false;
  constexpr Tick kDriver = 60 * bus::kTicksPerUs;
  const Tick time = 2 * options_.user_cycle + kDriver;
  const auto is_news = [&](const std::optional<Tick>& at) { return at && request_end_ - *at < time; };
  if (is_news(supplied_.verdict)) return true;
  if (!options_.supplied) return false;
  const bus::Telegram recorded = telegram_of(result.recorded->bytes), model = telegram_of(result.model->bytes);
  if (result.service == "Slave_Diag") {
    bus::Bytes bytes = model.data;
    if (bytes.empty() || recorded.data.empty()) return false;
    bytes[0] = static_cast<std::uint8_t>((bytes[0] & ~kStationNotReady) | (recorded.data[0] & kStationNotReady));
    return bytes == recorded.data && model.fc == recorded.fc;  // it judges in its own time
  }
  if (result.service == "Set_Prm" || result.service == "Chk_Cfg")
    return judging_ && refused(recorded) != refused(model);  // RR or RS until the blocks before are judged
  if (result.service != "Data_Exchange" && result.service != "Read_Inputs") return false;
  if (recorded.data != model.data && !(is_news(supplied_.inputs) && model.data == supplied_.before)) return false;
  return recorded.fc == model.fc || is_news(supplied_.diagnosis);
}

/// A fault stays until the next Set_Prm or Chk_Cfg (S6, S17); the model has not seen the one before the capture.
bool Judge::only_old_faults_differ(const RequestResult& result) const {
  if (result.service != "Slave_Diag" || !result.recorded->right || !result.model->right) return false;
  const bus::Telegram recorded = telegram_of(result.recorded->bytes);
  bus::Telegram model = telegram_of(result.model->bytes);
  if (model.data.empty() || recorded.data.empty()) return false;
  model.data[0] = static_cast<std::uint8_t>((model.data[0] & ~old_faults_) | (recorded.data[0] & old_faults_));
  return model == recorded;
}

void Judge::follow_set_up(const RequestResult& result) {
  if (result.service == "Set_Prm") old_faults_ &= static_cast<std::uint8_t>(~(kPrmFault | kNotSupported));
  if (result.service == "Set_Prm" && result.recorded && !refused(telegram_of(result.recorded->bytes))) judging_ = true;
  if (result.service == "Data_Exchange" && result.recorded && result.recorded->right)
    judging_ = refused(telegram_of(result.recorded->bytes)) && judging_;
  if (result.service == "Chk_Cfg") old_faults_ &= static_cast<std::uint8_t>(~kCfgFault);
}

/// DPV1: the user CPU decides when an answer is ready and why a request is refused. Once an answer came at another
/// poll, the later exchanges differ, and the objects may have other content.
bool Judge::is_users_dpv1(const RequestResult& result) {
  if (!is_acyclic(telegram_of(result.request)) || !result.recorded || !result.model) return false;
  const auto has_data = [](const Answer& answer) {
    const bool cut_off = !answer.right && answer.bytes.front() == bus::sd::k2;
    return cut_off || !telegram_of(answer.bytes).data.empty();
  };
  const bus::Bytes recorded = telegram_of(result.recorded->bytes).data;
  if (has_data(*result.recorded) != has_data(*result.model)) dpv1_out_of_step_ = true;
  const auto refuses = [](const bus::Bytes& data) { return !data.empty() && (data[0] & 0x80U) != 0; };
  return dpv1_out_of_step_ || refuses(recorded);
}

void Judge::follow_supplies(Tick until) {
  for (; next_supply_ < supplies_.size() && supplies_[next_supply_].at < until; ++next_supply_) {
    const Supply& supply = supplies_[next_supply_];
    if (const auto* inputs = std::get_if<user_cpu::command::SetInputs>(&supply.command)) {
      supplied_.before = supplied_.now;
      supplied_.now = inputs->bytes;
      supplied_.inputs = supply.at;
    } else if (std::holds_alternative<user_cpu::command::SetDiagnosis>(supply.command)) {
      supplied_.diagnosis = supply.at;
    } else {
      supplied_.verdict = supply.at;
    }
  }
}

/// From the answer to a Set_Prm on.
void Judge::follow_dpv1(const RequestResult& result) {
  if (result.service != "Set_Prm") return;
  if (const auto dpv1 = bus::dpv1_enabled(telegram_of(result.request))) dpv1_ = dpv1;
}

std::string Judge::difference_words(const RequestResult& result) const {
  const bus::Bytes& recorded = result.recorded->bytes;
  const bus::Bytes& model = result.model->bytes;
  std::size_t at = first_difference(recorded, model);
  if (at == recorded.size() && at == model.size()) return "the same bytes, but with wrong characters";
  if (at == recorded.size() || at == model.size())
    return fmt::format("length: recorded {} bytes, model {}", recorded.size(), model.size());
  if (at == 1 && recorded[0] == bus::sd::k2 && recorded.size() > kHeadOfSd2)
    return fmt::format("length: recorded {} bytes, model {}", recorded.size(), model.size());
  const std::string words = meaning_of(recorded, at, dpv1_), others = meaning_of(model, at, dpv1_);
  return fmt::format("byte {}: recorded {:02X} ({}), model {:02X} ({})", at, recorded[at], words, model[at], others);
}

}  // namespace dsdpv1::tb::replay
