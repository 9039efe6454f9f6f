#include "bus/gsd/report.hpp"

#include <fmt/format.h>

#include <istream>
#include <ostream>

#include "bus/gsd/report_data.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus {
namespace gsd {
namespace {

using detail::hex;

/// A report of many short lines; omits empty values.
class TextReport {
 public:
  TextReport(const Gsd& gsd, std::ostream& out) : gsd_(gsd), out_(out) {}

  void print(const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks) {
    print_identity();
    print_rates();
    print_limits();
    print_slots();
    print_modules();
    print_setup(setup);
    print_remarks(remarks, setup.diagnostics);
  }

 private:
  void line(const std::string& text) { out_ << printable(text) << '\n'; }
  void entry(std::string_view key, const std::string& value) {
    if (!value.empty()) line(fmt::format("  {:<22} {}", key, value));
  }

  void print_identity() {
    line(fmt::format("{}: {}", gsd_.file,
                     gsd_.is_master ? "a DP master"
                     : gsd_.modular ? "a modular DP slave"
                                    : "a fixed DP slave"));
    entry("Ident_Number", fmt::format("0x{:04X}", gsd_.ident));
    entry("GSD_Revision", gsd_.revision == 0 ? "not given" : fmt::format("{}", gsd_.revision));
    entry("Vendor_Name", gsd_.vendor);
    entry("Model_Name", gsd_.model);
    entry("Revision", gsd_.device_revision);
    entry("Hardware_Release", gsd_.hardware_release);
    entry("Software_Release", gsd_.software_release);
    entry("OrderNumber", gsd_.order_number);
    entry("Implementation_Type", gsd_.implementation);
    entry("Slave_Family", gsd_.slave_family);
    entry("Info_Text", gsd_.info_text);
  }

  void print_rates() {
    line("Baud rates (kbit/s, M: Mbit/s) and MaxTsdr in bit times");
    for (int i = kBaudCount - 1; i >= 0; --i) {
      const GsdBaud& rate = gsd_.bauds[static_cast<std::size_t>(i)];
      print_rate(gsd_baud_name(i), rate);
    }
    print_rate("31.25 (PROFIBUS PA)", gsd_.pa);
  }

  void print_rate(std::string_view rate, const GsdBaud& baud) {
    if (baud.supported) entry(rate, baud.max_tsdr ? fmt::format("{}", *baud.max_tsdr) : "not given");
  }

  void print_limits() {
    line("Limits");
    for (const auto& [keyword, value] : limits(gsd_))
      entry(keyword, fmt::format("{}{}", value, keyword == "Min_Slave_Intervall" ? " x 100 us" : ""));
    line("Features");
    for (const auto& [keyword, given] : features(gsd_)) entry(keyword, given ? "yes" : "no");
  }

  void print_slots() {
    if (!gsd_.slots.empty()) line("Slots");
    for (const GsdSlot& slot : gsd_.slots) {
      const std::string preset = slot.preset == 0 ? "empty" : fmt::format("module {}", slot.preset);
      entry(fmt::format("{}", slot.number), fmt::format("\"{}\", preset {}", slot.name, preset));
    }
  }

  void print_modules() {
    if (!gsd_.modules.empty()) line("Modules");
    for (std::size_t i = 0; i < gsd_.modules.size(); ++i) print_module(i);
  }

  void print_module(std::size_t index) {
    const GsdModule& module = gsd_.modules[index];
    const GsdSetup setup = alone(gsd_, index);
    line(fmt::format("  {} \"{}\"{}", module.reference.value_or(static_cast<int>(index) + 1), module.name,
                     module.preset ? ", preset" : ""));
    entry("  Chk_Cfg", hex(module.cfg));
    for (const CfgIdentifier& identifier : setup.lengths.identifiers) entry("", bus::describe(identifier));
    entry("  lengths", setup.lengths.ok()
                           ? fmt::format("input {} bytes, output {} bytes", setup.lengths.input, setup.lengths.output)
                           : setup.lengths.error);
    entry("  Set_Prm with it alone", hex(set_prm_bytes(gsd_.ident, {}, setup.user_prm)));
    for (const GsdPrmField& field : setup.fields)
      entry("", fmt::format("byte {}: {}", 7 + field.position, gsd::describe(field)));
  }

