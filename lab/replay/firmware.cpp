#include "lab/replay/firmware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "bus/gsd/cfg.hpp"
#include "io/input/input_error.hpp"
#include "lab/replay/services.hpp"
#include "lab/replay/start_up.hpp"
#include "lab/replay/user_verdicts.hpp"

namespace dsdpv1::tb::replay {
namespace {

namespace sap = bus::sap;

constexpr std::uint8_t kUserJudges = 2;  // mode of tables 13 and 14
constexpr std::uint8_t kRead = 0x5E, kWrite = 0x5F, kTransport = 0x51;

int ident_at(const bus::Bytes& bytes, std::size_t at) { return bytes[at] << 8 | bytes[at + 1]; }

// --- initialisation data ---------------------------------------------------------------------------------------------

/// The master's last parameters; in force once data are exchanged.
struct Sent {
  std::optional<bus::Telegram> prm;
  std::optional<bus::Bytes> cfg;
};

class InitReader {
 public:
  void take(const bus::Telegram& request, const RecordedTelegram* answer) {
    if (is_service(request, sap::kSetPrm) && acknowledged(answer) && request.data.size() >= kPrmHead)
      sent_.prm = request;
    if (is_service(request, sap::kChkCfg) && acknowledged(answer)) sent_.cfg = request.data;
    if (exchanged(request, answer) && !in_force_ && sent_.prm) in_force_ = sent_;
    if (is_service(request, sap::kSetPrm)) take_no_room(request.data.size(), right_answer(answer));
    if (is_service(request, sap::kSetSlaveAddress) && acknowledged(answer)) take_address(request.data);
    if (const bus::Telegram* telegram = right_answer(answer)) take_answer(request, *telegram);
    if (const bus::Bytes* diagnosis = diagnosis_of(request, answer)) take_diagnosis(*diagnosis);
  }

  scenario::InitData finish() {
    const Sent& sent = in_force_ ? *in_force_ : sent_;
    if (sent.prm && (in_force_ || !init_.ident)) init_.ident = ident_at(sent.prm->data, 4);
    if (!init_.cfg) init_.cfg = sent.cfg;
    if (sent.prm && bus::dpv1_enabled(*sent.prm).value_or(false)) init_.dpv1 = true;
    use_lengths();
    return std::move(init_);
  }

 private:
  void take_answer(const bus::Telegram& request, const bus::Telegram& answer) {
    take_lengths(request, answer);
    if (is_service(request, sap::kGetCfg) && !answer.data.empty() && !init_.cfg) init_.cfg = answer.data;
    if (request.dsap && *request.dsap <= sap::kMs1 && !refused(answer)) init_.dpv1 = true;
  }
  void take_lengths(const bus::Telegram& request, const bus::Telegram& answer) {
    const auto take = [](int& most, std::size_t size) { most = std::max(most, static_cast<int>(size)); };
    if (is_service(request, sap::kSlaveDiag) && answer.data.size() > kDiagHead)
      take(most_diag_, answer.data.size() - kDiagHead);
    if (is_service(request, sap::kGetCfg)) take(most_cfg_, answer.data.size());
    if (!is_service(request, sap::kChkCfg) || answer.kind != bus::TelegramKind::kSc) return;
    take(most_cfg_, request.data.size());
    const bus::CfgLengths lengths = bus::cfg_lengths(request.data);
    take(most_inputs_, static_cast<std::size_t>(lengths.input));
    take(most_outputs_, static_cast<std::size_t>(lengths.output));
  }
  /// A chip with buffers has no room for the longest blocks of all services.
  void use_lengths() {
    init_.max_diag = most_diag_;
    init_.max_cfg = most_cfg_;
    init_.max_inputs = most_inputs_;
    init_.max_outputs = most_outputs_;
  }
  /// RR: the chip's buffer is shorter. Its user's other reasons show in the diagnosis (S14).
  void take_no_room(std::size_t length, const bus::Telegram* answer) {
    const bool no_room =
        answer != nullptr && answer->kind == bus::TelegramKind::kSd1 && answer->function() == bus::fc::kRr;
    if (no_room && length > kPrmHead)
      init_.max_prm = std::min(init_.max_prm.value_or(0xFF), static_cast<int>(length - kPrmHead) - 1);
  }
  void take_address(const bus::Bytes& data) {
    init_.set_slave_address = true;
    if (!init_.ident && data.size() >= 4) init_.ident = ident_at(data, 1);
  }
  void take_diagnosis(const bus::Bytes& diagnosis) {
    if (!init_.ident) init_.ident = ident_at(diagnosis, 4);
    if ((diagnosis[0] & kCfgFault) != 0) init_.cfg_mode = 1;  // the slave accepts only its configuration
  }

