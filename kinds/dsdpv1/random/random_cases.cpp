#include "kinds/dsdpv1/random/random_cases.hpp"

#include <fmt/format.h>

#include <iterator>

#include "kinds/dsdpv1/random/access_parts.hpp"
#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "kinds/dsdpv1/random/random_case.hpp"
#include "kinds/dsdpv1/random/read_back.hpp"
#include "kinds/dsdpv1/random/situation_watch.hpp"
#include "kinds/dsdpv1/random/situations.hpp"

namespace dsdpv1::cosim {
namespace {

/// A limit of the baud search or of BAUD_CONTROL (S1): the short one, and the range within which cases vary it.
struct Limit {
  const char* key;
  int usual, least, most;
};
constexpr Limit kLimits[] = {{"search_window_ms", 1, 1, 3},
                             {"search_window_bits", 150, 120, 400},  // T_SYN and the shortest telegram take 100
                             {"baud_control_ms", 2, 1, 4}};

std::string setting(const Limit& limit, int value) { return fmt::format("chip.{}={}", limit.key, value); }

/// The DSDPV1 gets 55 percent of a campaign's cycles, the DSDPV1-RSU the rest; the DSDPV1-R is a DSDPV1.
std::vector<HostPort> ports_of(Part part) {
  if (!has_serial_ports(part)) return {{"parallel", part == Part::kDsdpv1 ? 55U : 0U, {}}};
  return {{"parallel", 5, {}}, {"spi", 20, {"chip.mode=spi"}}, {"uart", 20, {"chip.mode=uart"}}};
}

Vocabulary words_of(Part part) {
  const tb::PinMask selects = mask(Pin::kCsr) | (has_serial_ports(part) ? mask(Pin::kXss) : 0);
  Vocabulary words{ports_of(part), verbs_of(part), selects, {std::begin(kAccessParts), std::end(kAccessParts)}};
  for (const Limit& each : kLimits) words.quick.push_back(setting(each, each.usual));
  if (has_serial_ports(part)) words.quick.emplace_back("chip.u_timer=20000");  // for SPI: some frames
  words.faults = fmt::format("rtl_ref/{}/faults.txt", row(part).rtl);
  words.stimuli = fmt::format("tests/cosim/stimuli/{}", row(part).rtl);
  return words;
}

const tb::Dsdpv1Settings& own(const tb::OwnSettings& chip) { return static_cast<const tb::Dsdpv1Settings&>(chip); }

class Dsdpv1Cases : public RandomCases {
 public:
  explicit Dsdpv1Cases(Part part) : words_(words_of(part)) {}

  const Vocabulary& words() const override { return words_; }
  std::vector<std::string> case_settings(std::uint64_t seed) const override {
    constexpr std::uint64_t kOwnNumbers = 0x5EA5C4;  // a separate sequence from the case's stimulus
    Random random(seed ^ kOwnNumbers);
    std::vector<std::string> settings;
    if (seed % kLedCases != 0) return settings;  // long enough with the usual ones
    if (random.one_in(3))
      for (const Limit& each : kLimits)
        if (const int value = random.between(each.least, each.most); value != each.usual)
          settings.push_back(setting(each, value));
    if (random.one_in(2)) settings.emplace_back("chip.fcb_rule=content");
    return settings;
  }
  Stimulus make_case(std::uint64_t seed, const tb::OwnSettings& chip) const override {
    return RandomCase(seed, own(chip)).make();
  }
  std::unique_ptr<ReadBack> read_back(const tb::OwnSettings& chip) const override { return make_read_back(own(chip)); }
  std::vector<Situation> known_situations(const tb::OwnSettings& chip) const override {
    return cosim::known_situations(own(chip).part, own(chip).mode);
  }
  std::string rulings_of(const Situation& situation, const tb::OwnSettings& chip) const override {
    return cosim::rulings_of(situation, own(chip).mode);
  }
  std::unique_ptr<PlayListener> watch(const tb::OwnSettings& chip, Situations& counted) const override {
    return std::make_unique<SituationWatch>(own(chip), counted);
  }

 private:
  const Vocabulary words_;
};

}  // namespace

std::unique_ptr<const RandomCases> make_random_cases(Part part) { return std::make_unique<Dsdpv1Cases>(part); }

}  // namespace dsdpv1::cosim
