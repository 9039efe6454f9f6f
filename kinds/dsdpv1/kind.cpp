#include "kinds/dsdpv1/kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "driver/dsdpv1.h"
#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "kinds/dsdpv1/checks/checks.hpp"
#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/chip/dsdpv1_pin_chip.hpp"
#include "kinds/dsdpv1/chip/user_maker.hpp"
#include "kinds/dsdpv1/claims/rulings.hpp"
#include "kinds/dsdpv1/keys/codes.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/keys/user_act.hpp"
#include "kinds/dsdpv1/pins/diagrams.hpp"
#include "kinds/dsdpv1/pins/inside_watch.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"
#include "kinds/dsdpv1/port/last_access.hpp"
#include "kinds/dsdpv1/random/random_cases.hpp"
#include "kinds/dsdpv1/rtl/rtl_of.hpp"
#include "kinds/dsdpv1/user_cpu/orders.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::tb {
namespace {

using user_cpu::command::OfChip;

/// Of a CRC or ident number. The texts of wrong CRCs begin alike.
bool has_exchanged_bytes(const profibus::Event& event) {
  const bool is_crc = std::string_view(event.reason.row().text).find("CRC {a:4x}") != std::string_view::npos;
  return (is_crc || event.reason == profibus::Reason::kPrmIdent) && event.a != event.b &&
         event.a == ((event.b << 8 | event.b >> 8) & 0xFFFF);
}

std::string said_hold(const OfChip& order) { return "holds the DPRAM for " + time_text(order.duration); }
std::string said_wrong_crc(const OfChip&) { return "wrong CRC"; }
std::string said_flip_bit(const OfChip& order) { return fmt::format("a wrong bit in {} telegrams", order.times); }
std::string said_cut(const OfChip& order) { return fmt::format("{} telegrams end too early", order.times); }
std::string said_wrong_parity(const OfChip& order) { return fmt::format("wrong parity in {} telegrams", order.times); }
std::string said_host_telegram(const OfChip& order) { return "sends " + bytes_text(order.bytes) + " and the CRC"; }
std::string said_break(const OfChip& order) { return fmt::format("{} telegrams end in a break", order.times); }
std::string said_pause(const OfChip& order) {
  return fmt::format("{} telegrams pause for {}", order.times, time_text(order.duration));
}
std::string said_talk_over(const OfChip& order) { return fmt::format("talks over {} replies", order.times); }
std::string said_spoil_reads(const OfChip&) { return "reads will be wrong"; }
std::string said_early_r_sta(const OfChip&) { return "R_STA without checking L_REQ and L_STA"; }

class Dsdpv1Kind : public ChipKind {
 public:
  explicit Dsdpv1Kind(Part part)
      : part_(part), rtl_(cosim::make_rtl_of(part)), random_(cosim::make_random_cases(part)) {}

  const char* name() const override { return row(part_).name; }
  const char* title() const override { return row(part_).title; }
  const PinTable& pins() const override { return pins_of(part_); }
  const BoardPins& board_pins() const override { return kDsdpv1BoardPins; }
  int cells() const override { return 0x800; }  // P4
  int most_cfg() const override { return DSDPV1_MAX_CFG; }

  const keys::Object& chip_keys() const override { return chip_keys_of(part_); }
  std::unique_ptr<OwnSettings> make_chip_settings() const override {
    auto settings = std::make_unique<Dsdpv1Settings>();
    settings->part = part_;
    return settings;
  }
  bool is_strap(const std::string& key) const override { return tb::is_strap(key); }
  void check_chip(const OwnSettings& settings, const keys::Source& source) const override {
    check_dsdpv1_chip(static_cast<const Dsdpv1Settings&>(settings), source.file);
  }
  const keys::Object& user_keys() const override { return user_keys_of(part_); }
  std::unique_ptr<OwnSettings> make_user_settings() const override { return std::make_unique<Dsdpv1User>(); }
  void check_user(const OwnSettings& settings, const OwnSettings& chip, const keys::Source& source,
                  const std::string& slave, int where) const override {
    const auto& user = static_cast<const Dsdpv1User&>(settings);
    check_dsdpv1_user(user, source.file, slave, where);
    check_port(user, static_cast<const Dsdpv1Settings&>(chip), source.file, slave, where);
  }
  void check_order(const std::string& order, const OwnSettings& user, const OwnSettings& chip,
                   const keys::Source& source, int where) const override {
    tb::check_order(order, static_cast<const Dsdpv1User&>(user).kind, static_cast<const Dsdpv1Settings&>(chip).mode,
                    source.file, where);
  }
  std::string place_of(const std::string& init_key) const override;
  const std::vector<Order>& orders() const override;
  const std::vector<keys::Word>& blocks() const override;