  void print_setup(const GsdSetup& setup) {
    if (setup.modules.empty()) {
      line("No module is preset: --module NAME or --module NUMBER chooses those of a station");
      return;
    }
    line("What a master sends to a station with");
    for (std::size_t i = 0; i < setup.modules.size(); ++i)
      entry(fmt::format("module {}", i + 1), fmt::format("\"{}\"", gsd_.modules[setup.modules[i]].name));
    const Bytes prm = set_prm_bytes(gsd_.ident, {}, setup.user_prm);
    print_telegram("Set_Prm (SAP 61)", prm, explain_set_prm(gsd_, prm, setup));
    print_telegram("Chk_Cfg (SAP 62)", setup.chk_cfg, explain_chk_cfg(setup.chk_cfg));
    line(fmt::format("Data exchange: {} bytes output to the slave, {} bytes input from it", setup.lengths.output,
                     setup.lengths.input));
  }

  void print_telegram(std::string_view title, const Bytes& data, const std::vector<Explained>& words) {
    line(fmt::format("{}, {} bytes: {}", title, data.size(), hex(data)));
    for (const Explained& part : words) {
      const auto first = data.begin() + static_cast<std::ptrdiff_t>(part.position);
      const Bytes shown(first, first + static_cast<std::ptrdiff_t>(part.size));
      line(fmt::format("  {:>3}  {:<12} {}", part.position, hex(shown), part.words));
    }
  }

  void print_remarks(const std::vector<GsdDiagnostic>& file, const std::vector<GsdDiagnostic>& setup) {
    if (file.empty() && setup.empty()) return;
    line("Warnings");
    for (const auto* list : {&file, &setup})
      for (const GsdDiagnostic& remark : *list) line("  " + to_string(remark));
  }

  const Gsd& gsd_;
  std::ostream& out_;
};

}  // namespace

void print_text(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks, std::ostream& out) {
  TextReport(gsd, out).print(setup, remarks);
}

}  // namespace gsd

namespace {

int fail(const std::vector<GsdDiagnostic>& diagnostics, std::ostream& err) {
  for (const GsdDiagnostic& diagnostic : diagnostics)
    if (diagnostic.level == GsdDiagnostic::Level::kError) err << printable(to_string(diagnostic)) << '\n';
  return 2;
}

/// These modules are the file's presets, so their violations are remarks about the file.
void soften(GsdSetup& setup) {
  if (setup.modules.empty()) setup.diagnostics.clear();
  for (GsdDiagnostic& diagnostic : setup.diagnostics) diagnostic.level = GsdDiagnostic::Level::kWarning;
}

}  // namespace

void print_gsd_report(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks,
                      std::ostream& out, GsdFormat format) {
  if (format == GsdFormat::kJson)
    gsd::print_json(gsd, setup, remarks, out);
  else
    gsd::print_text(gsd, setup, remarks, out);
}

int gsd_command(std::istream& in, const std::string& path, const GsdCommand& command, std::ostream& out,
                std::ostream& err) {
  const GsdResult result = parse_gsd(in, path);
  if (!result.gsd) return fail(result.diagnostics, err);
  GsdSetup setup = set_up(*result.gsd, command.choice);
  const bool chosen = !command.choice.modules.empty() || !command.choice.overrides.empty();
  if (chosen && !setup.ok()) return fail(setup.diagnostics, err);
  if (!chosen) soften(setup);
  print_gsd_report(*result.gsd, setup, result.diagnostics, out, command.format);
  return 0;
}

}  // namespace dsdpv1::bus
