#include <nlohmann/json.hpp>

#include <ostream>

#include <fmt/format.h>

#include "bus/gsd/report_data.hpp"
#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::gsd {
namespace {

using Json = nlohmann::ordered_json;

Json identity(const Gsd& gsd) {
  return {{"file", gsd.file},
          {"gsd_revision", gsd.revision},
          {"ident", gsd.ident},
          {"ident_hex", fmt::format("0x{:04X}", gsd.ident)},
          {"station", gsd.is_master ? "master" : "slave"},
          {"vendor", gsd.vendor},
          {"model", gsd.model},
          {"revision", gsd.device_revision},
          {"hardware_release", gsd.hardware_release},
          {"software_release", gsd.software_release},
          {"order_number", gsd.order_number},
          {"implementation", gsd.implementation},
          {"slave_family", gsd.slave_family},
          {"info_text", gsd.info_text}};
}

Json rates(const Gsd& gsd) {
  Json list = Json::array();
  const auto add = [&](std::string_view name, const GsdBaud& rate) {
    if (rate.supported)
      list.push_back({{"baud", name}, {"max_tsdr_bits", rate.max_tsdr ? Json(*rate.max_tsdr) : Json()}});
  };
  for (int i = kBaudCount - 1; i >= 0; --i) add(gsd_baud_name(i), gsd.bauds[static_cast<std::size_t>(i)]);
  add("31.25", gsd.pa);
  return list;
}

template <typename Pairs>
Json object(const Pairs& pairs) {
  Json result = Json::object();
  for (const auto& [key, value] : pairs) result[key] = value;
  return result;
}

Json direction(const CfgDirection& data) {
  return {{"bytes", data.bytes()}, {"words", data.words}, {"consistent_as_a_whole", data.whole}};
}

Json identifiers(const CfgLengths& lengths) {
  Json list = Json::array();
  for (const CfgIdentifier& identifier : lengths.identifiers) {
    list.push_back({{"position", identifier.position},
                    {"format", identifier.special ? "special" : "compact"},
                    {"input", direction(identifier.input)},
                    {"output", direction(identifier.output)},
                    {"vendor", identifier.vendor},
                    {"text", bus::describe(identifier)}});
  }
  return list;
}

Json parameter(const GsdPrmField& field) {
  const GsdParameter& known = *field.parameter;
  Json allowed = Json::array();
  for (const GsdRange& range : known.allowed) allowed.push_back({range.low, range.high});
  return {{"byte", 7 + field.position},     {"bits", bits(known)},     {"name", known.name}, {"number", known.number},
          {"type", name(known.type)},       {"value", field.value},    {"text", field.text}, {"allowed", allowed},
          {"changeable", known.changeable}, {"visible", known.visible}};
}

Json parameters(const GsdSetup& setup) {
  Json list = Json::array();
  for (const GsdPrmField& field : setup.fields)
    if (field.parameter != nullptr) list.push_back(parameter(field));
  return list;
}

Json module_json(const Gsd& gsd, std::size_t index) {
  const GsdModule& module = gsd.modules[index];
  const GsdSetup setup = alone(gsd, index);
  return {{"number", module.reference.value_or(static_cast<int>(index) + 1)},
          {"name", module.name},
          {"preset", module.preset},
          {"info_text", module.info_text},
          {"chk_cfg", detail::hex(module.cfg)},
          {"input_bytes", setup.lengths.input},
          {"output_bytes", setup.lengths.output},
          {"identifiers", identifiers(setup.lengths)},
          {"set_prm", detail::hex(set_prm_bytes(gsd.ident, {}, setup.user_prm))},
          {"parameters", parameters(setup)}};
}

Json modules(const Gsd& gsd) {
  Json list = Json::array();
  for (std::size_t i = 0; i < gsd.modules.size(); ++i) list.push_back(module_json(gsd, i));
  return list;
}

Json slots(const Gsd& gsd) {
  Json list = Json::array();
  for (const GsdSlot& slot : gsd.slots) {
    Json allowed = Json::array();
    for (const GsdRange& range : slot.allowed) allowed.push_back({range.low, range.high});
    list.push_back({{"number", slot.number}, {"name", slot.name}, {"preset", slot.preset}, {"allowed", allowed}});
  }
  return list;
}

Json telegram(const Bytes& data, const std::vector<Explained>& words) {
  Json explained = Json::array();
  for (const Explained& part : words)
    explained.push_back({{"position", part.position}, {"size", part.size}, {"text", part.words}});
  return {{"bytes", detail::hex(data)}, {"length", data.size()}, {"explained", explained}};
}

/// Null if no module is preset or chosen.
Json selection(const Gsd& gsd, const GsdSetup& setup) {
  if (setup.modules.empty()) return {};
  Json names = Json::array();
  for (const std::size_t index : setup.modules) names.push_back(gsd.modules[index].name);
  const Bytes prm = set_prm_bytes(gsd.ident, {}, setup.user_prm);
  return {{"modules", names},
          {"set_prm", telegram(prm, explain_set_prm(gsd, prm, setup))},
          {"chk_cfg", telegram(setup.chk_cfg, explain_chk_cfg(setup.chk_cfg))},
          {"input_bytes", setup.lengths.input},
          {"output_bytes", setup.lengths.output}};
}

Json remarks_json(const std::vector<GsdDiagnostic>& file, const std::vector<GsdDiagnostic>& setup) {
  Json list = Json::array();
  for (const auto* part : {&file, &setup})
    for (const GsdDiagnostic& remark : *part) list.push_back({{"line", remark.line}, {"text", remark.text}});
  return list;
}

}  // namespace

void print_json(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks, std::ostream& out) {
  Json report = identity(gsd);
  report["bauds"] = rates(gsd);
  report["limits"] = object(limits(gsd));
  report["features"] = object(features(gsd));
  report["slots"] = slots(gsd);
  report["modules"] = modules(gsd);
  report["selection"] = selection(gsd, setup);
  report["warnings"] = remarks_json(remarks, setup.diagnostics);
  out << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace dsdpv1::bus::gsd