  const std::vector<profibus::Reason>& reasons() const override {
    static const std::vector<profibus::Reason> all = dsdpv1::reasons();
    return all;
  }
  std::string describe(const profibus::Event& event) const override {
    return dsdpv1::describe(event) + (has_exchanged_bytes(event) ? ": its bytes are exchanged" : "");
  }
  std::string cell_of(const profibus::Event& event) const override {
    const std::string_view text = event.reason.row().text;
    return text.find("B{a:3x}") != std::string_view::npos ? fmt::format("B{:03X}", event.a) : "";
  }
  std::optional<user_cpu::Act> act_of(const profibus::Event& event) const override { return user_act_of(event); }
  std::unique_ptr<AccessReader> make_access_reader() const override { return std::make_unique<LastAccess>(); }
  std::unique_ptr<HostReader> make_host_reader(const OwnSettings& chip) const override {
    return host_reader_of(static_cast<const Dsdpv1Settings&>(chip));
  }
  const std::vector<CodeTable>& codes() const override { return dsdpv1_codes(); }

  const std::vector<PinGroup>& pin_groups() const override { return pin_groups_of(part_); }
  const std::vector<InnerSignal>& inner_signals() const override { return InsideWatch::signals(); }

  const checks::RuleTable& rules() const override { return checks::rules(part_); }
  PinMask checked_pins() const override { return checks::Checks::pins(part_); }
  std::unique_ptr<checks::ChipChecks> make_checks(const checks::Limits& limits,
                                                  const OwnSettings* chip) const override {
    const SerialSettings serial =
        chip != nullptr ? serial_settings_of(static_cast<const Dsdpv1Settings&>(*chip)) : SerialSettings();
    return std::make_unique<checks::Checks>(limits, part_, serial);
  }
  const std::vector<TimingDiagram>& timing_diagrams() const override { return dsdpv1_timing_diagrams(); }
  const std::vector<BusyTime>& busy_times() const override { return dsdpv1_busy_times(); }

  const cosim::RtlOf* rtl() const override { return rtl_.get(); }
  bool has_reference_rtl() const override { return true; }
  const calibrate::Claims* claims() const override { return &calibrate::dsdpv1_claims(); }
  const cosim::RandomCases* random() const override { return random_.get(); }
  std::unique_ptr<PinDevice> make_device(const ChipRequest& request) const override {
    return std::make_unique<CoreDevice>(config_of(request));
  }
  std::unique_ptr<PinChip> make_pin_chip(const ChipRequest& request, std::unique_ptr<PinDevice> device,
                                         bus::Segment& segment) const override {
    auto chip =
        std::make_unique<Dsdpv1PinChip>(request.name, std::move(device), part_, request.watched, segment, request.late);
    chip->strap(straps_of(request.settings));
    return chip;
  }
  MakeUser make_user(const UserRequest& request) const override { return make_dsdpv1_user(request); }
  bool has_debugger(const scenario::Slave& slave) const override { return own(slave.user_cpu).kind == CpuKind::kArm; }
  bool has_process(const scenario::Slave& slave) const override {
    return own(slave.user_cpu).kind == CpuKind::kProcess;
  }
  bool needs_pins(const scenario::Scenario& scenario, const scenario::Slave& slave) const override {
    if (static_cast<const Dsdpv1Settings&>(*slave.chip).mode != HostMode::kParallel && has_debugger(slave)) return true;
    return std::any_of(scenario.script.begin(), scenario.script.end(), [&slave](const scenario::Action& action) {
      return action.word == user_cpu::kSpoilReads && action.slave.text == slave.name.text;
    });
  }

