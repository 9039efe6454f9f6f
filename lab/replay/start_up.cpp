#include "lab/replay/start_up.hpp"

#include <algorithm>

#include "bus/baud.hpp"
#include "lab/replay/services.hpp"

namespace dsdpv1::tb::replay {
namespace {

namespace sap = bus::sap;

constexpr std::uint8_t kNewSeries = bus::fc::kRequest | bus::fc::kSrdHigh | bus::fc::kFcb;
constexpr std::uint8_t kSyncReq = 0x20, kFreezeReq = 0x10, kDpv1 = 0x80;

const RecordedRequest* first_exchange(const Recording& recording) {
  const auto found =
      std::find_if(recording.requests.begin(), recording.requests.end(), [&](const RecordedRequest& each) {
        return exchanged(recording.request(each).decoded.telegram, recording.answer(each));
      });
  return found == recording.requests.end() ? nullptr : &*found;
}

/// The special format: each identifier has up to 64 bytes.
void add_identifiers(bus::Bytes& cfg, std::uint8_t direction, std::size_t length) {
  constexpr std::size_t kMost = 64;
  for (; length > 0; length -= std::min(length, kMost)) {
    cfg.push_back(direction);
    cfg.push_back(static_cast<std::uint8_t>(std::min(length, kMost) - 1));
  }
}

bool watchdog_on(const Recording& recording) {
  bool on = false;
  for_each_request(recording, [&on](const bus::Telegram& request, const RecordedTelegram* answer) {
    const bus::Bytes* diagnosis = diagnosis_of(request, answer);
    on = on || (diagnosis != nullptr && ((*diagnosis)[1] & kWatchdogOn) != 0);
  });
  return on;
}

bus::Bytes set_prm_of(const Recording& recording, const user_cpu::StationConfig& station) {
  bus::Bytes data = {kLockReq,
                     0,
                     0,
                     bus::kMinTsdrBits,
                     static_cast<std::uint8_t>(station.ident >> 8U),
                     static_cast<std::uint8_t>(station.ident),
                     0};
  if (station.sync) data[0] |= kSyncReq;
  if (station.freeze) data[0] |= kFreezeReq;
  if (watchdog_on(recording)) {
    data[0] |= kWdOn;
    data[1] = data[2] = 0xFF;
  }
  if (station.prm_mode == 1) data.resize(data.size() + station.max_prm);
  if (station.dpv1) {
    data.resize(std::max<std::size_t>(data.size(), 10));
    data[7] |= kDpv1;
  }
  return data;
}

}  // namespace

bool begins_in_the_middle(const Recording& recording) {
  for (const RecordedRequest& each : recording.requests) {
    const bus::Telegram& request = recording.request(each).decoded.telegram;
    const RecordedTelegram* answer = recording.answer(each);
    if (is_service(request, sap::kSetPrm) && acknowledged(answer)) return false;
    const bus::Bytes* diagnosis = diagnosis_of(request, answer);
    if (exchanged(request, answer) || (diagnosis != nullptr && ((*diagnosis)[1] & kPrmReq) == 0)) return true;
  }
  return false;
}

bus::Bytes cfg_of_exchange(const Recording& recording) {
  constexpr std::uint8_t kOutput = 0x80, kInput = 0x40;
  bus::Bytes cfg;
  if (const RecordedRequest* exchange = first_exchange(recording)) {
    add_identifiers(cfg, kOutput, recording.request(*exchange).decoded.telegram.data.size());
    add_identifiers(cfg, kInput, recording.answer(*exchange)->decoded.telegram.data.size());
  }
  if (cfg.empty()) cfg.push_back(0);  // an empty slot
  return cfg;
}

std::vector<bus::Telegram> start_up_of(const Recording& recording, const user_cpu::StationConfig& station) {
  const RecordedRequest* exchange = first_exchange(recording);
  if (exchange == nullptr || !begins_in_the_middle(recording)) return {};
  const bus::Telegram& first = recording.request(*exchange).decoded.telegram;
  const auto to_slave = [&](const bus::Bytes& data, std::uint8_t dsap) {
    return bus::make_telegram(recording.slave, first.sa, kNewSeries, data, dsap, sap::kMaster);
  };
  // The last one has the opposite frame count bit of the capture's first request.
  bus::Telegram last = first;
  last.fc = static_cast<std::uint8_t>(kNewSeries | bus::fc::kFcv);
  const auto of_master = std::find_if(recording.requests.begin(), recording.requests.end(), [&](const auto& each) {
    return recording.request(each).decoded.telegram.sa == first.sa;
  });
  if ((recording.request(*of_master).decoded.telegram.fc & bus::fc::kFcb) != 0)
    last.fc = static_cast<std::uint8_t>(last.fc & ~bus::fc::kFcb);
  return {to_slave(set_prm_of(recording, station), sap::kSetPrm), to_slave(station.cfg, sap::kChkCfg), last};
}

}  // namespace dsdpv1::tb::replay
