#pragma once
// The telegrams of a run for a chart: when, by whom, what kind; and in words.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tb/bench/observer.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::html {

/// The subject of a telegram; the chart has a colour for each.
enum class TelegramGroup : std::uint8_t {
  kDataExchange,
  kDp,
  kDpv1,
  kToken,
  kAcknowledge,
  kFdl,
  kOther,
  kWrong,
  kHost
};
constexpr std::size_t kTelegramGroups = 9;
/// "data exchange", "DP service", ...
const char* name(TelegramGroup group);

struct ListedTelegram {
  Tick start = 0, end = 0;
  std::uint32_t lane = 0, words = 0;  ///< of `lanes`, of `texts`
  TelegramGroup group = TelegramGroup::kOther;
  std::optional<Tick> tsdr;
};

class TelegramList {
 public:
  static constexpr std::size_t kKept = 100'000;

  /// Names of stations come from the scenario.
  explicit TelegramList(const scenario::Scenario& scenario);
  void add(const HeardTelegram& heard);
  /// Between a slave and its user, in a separate lane.
  void add(const std::string& slave, const HostTelegram& telegram);

  const std::vector<ListedTelegram>& kept() const { return kept_; }
  std::uint64_t count() const { return count_; }
  /// The senders: "plc (2)", "demo (5)", "address 9", "not readable"; "demo, host".
  const std::vector<std::string>& lanes() const { return lanes_.list; }
  const std::vector<std::string>& texts() const { return texts_.list; }
  /// "demo (5)" or "address 5".
  std::string station(std::uint8_t address) const;

 private:
  /// Each text once.
  struct Words {
    std::map<std::string, std::uint32_t> numbers;
    std::vector<std::string> list;
    std::uint32_t number(const std::string& text);
  };
  std::string sender(const bus::WireTelegram& wire) const;

  std::map<std::uint8_t, std::string> names_;
  Words lanes_, texts_;
  std::vector<ListedTelegram> kept_;
  std::uint64_t count_ = 0;
};

/// A request for inputs and outputs of a slave.
bool is_data_exchange(const bus::WireTelegram& telegram);

}  // namespace dsdpv1::tb::html
