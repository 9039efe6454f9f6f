#include "lab/replay/firmware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/input/input_error.hpp"
#include "lab/replay/services.hpp"
#include "lab/replay/start_up.hpp"

namespace dsdpv1::tb::replay {
namespace {

namespace sap = bus::sap;

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
    if (is_service(request, sap::kSetPrm) && acknowledged(answer) && request.data.size() >= 7) sent_.prm = request;
    if (is_service(request, sap::kChkCfg) && acknowledged(answer)) sent_.cfg = request.data;
    if (exchanged(request, answer) && !in_force_ && sent_.prm) in_force_ = sent_;
    if (is_service(request, sap::kSetSlaveAddress) && acknowledged(answer)) take_address(request.data);
    if (const bus::Telegram* telegram = right_answer(answer)) take_answer(request, *telegram);
    if (const bus::Bytes* diagnosis = diagnosis_of(request, answer)) take_diagnosis(*diagnosis);
  }

  scenario::InitData finish() {
    const Sent& sent = in_force_ ? *in_force_ : sent_;
    if (sent.prm && (in_force_ || !init_.ident)) init_.ident = ident_at(sent.prm->data, 4);
    if (!init_.cfg) init_.cfg = sent.cfg;
    if (sent.prm && bus::dpv1_enabled(*sent.prm).value_or(false)) init_.dpv1 = true;
    return std::move(init_);
  }

 private:
  void take_answer(const bus::Telegram& request, const bus::Telegram& answer) {
    if (is_service(request, sap::kGetCfg) && !answer.data.empty() && !init_.cfg) init_.cfg = answer.data;
    if (request.dsap && *request.dsap <= sap::kMs1 && !refused(answer)) init_.dpv1 = true;
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
  /// In order of time.
  std::vector<Supply> finish() {
    std::stable_sort(supplies_.begin(), supplies_.end(), [](const Supply& a, const Supply& b) { return a.at < b.at; });
    return std::move(supplies_);
  }
  const std::optional<bus::Bytes>& first_inputs() const { return first_inputs_; }

 private:
  void take_inputs(const bus::Bytes& inputs) {
    if (!first_inputs_)
      first_inputs_ = inputs;
    else if (inputs != inputs_)
      supplies_.push_back({before_, {}, inputs});
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
    if (news) supplies_.push_back({high_since_.value_or(before_), kind_of(flags), own});
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

class RestartReader {
 public:
  void take(const bus::Telegram& request, const RecordedTelegram* answer) {
    if (answer == nullptr) {
      silent_ = silent_ || exchanging_;
      return;
    }
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
  std::vector<Restart> restarts_;
  bool exchanging_ = false, silent_ = false;
  Tick before_ = 0;  ///< end of the last answer before a silence
};

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

}  // namespace

user_cpu::Command Supply::command() const {
  if (diagnosis) return user_cpu::command::SetDiagnosis{*diagnosis, bytes};
  return user_cpu::command::SetInputs{bytes};
}

const bus::Bytes* inputs_of(const bus::Telegram& request, const RecordedTelegram* answer) {
  const bus::Telegram* telegram = right_answer(answer);
  if (telegram == nullptr || telegram->data.empty()) return nullptr;
  const bool inputs = is_data_exchange(request) || is_service(request, sap::kReadInputs);
  return inputs ? &telegram->data : nullptr;
}

Firmware firmware_of(const Recording& recording) {
  InitReader init;
  ObjectReader objects;
  SupplyReader supplies(recording.telegrams.front().start);
  RestartReader restarts;
  for_each_request(recording, [&](const bus::Telegram& request, const RecordedTelegram* answer) {
    init.take(request, answer);
    objects.take(request, answer);
    supplies.take(request, answer);
    restarts.take(request, answer);
  });
  Firmware firmware;
  firmware.init = init.finish();
  if (!firmware.init.cfg && begins_in_the_middle(recording)) firmware.init.cfg = cfg_of_exchange(recording);
  firmware.inputs = supplies.first_inputs().value_or(bus::Bytes{});
  firmware.objects = objects.finish();
  firmware.supplies = supplies.finish();
  firmware.cycle = cycle_for(recording, firmware.supplies);
  firmware.restarts = restarts.finish();
  return firmware;
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