 private:
  const Part part_;
  const std::unique_ptr<const cosim::RtlOf> rtl_;
  const std::unique_ptr<const cosim::RandomCases> random_;
};

std::string Dsdpv1Kind::place_of(const std::string& init_key) const {
  static const std::map<std::string, const char*> places = {{"ident", "B022, B023"}, {"max_inputs", "B027"},
                                                            {"max_outputs", "B028"}, {"max_diag", "B029"},
                                                            {"max_prm", "B02A"},     {"max_cfg", "B02C"},
                                                            {"cfg", "B02F.."},       {"prm_mode", "B02B"},
                                                            {"cfg_mode", "B02D"},    {"set_slave_address", "B024.0"},
                                                            {"freeze", "B024.1"},    {"sync", "B024.2"},
                                                            {"fail_safe", "B024.3"}, {"dpv1", "B005 = 0x1D"}};
  const auto found = places.find(init_key);
  return found == places.end() ? "" : found->second;
}

namespace {

std::vector<Order> parallel_orders() {
  return {
      {{user_cpu::kHoldDpram, "The user CPU takes the DPRAM and keeps it.", {"slave", "for"}, {}}, said_hold},
      {{user_cpu::kWrongCrc,
        "The next blocks of this kind that the user CPU writes have a wrong CRC.",
        {"slave", "area"},
        {"times"}},
       said_wrong_crc},
      {{user_cpu::kEarlyRSta,
        "The user CPU raises R_STA one cycle after R_REQ without checking L_REQ and L_STA (against H2), and holds for "
        "1 us.",
        {"slave"},
        {"times"}},
       said_early_r_sta,
       true},
      {{user_cpu::kSpoilReads,
        "A bit is wrong on its way to the user CPU, where no pin shows it: D, once in the outputs, parameters, "
        "configuration, C1 and C2 request that it reads next; SPI and UART: in some of the next 16 "
        "replies.",
        {"slave"},
        {}},
       said_spoil_reads},
  };
}

std::vector<Order> rsu_orders() {
  std::vector<Order> orders = parallel_orders();
  orders.push_back({{user_cpu::kFlipBit,
                     "The next telegrams of the user CPU have a wrong bit (SPI, or UART with right parity).",
                     {"slave"},
                     {"times"}},
                    said_flip_bit});
  orders.push_back({{user_cpu::kCutTelegram,
                     "The next telegrams of the user CPU end too early: XSS rises within the third byte, or only two "
                     "characters are sent.",
                     {"slave"},
                     {"times"}},
                    said_cut});
  orders.push_back({{user_cpu::kWrongParity,
                     "The next telegrams of the user CPU have a character with a wrong parity: UART.",
                     {"slave"},
                     {"times"}},
                    said_wrong_parity});
  orders.push_back({{user_cpu::kHostTelegram,
                     "The user CPU sends these bytes, right or wrong, and their CRC to the chip: SPI and UART. Also "
                     "before start_delay is over.",
                     {"slave", "bytes"},
                     {"times", "listen"}},
                    said_host_telegram});
  orders.push_back({{user_cpu::kSendBreak,
                     "The next telegrams of the user CPU end in a break: RXD is low for the time of the third "
                     "character. UART.",
                     {"slave"},
                     {"times"}},
                    said_break});
  orders.push_back({{user_cpu::kPauseTelegram,
                     "The next telegrams of the user CPU pause before the third character. UART.",
                     {"slave", "for"},
                     {"times"}},
                    said_pause});
  orders.push_back({{user_cpu::kTalkOverReply,
                     "The user CPU sends a character (FF) 20 bit times after its next telegrams, into the replies. "
                     "UART.",
                     {"slave"},
                     {"times"}},
                    said_talk_over});
  return orders;
}

}  // namespace

const std::vector<Order>& Dsdpv1Kind::orders() const {
  static const std::vector<Order> plain = parallel_orders(), rsu = rsu_orders();
  return has_serial_ports(part_) ? rsu : plain;
}

const std::vector<keys::Word>& Dsdpv1Kind::blocks() const {
  static const std::vector<keys::Word> words = [] {
    std::vector<keys::Word> list;
    for (const std::string& word : user_cpu::block_words())
      list.push_back({word, word == "init" ? "initialisation" : ""});
    return list;
  }();
  return words;
}

}  // namespace

const ChipKind& kind_of(Part part) {
  static const std::array<Dsdpv1Kind, kParts.size()> kinds = {Dsdpv1Kind(Part::kDsdpv1), Dsdpv1Kind(Part::kR),
                                                              Dsdpv1Kind(Part::kRsu)};
  return kinds.at(static_cast<std::size_t>(part));
}

}  // namespace dsdpv1::tb
