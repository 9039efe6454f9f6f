#include "kinds/xgate/kind.hpp"

#include "io/input/input_error.hpp"
#include "kinds/xgate/checks.hpp"
#include "kinds/xgate/frame_reader.hpp"
#include "kinds/xgate/host_program.hpp"
#include "kinds/xgate/orders.hpp"
#include "kinds/xgate/outside_host.hpp"
#include "kinds/xgate/pins.hpp"
#include "kinds/xgate/port.hpp"
#include "kinds/xgate/settings.hpp"
#include "model/xgate/reasons.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::xgate {
namespace {

/// Places of command 04 (4.2).
profibus::Words words() {
  profibus::Words words;
  words.ident = "the ident number of command 04";
  words.new_block = "INT";
  return words;
}

kit::Parts make_parts() {
  kit::Parts parts;
  parts.name = "xgate";
  parts.title = "XGate-DPS10";
  parts.pins = bench_pins();
  parts.interrupt = kInt;
  parts.told = {kHostTxd};
  parts.capacities = kCapacities;
  parts.reasons = reasons();
  parts.words = words();
  parts.diagnosis = parts.acyclic = true;
  parts.port = [](kit::Chip& chip) { return std::make_unique<ModulePort>(chip); };
  parts.program = run_host;
  return parts;
}

MakeArmUser arm_maker = nullptr;

bool is_arm(const tb::scenario::Slave& slave) { return user_settings_of(*slave.user_cpu.own).kind == HostCpu::kArm; }

class XgateKind : public kit::Kind {
 public:
  XgateKind() : kit::Kind(make_parts()), codes_(kit::Kind::codes()) {
    for (std::size_t i = 0; i < reasons().size(); ++i) add_example(codes_.front().codes[i], reasons()[i]);
    codes_.push_back(program_codes());
  }

  const tb::keys::Object& chip_keys() const override { return xgate::chip_keys(); }
  std::unique_ptr<tb::OwnSettings> make_chip_settings() const override { return std::make_unique<ChipSettings>(); }
  const tb::keys::Object& user_keys() const override { return xgate::user_keys(); }
  std::unique_ptr<tb::OwnSettings> make_user_settings() const override { return std::make_unique<UserSettings>(); }
  void check_chip(const tb::OwnSettings& settings, const tb::keys::Source& source) const override {
    check_ids(chip_settings_of(settings), source.file);
  }
  void check_user(const tb::OwnSettings& settings, const tb::OwnSettings& chip, const tb::keys::Source& source,
                  const std::string& /*slave*/, int /*where*/) const override {
    check_line(user_settings_of(settings), chip_settings_of(chip), source.file);
  }
  void check_slave(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave) const override {
    kit::Kind::check_slave(scenario, slave);
    xgate::check_slave(scenario, slave);
    check_cpu(scenario, slave);
  }
  std::string place_of(const std::string& init_key) const override;
  const std::vector<tb::CodeTable>& codes() const override { return codes_; }
  std::unique_ptr<tb::HostReader> make_host_reader(const tb::OwnSettings& chip) const override {
    return std::make_unique<FrameReader>(chip_settings_of(chip));
  }
  const std::vector<tb::PinGroup>& pin_groups() const override {
    static const std::vector<tb::PinGroup> groups = {
        {"line", {"PBRXD", "PBTXD", "PBRTS"}},
        {"host", {"RESET", "INT", "ISP_CFG"}},
        {"uart", {"RXD", "uart_request", "TXD", "uart_reply"}},
        {"spi", {"NSS", "SCK", "MOSI", "spi_request", "MISO", "spi_reply"}},
        {"leds", {"LED1A", "LED1B", "LED2A", "LED2B"}}};
    return groups;
  }
  bool has_outside_line(const tb::scenario::Slave& slave) const override {
    return chip_settings_of(*slave.chip).port == Port::kUart && !is_arm(slave);
  }
  bool has_debugger(const tb::scenario::Slave& slave) const override { return is_arm(slave); }
  tb::MakeUser make_user(const tb::UserRequest& request) const override {
    if (request.outside != nullptr) return outside_host(request);
    if (!is_arm(request.slave)) return kit::Kind::make_user(request);
    if (arm_maker != nullptr) return arm_maker(request);
    throw tb::InputError(request.scenario.file, request.slave.user_cpu.line,
                         "kind is arm, but this program has no ARM board, allowed without it is native");
  }

  const std::vector<tb::Order>& orders() const override { return xgate::orders(); }
  void check_order(const std::string& order, const tb::OwnSettings& user, const tb::OwnSettings& chip,
                   const tb::keys::Source& source, int where) const override {
    xgate::check_order(order, user_settings_of(user).kind, chip_settings_of(chip).port, source.file, where);
  }

  const checks::RuleTable& rules() const override { return xgate_checks::rules(); }
  tb::PinMask checked_pins() const override { return xgate_checks::Checks::watched(); }
  std::unique_ptr<checks::ChipChecks> make_checks(const checks::Limits& limits,
                                                  const tb::OwnSettings* chip) const override {
    const ChipSettings usual;
    const ChipSettings& own = chip == nullptr ? usual : chip_settings_of(*chip);
    return std::make_unique<xgate_checks::Checks>(limits, pins(), own.config(), own.spi_mode);
  }

 private:
  /// The text with values, if it has places for them.
  void add_example(tb::CodeText& code, profibus::Reason reason) const {
    const std::string example = describe({0, reason, 5, 12, 1});
    if (example != code.text) code.example = example;
  }

  std::vector<tb::CodeTable> codes_;
};

/// Data of command 04 (4.2).
std::string XgateKind::place_of(const std::string& init_key) const {
  if (init_key == "ident") return "command 04, data 1 and 2";
  if (init_key == "cfg") return "command 04, data 19 and on; its sums data 4 and 5";
  if (init_key == "dpv1") return "command 04, data 16 bit 7";
  if (init_key == "fail_safe") return "command 04, data 16 bit 1";
  return "";
}

}  // namespace

void set_arm_maker(MakeArmUser make) { arm_maker = make; }

const kit::Kind& kind() {
  static const XgateKind kind;
  return kind;
}

}  // namespace dsdpv1::xgate
