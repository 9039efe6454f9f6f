#include "kinds/spc3/kind.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "io/input/input_error.hpp"
#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/checks/checks.hpp"
#include "kinds/spc3/chip.hpp"
#include "kinds/spc3/port/frame_reader.hpp"
#include "kinds/spc3/port/last_access.hpp"
#include "kinds/spc3/rtl_of.hpp"
#include "kinds/spc3/settings.hpp"
#include "kinds/spc3/user_cpu/native_user.hpp"
#include "model/spc3/reasons.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

using spc3::Variant;

class Spc3Kind : public ChipKind {
 public:
  explicit Spc3Kind(Variant variant) : variant_(variant) {}

  const char* name() const override { return row(variant_).name; }
  const char* title() const override { return row(variant_).title; }
  const PinTable& pins() const override { return spc3_pins(variant_); }
  const BoardPins& board_pins() const override { return kSpc3BoardPins; }
  int cells() const override { return row(variant_).ram_size; }
  bool has_prm_buffer() const override { return true; }   // A4
  bool takes_cfg_early() const override { return true; }  // A49

  const keys::Object& chip_keys() const override { return spc3_chip_keys(variant_); }
  bool is_strap(const std::string& key) const override { return key == "bus"; }
  std::unique_ptr<OwnSettings> make_chip_settings() const override {
    auto settings = std::make_unique<Spc3Settings>();
    settings->variant = variant_;
    return settings;
  }
  const keys::Object& user_keys() const override { return spc3_user_keys(variant_); }
  std::unique_ptr<OwnSettings> make_user_settings() const override { return std::make_unique<Spc3User>(); }
  void check_slave(const scenario::Scenario& scenario, const scenario::Slave& slave) const override {
    check_spc3_slave(scenario, slave);
  }
  std::string place_of(const std::string& init_key) const override;
  const std::vector<Order>& orders() const override { return spc3_orders(); }

  const std::vector<profibus::Reason>& reasons() const override {
    static const std::vector<profibus::Reason> all = spc3::reasons();
    return all;
  }
  std::string describe(const profibus::Event& event) const override { return spc3::describe(event); }
  const std::vector<CodeTable>& codes() const override { return spc3_codes(); }
  const std::vector<PinGroup>& pin_groups() const override {
    static const std::vector<PinGroup> groups = {
        {"line", {"RXD", "TXD", "RTS", "XCTS"}},
        {"user", {"RESET", "X_INT", "XDATAEXCH", "CLKOUT2_4"}},
        {"bus", {"XCS", "XRD_R_W", "XWR_E_CLOCK", "ALE_AS", "AB", "DB", "DB_IN", "DB_OUT", "XREADY_XDTACK"}},
        {"straps", {"XINT_MOT", "MODE", "DIVIDER", "XTEST0", "XTEST1"}}};
    static const std::vector<PinGroup> with_spi = [] {
      std::vector<PinGroup> all = groups;
      all[2].pins.insert(all[2].pins.begin() + 5, "AB11");
      all[3].pins.push_back("SERIAL");
      all.push_back({"spi", {"XSS", "SCK", "MOSI", "spi_request", "MISO", "spi_reply"}});
      return all;
    }();
    if (row(variant_).has_more_modes) return with_spi;
    return groups;
  }
  const std::vector<InnerSignal>& inner_signals() const override { return Spc3Inside::signals(); }

  const checks::RuleTable& rules() const override { return spc3_checks::rules(); }
  PinMask checked_pins() const override { return spc3_checks::Checks::kPins; }
  std::unique_ptr<checks::ChipChecks> make_checks(const checks::Limits& limits,
                                                  const OwnSettings* chip) const override {
    const Spc3Settings usual;
    const Spc3Settings& own = chip == nullptr ? usual : *static_cast<const Spc3Settings*>(chip);
    return std::make_unique<spc3_checks::Checks>(limits, variant_, spc3_pins(variant_), own.bus, own.spi_mode);
  }
  std::unique_ptr<HostReader> make_host_reader(const OwnSettings& chip) const override {
    const auto& own = static_cast<const Spc3Settings&>(chip);
    return own.bus == spc3::Bus::kSpi ? std::make_unique<Spc3FrameReader>(own.spi_mode) : nullptr;
  }

