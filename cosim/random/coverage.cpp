#include "cosim/random/coverage.hpp"

#include <fmt/format.h>

#include <optional>

#include "bus/telegram/telegram.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr std::size_t kLineWidth = 118;

/// The only telegram in `bytes`, if they are one.
std::optional<bus::Telegram> decode(const bus::Bytes& bytes) {
  bus::TelegramDecoder decoder;
  std::optional<bus::Telegram> telegram;
  for (const std::uint8_t byte : bytes) {
    if (telegram) return std::nullopt;
    const auto decoded = decoder.feed(byte);
    if (decoded && decoded->error == bus::DecodeError::kNone) telegram = decoded->telegram;
  }
  return telegram;
}

std::string service(const bus::Telegram& telegram) {
  static const std::map<int, const char*> names = {{bus::sap::kSetSlaveAddress, "Set_Slave_Address"},
                                                   {bus::sap::kReadInputs, "Read_Inputs"},
                                                   {bus::sap::kReadOutputs, "Read_Outputs"},
                                                   {bus::sap::kGlobalControl, "Global_Control"},
                                                   {bus::sap::kGetCfg, "Get_Cfg"},
                                                   {bus::sap::kSlaveDiag, "Slave_Diag"},
                                                   {bus::sap::kSetPrm, "Set_Prm"},
                                                   {bus::sap::kChkCfg, "Check_Cfg"}};
  if (!telegram.dsap) return telegram.function() == bus::fc::kFdlStatus ? "FDL status" : "Data_Exchange";
  const auto name = names.find(*telegram.dsap);
  return name == names.end() ? "other SAP" : name->second;
}

std::string kind(const bus::Bytes& bytes, bool faulty) {
  const auto telegram = decode(bytes);
  if (faulty || !telegram) return "broken";
  if (!telegram->is_request()) return "no request";
  return service(*telegram);
}

/// "NAME count, NAME count" in lines after a heading.
class Lines {
 public:
  explicit Lines(const std::string& heading) : line_(fmt::format("{:<18}", heading)) {}
  void add(const std::string& word) {
    if (line_.size() + word.size() + 2 > kLineWidth) {
      text_ += line_ + "\n";
      line_ = std::string(18, ' ');
    }
    line_ += word + "  ";
  }
  std::string text() const { return text_ + line_ + "\n"; }

 private:
  std::string text_, line_;
};

}  // namespace

void Coverage::sent(const bus::Bytes& bytes, const bus::WireFaults& faults) {
  const bool faulty = faults.wrong_parity_at || faults.missing_stop_at || faults.gap_before || faults.truncate_after ||
                      faults.glitch_at;
  ++telegrams_[kind(bytes, faulty)];
}

void Coverage::happened(const profibus::Event& event) { ++reasons_[event.reason]; }

void Coverage::add(const Coverage& other) {
  for (const auto& [name, count] : other.telegrams_) telegrams_[name] += count;
  for (const auto& [reason, count] : other.reasons_) reasons_[reason] += count;
}

std::uint64_t Coverage::of(const Counts& counts, profibus::Reason reason) {
  const auto found = counts.find(reason);
  return found == counts.end() ? 0 : found->second;
}

std::string Coverage::text(const std::vector<profibus::Reason>& codes) const {
  Lines sent("telegrams"), states("states, services"), refused("refusals"), violated("violations"),
      missing("never seen");
  for (const auto& [name, count] : telegrams_) sent.add(fmt::format("{} {}", name, count));
  for (const profibus::Reason reason : codes) {
    Lines* const lists[] = {&states, &refused, &violated};
    const std::uint64_t times = count(reason);
    Lines& list = times == 0 ? missing : *lists[static_cast<std::size_t>(profibus::severity(reason))];
    list.add(times == 0 ? profibus::code(reason) : fmt::format("{} {}", profibus::code(reason), times));
  }
  return sent.text() + states.text() + refused.text() + violated.text() + missing.text();
}

}  // namespace dsdpv1::cosim