  scenario::InitData init_;
  int most_diag_ = 0, most_cfg_ = 1, most_inputs_ = 0, most_outputs_ = 0;  ///< bytes
  Sent sent_;
  std::optional<Sent> in_force_;
};

// --- objects of DPV1 -------------------------------------------------------------------------------------------------

class ObjectReader {
 public:
  void take(const bus::Telegram& request, const RecordedTelegram* answer) {
    const bus::Telegram* telegram = right_answer(answer);
    if (telegram == nullptr || !request.dsap || *request.dsap > sap::kMs1 || telegram->data.size() < 4) return;
    const bus::Bytes& pdu = telegram->data;
    const bool has_data = pdu[0] == kRead || pdu[0] == kTransport;
    if (!has_data && pdu[0] != kWrite) return;
    scenario::Dpv1Object& object = objects_[{pdu[1], pdu[2]}];
    object.slot = pdu[1];
    object.index = pdu[2];
    object.transport = object.transport || pdu[0] == kTransport;
    if (has_data && read_.insert({pdu[1], pdu[2]}).second) object.data.assign(pdu.begin() + 4, pdu.end());
    if (!has_data && object.data.size() < pdu[3]) object.data.resize(pdu[3]);
  }
  std::vector<scenario::Dpv1Object> finish() {
    std::vector<scenario::Dpv1Object> objects;
    for (auto& [place, object] : objects_) objects.push_back(std::move(object));
    return objects;
  }

 private:
  using Place = std::pair<int, int>;  ///< slot and index
  std::map<Place, scenario::Dpv1Object> objects_;
  std::set<Place> read_;
};

// --- inputs and diagnoses --------------------------------------------------------------------------------------------

class SupplyReader {
 public:
  /// `begin`: of the capture.
  explicit SupplyReader(Tick begin) : before_(begin) {}

  void take(const bus::Telegram& request, const RecordedTelegram* answer) {
    if (const bus::Bytes* inputs = inputs_of(request, answer)) take_inputs(*inputs);
    if (exchanged(request, answer)) take_priority(answer->decoded.telegram);
    if (const bus::Bytes* diagnosis = diagnosis_of(request, answer)) take_diagnosis(*diagnosis);
    if (answer != nullptr) before_ = answer->end;
  }
  std::vector<Supply> finish() { return std::move(supplies_); }
  const std::optional<bus::Bytes>& first_inputs() const { return first_inputs_; }

 private:
  void take_inputs(const bus::Bytes& inputs) {
    if (!first_inputs_)
      first_inputs_ = inputs;
    else if (inputs != inputs_)
      supplies_.push_back({before_, user_cpu::command::SetInputs{inputs}});
    inputs_ = inputs;
  }

  /// The diagnosis was there before the first answer of high priority.
  void take_priority(const bus::Telegram& answer) {
    const bool high = answer.function() == bus::fc::kDh;
    if (high && !high_since_) high_since_ = before_;
    if (!high) high_since_.reset();
  }

  void take_diagnosis(const bus::Bytes& diagnosis) {
    const auto flags = static_cast<std::uint8_t>((diagnosis[0] & kExtDiag) | (diagnosis[1] & kStatDiag));
    bus::Bytes own(diagnosis.begin() + kDiagHead, diagnosis.end());
    const bool news = flags != flags_ || own != own_ || high_since_;
    if (news)
      supplies_.push_back({high_since_.value_or(before_), user_cpu::command::SetDiagnosis{kind_of(flags), own}});
    high_since_.reset();
    flags_ = flags;
    own_ = std::move(own);
  }

  user_cpu::DiagnosisKind kind_of(std::uint8_t flags) const {
    using Kind = user_cpu::DiagnosisKind;
    const auto changed = static_cast<std::uint8_t>(flags ^ flags_);
    if ((changed & kStatDiag) != 0) return (flags & kStatDiag) != 0 ? Kind::kStatic : Kind::kStaticGone;
    if ((flags & kExtDiag) != 0) return Kind::kExternal;
    return (changed & kExtDiag) != 0 || high_since_ ? Kind::kExternalGone : Kind::kExtended;
  }