  std::unique_ptr<AccessReader> make_access_reader() const override { return std::make_unique<Spc3LastAccess>(); }
  std::unique_ptr<PinDevice> make_device(const ChipRequest& request) const override {
    return std::make_unique<Spc3Device>(spc3_config_of(request));
  }
  std::unique_ptr<PinChip> make_pin_chip(const ChipRequest& request, std::unique_ptr<PinDevice> device,
                                         bus::Segment& segment) const override {
    const auto& own = static_cast<const Spc3Settings&>(request.settings);
    return std::make_unique<Spc3PinChip>(request.name, std::move(device), own, own.bus, request.watched, segment,
                                         request.late);
  }
  void check_user(const OwnSettings& settings, const OwnSettings& chip, const keys::Source& source,
                  const std::string& slave, int where) const override {
    check_spc3_user(static_cast<const Spc3User&>(settings), static_cast<const Spc3Settings&>(chip), source.file, slave,
                    where);
  }
  MakeUser make_user(const UserRequest& request) const override;
  bool has_debugger(const scenario::Slave& slave) const override {
    return spc3_user_of(slave.user_cpu).kind == Spc3Cpu::kArm;
  }
  bool needs_pins(const scenario::Scenario& /*scenario*/, const scenario::Slave& /*slave*/) const override {
    return true;
  }
  const cosim::RtlOf* rtl() const override { return &cosim::spc3_rtl(); }

 private:
  const Variant variant_;
};

/// Addresses of docs/spc3.md, hexadecimal.
std::string Spc3Kind::place_of(const std::string& init_key) const {
  static const std::map<std::string, const char*> places = {{"ident", "cells 3A, 3B"},
                                                            {"max_inputs", "cell 1E at first"},
                                                            {"max_outputs", "cell 1A at first"},
                                                            {"max_diag", "cells 24, 25; 32 without it and a GSD"},
                                                            {"max_prm", "cells 28, 29; 32 without it and a GSD"},
                                                            {"max_cfg", "cells 28, 29; 32 without it"},
                                                            {"cfg", "the Read_Cfg buffer"},
                                                            {"set_slave_address", "cell 2E, 00: no"},
                                                            {"freeze", "mode register 0 bit 7"},
                                                            {"sync", "mode register 0 bit 6"},
                                                            {"fail_safe", "mode register 0 bit 13"}};
  const auto found = places.find(init_key);
  return found == places.end() ? "" : found->second;
}

/// The RAM does not hold the longest blocks: what neither scenario nor GSD limits has this many bytes.
constexpr std::uint8_t kUsualBlock = 32;

user_cpu::StationConfig within_ram(user_cpu::StationConfig station, const scenario::Slave& slave) {
  const bool unlimited = slave.gsd.empty();
  if (unlimited && !slave.init.max_diag) station.max_diag = kUsualBlock;
  if (unlimited && !slave.init.max_prm) station.max_prm = kUsualBlock;
  if (!slave.init.max_cfg) station.max_cfg = std::max(kUsualBlock, static_cast<std::uint8_t>(station.cfg.size()));
  return station;
}

MakeSpc3ArmUser arm_maker = nullptr;

MakeUser Spc3Kind::make_user(const UserRequest& request) const {
  const Spc3User& own = spc3_user_of(request.slave.user_cpu);
  auto& bus = static_cast<user_cpu::HostBus&>(*request.chip.user_side());
  if (own.kind == Spc3Cpu::kArm) {
    if (arm_maker != nullptr) return arm_maker(request, bus);
    throw InputError(request.scenario.file, request.slave.user_cpu.line,
                     "kind is arm, but this program has no ARM board, allowed without it is native");
  }
  auto firmware = static_cast<const spc3_user::FirmwareOptions&>(own);
  firmware.vpc3 = variant_ == Variant::kVpc3;
  const auto& chip = static_cast<const Spc3Settings&>(*request.slave.chip);
  if (chip.bus == spc3::Bus::kSpi) {
    firmware.spi_timing = spi_timing_of(own.spi);
    firmware.spi_timing->mode = chip.spi_mode;
  }
  user_cpu::CpuTiming timing;
  timing.access = own.access;
  timing.overhead = own.overhead;
  timing.interrupt_latency = own.interrupt_latency;
  bus.set_wait({own.wait, true});
  return [&slave = request.slave, timing, firmware, &bus](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<spc3_user::NativeUser>(bus, timing, firmware,
                                                   program_options(slave.user_cpu, within_ram(station, slave)), start);
  };
}

}  // namespace

void set_spc3_arm_maker(MakeSpc3ArmUser make) { arm_maker = make; }

const ChipKind& kind_of(Variant variant) {
  static const std::array<Spc3Kind, spc3::kVariants.size()> kinds = {Spc3Kind(Variant::kApc3), Spc3Kind(Variant::kSpc3),
                                                                     Spc3Kind(Variant::kVpc3)};
  return kinds.at(static_cast<std::size_t>(variant));
}

}  // namespace dsdpv1::tb
