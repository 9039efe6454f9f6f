#include "tb/report/html/telegram_list.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"

namespace dsdpv1::tb::html {
namespace {

bool has_sap(const bus::Telegram& telegram) { return telegram.dsap || telegram.ssap; }

/// The slave's service access point.
TelegramGroup group_of_sap(const bus::Telegram& telegram) {
  const std::optional<std::uint8_t> sap = telegram.is_request() ? telegram.dsap : telegram.ssap;
  if (!sap) return TelegramGroup::kOther;
  if (*sap >= bus::sap::kSetSlaveAddress && *sap <= bus::sap::kChkCfg) return TelegramGroup::kDp;
  return *sap <= bus::sap::kMs1 ? TelegramGroup::kDpv1 : TelegramGroup::kOther;
}

bool is_fdl(const bus::Telegram& telegram) {
  if (!telegram.is_request()) return telegram.kind == bus::TelegramKind::kSd1;
  const std::uint8_t function = telegram.function();
  return function == bus::fc::kFdlStatus || function == bus::fc::kIdent || function == bus::fc::kLsapStatus;
}

TelegramGroup group_of(const bus::WireTelegram& wire) {
  const bus::Telegram& telegram = wire.decoded.telegram;
  if (!wire.right()) return TelegramGroup::kWrong;
  if (telegram.kind == bus::TelegramKind::kSd4) return TelegramGroup::kToken;
  if (telegram.kind == bus::TelegramKind::kSc) return TelegramGroup::kAcknowledge;
  if (has_sap(telegram)) return group_of_sap(telegram);
  return is_fdl(telegram) ? TelegramGroup::kFdl : TelegramGroup::kDataExchange;
}

}  // namespace

const char* name(TelegramGroup group) {
  static constexpr const char* kNames[kTelegramGroups] = {
      "data exchange", "DP service", "DPV1", "token", "short acknowledge", "FDL", "other", "wrong", "host port"};
  return kNames[static_cast<std::size_t>(group)];
}

bool is_data_exchange(const bus::WireTelegram& telegram) {
  return group_of(telegram) == TelegramGroup::kDataExchange && telegram.decoded.telegram.is_request();
}

TelegramList::TelegramList(const scenario::Scenario& scenario) {
  const auto add = [this](int address, const std::string& name) {
    names_.emplace(static_cast<std::uint8_t>(address), name);
  };
  for (const scenario::Master& each : scenario.masters) add(each.address, each.name.text);
  for (const scenario::Master2& each : scenario.masters2) add(each.address, each.name.text);
  for (const scenario::Slave& each : scenario.slaves) add(each.address, each.name.text);
}

std::string TelegramList::station(std::uint8_t address) const {
  const auto found = names_.find(address);
  return found == names_.end() ? fmt::format("address {}", address) : fmt::format("{} ({})", found->second, address);
}

/// A short acknowledge does not say who sends it.
std::string TelegramList::sender(const bus::WireTelegram& wire) const {
  if (!wire.decoded.readable) return "not readable";
  if (wire.decoded.telegram.kind != bus::TelegramKind::kSc) return station(wire.decoded.telegram.sa);
  return wire.station == 255 ? "unknown" : station(wire.station);
}

void TelegramList::add(const HeardTelegram& heard) {
  if (count_++ >= kKept) return;
  const bus::WireTelegram& wire = heard.telegram;
  kept_.push_back(
      {wire.start, wire.end, lanes_.number(sender(wire)), texts_.number(heard.words()), group_of(wire), wire.tsdr});
}

/// The subject is last, as in the words of telegrams on the line.
void TelegramList::add(const std::string& slave, const HostTelegram& telegram) {
  if (count_++ >= kKept) return;
  const bool right = telegram.wrong.empty();
  const std::string words = bytes_text(telegram.bytes) + "  " + telegram.words + (right ? "" : ": " + telegram.wrong);
  kept_.push_back({telegram.start,
                   telegram.end,
                   lanes_.number(slave + ", host"),
                   texts_.number(words),
                   right ? TelegramGroup::kHost : TelegramGroup::kWrong,
                   {}});
}

std::uint32_t TelegramList::Words::number(const std::string& text) {
  const auto [entry, is_new] = numbers.emplace(text, static_cast<std::uint32_t>(list.size()));
  if (is_new) list.push_back(text);
  return entry->second;
}

}  // namespace dsdpv1::tb::html