  std::vector<Supply> supplies_;
  Tick before_;  ///< end of the last answer
  std::optional<bus::Bytes> first_inputs_;
  bus::Bytes inputs_, own_;
  std::uint8_t flags_ = 0;
  std::optional<Tick> high_since_;  ///< end of the answer before those of high priority
};

/// The time of its watchdog; absent: off, or no Set_Prm for DP.
std::optional<Tick> watchdog_of(const bus::Bytes& prm) {
  constexpr std::uint8_t kBase1ms = 0x04;  // table 21
  if (prm.size() < kPrmHead || (prm[0] & kWdOn) == 0) return std::nullopt;
  const bool fine = prm.size() > kPrmHead && (prm[kPrmHead] & kBase1ms) != 0;
  return prm[1] * prm[2] * (fine ? 1 : 10) * bus::kTicksPerMs;
}

class RestartReader {
 public:
  void take(const bus::Telegram& request, const RecordedTelegram& asked, const RecordedTelegram* answer) {
    if (answer == nullptr) {
      silent_ = silent_ || exchanging_;
      return;
    }
    if (is_service(request, sap::kSetPrm) && acknowledged(answer)) {
      exchanging_ = false;
      watchdog_ = watchdog_of(request.data);
    }
    if (refuses_exchange(request, asked, answer)) silent_ = true;
    const bus::Bytes* diagnosis = diagnosis_of(request, answer);
    if (diagnosis != nullptr && ((*diagnosis)[1] & kPrmReq) != 0) {
      if (silent_) restarts_.push_back({before_, bus::kNever});
      exchanging_ = silent_ = false;
    }
    if (exchanged(request, answer)) {
      exchanging_ = true;
      silent_ = false;
      if (!restarts_.empty()) restarts_.back().until = std::min(restarts_.back().until, answer->end);
    }
    if (!silent_) before_ = answer->end;
  }
  std::vector<Restart> finish() { return std::move(restarts_); }

 private:
  /// RS, as outside of data exchange (S13), while the watchdog cannot have ended it.
  bool refuses_exchange(const bus::Telegram& request, const RecordedTelegram& asked,
                        const RecordedTelegram* answer) const {
    const bus::Telegram* telegram = right_answer(answer);
    const bool in_time = !watchdog_ || asked.end - before_ < *watchdog_;
    return exchanging_ && in_time && is_data_exchange(request) && telegram != nullptr &&
           telegram->kind == bus::TelegramKind::kSd1 && telegram->function() == bus::fc::kRs;
  }

  std::vector<Restart> restarts_;
  bool exchanging_ = false, silent_ = false;
  std::optional<Tick> watchdog_;
  Tick before_ = 0;  ///< end of the last answer before a silence
};

void sort(std::vector<Supply>& supplies) {
  std::stable_sort(
      supplies.begin(), supplies.end(), [](const Supply& a, const Supply& b) { return a.at < b.at; });
}

/// A third of the shortest time from the end of an answer to the next request whose answer shows new data. Clamped to
/// 20 us, which a driver needs, and 1 ms.
Tick cycle_for(const Recording& recording, const std::vector<Supply>& supplies) {
  constexpr Tick kLeast = 20 * bus::kTicksPerUs, kMost = bus::kTicksPerMs;
  Tick shortest = 3 * kMost;
  auto request = recording.requests.begin();
  for (const Supply& supply : supplies) {
    while (request != recording.requests.end() && recording.request(*request).end <= supply.at) ++request;
    if (request == recording.requests.end()) break;
    shortest = std::min(shortest, recording.request(*request).end - supply.at);
  }
  return std::clamp(shortest / 3, kLeast, kMost);
}

/// A verdict on parameters for another ident number is the chip's (S6).
void add_verdicts(Firmware& firmware, const VerdictReader& verdicts) {
  if (verdicts.judges_prm(firmware.init.ident)) firmware.init.prm_mode = kUserJudges;
  if (verdicts.judges_cfg(firmware.init.cfg)) firmware.init.cfg_mode = kUserJudges;
  for (const UserVerdict& each : verdicts.verdicts())
    if (each.cfg || each.ident == firmware.init.ident)
      firmware.supplies.push_back({each.at, user_cpu::command::SendVerdict{each.cfg, each.refuse}});
}

}  // namespace

const bus::Bytes* inputs_of(const bus::Telegram& request, const RecordedTelegram* answer) {
  const bus::Telegram* telegram = right_answer(answer);
  if (telegram == nullptr || telegram->data.empty()) return nullptr;
  const bool inputs = is_data_exchange(request) || is_service(request, sap::kReadInputs);
  return inputs ? &telegram->data : nullptr;
}

Firmware firmware_of(const Recording& recording, const ChipKind* kind) {
  InitReader init;
  ObjectReader objects;
  SupplyReader supplies(recording.telegrams.front().start);
  RestartReader restarts;
  VerdictReader verdicts(recording.telegrams.front().start, kind != nullptr && kind->takes_cfg_early());
  for (const RecordedRequest& each : recording.requests) {
    const RecordedTelegram& asked = recording.request(each);
    const RecordedTelegram* answer = recording.answer(each);
    const bus::Telegram& request = asked.decoded.telegram;
    init.take(request, answer);
    objects.take(request, answer);
    supplies.take(request, answer);
    restarts.take(request, asked, answer);
    verdicts.take(request, answer);
  }
  Firmware firmware;
  firmware.init = init.finish();
  firmware.short_prm_buffer = firmware.init.max_prm.has_value();
  if (!firmware.init.cfg && begins_in_the_middle(recording)) firmware.init.cfg = cfg_of_exchange(recording);
  firmware.inputs = supplies.first_inputs().value_or(bus::Bytes{});
  firmware.objects = objects.finish();
  firmware.supplies = supplies.finish();
  sort(firmware.supplies);
  firmware.cycle = cycle_for(recording, firmware.supplies);
  add_verdicts(firmware, verdicts);
  sort(firmware.supplies);
  firmware.restarts = restarts.finish();
  return firmware;
}

bool leaves_verdict(const scenario::UserCpu& user, const user_cpu::StationConfig& station, bool cfg) {
  return (cfg ? station.cfg_mode : station.prm_mode) == kUserJudges &&
         (cfg ? user.judge_cfg : user.judge_prm) == scenario::Judgement::kNever;
}

std::vector<Supply> supplies_for(const std::vector<Supply>& supplies, const scenario::UserCpu& user,
                                 const user_cpu::StationConfig& station, bool data) {
  std::vector<Supply> needed;
  std::copy_if(supplies.begin(), supplies.end(), std::back_inserter(needed), [&](const Supply& each) {
    const auto* verdict = std::get_if<user_cpu::command::SendVerdict>(&each.command);
    return verdict == nullptr ? data : leaves_verdict(user, station, verdict->cfg);
  });
  return needed;
}

Beginning beginning_of(const Recording& recording) {
  const auto& requests = recording.requests;
  const auto telegram_of = [&](const RecordedRequest& each) { return recording.request(each).decoded.telegram; };
  const auto first_answer = std::find_if(
      requests.begin(), requests.end(), [](const RecordedRequest& each) { return each.answer.has_value(); });
  const auto first_prm = std::find_if(requests.begin(), requests.end(), [&](const RecordedRequest& each) {
    return is_service(telegram_of(each), sap::kSetPrm) && acknowledged(recording.answer(each));
  });
  Beginning beginning;
  beginning.first_answer = static_cast<std::size_t>(first_answer - requests.begin());
  beginning.comparable = beginning.first_answer;
  if (!begins_in_the_middle(recording)) return beginning;
  // A Set_Prm alone may keep a slave in data exchange; the model never was in it.
  auto prm = requests.end();
  for (auto each = first_prm; each != requests.end(); ++each) {
    const bus::Telegram& request = telegram_of(*each);
    if (is_service(request, sap::kSetPrm)) prm = each;
    if (is_data_exchange(request)) prm = requests.end();
    if (is_service(request, sap::kChkCfg) && prm != requests.end()) break;
    if (each + 1 == requests.end()) prm = requests.end();
  }
  beginning.comparable = static_cast<std::size_t>(prm - requests.begin());
  return beginning;
}

void check_comparable(const Recording& recording) {
  if (beginning_of(recording).comparable < recording.requests.size()) return;
  throw InputError(recording.name, 0,
                   fmt::format("station {} is in data exchange where it begins, and no Set_Prm and Chk_Cfg follow, so "
                               "that nothing can be compared without the lead-in, expected a capture with them",
                               recording.slave));
}

}  // namespace dsdpv1::tb::replay
