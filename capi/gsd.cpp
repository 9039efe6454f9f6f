// GSD files.
#include "bus/gsd/gsd.hpp"

#include <algorithm>
#include <memory>
#include <sstream>

#include "bus/gsd/report.hpp"
#include "bus/gsd/setup.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "capi/slave.hpp"
#include "dsdpv1/gsd.h"
#include "io/input/read_file.hpp"

using capi::fail;
using capi::guarded;
using capi::need;

struct dpsim_gsd {
  bus::Gsd gsd;
  std::vector<bus::GsdDiagnostic> remarks;
  std::string text;  ///< of the last call that returned one
};

namespace {

using Diagnostics = std::vector<bus::GsdDiagnostic>;

std::string lines_of(const Diagnostics& diagnostics, bus::GsdDiagnostic::Level level) {
  std::string lines;
  for (const bus::GsdDiagnostic& each : diagnostics)
    if (each.level == level) lines += (lines.empty() ? "" : "\n") + bus::to_string(each);
  return lines;
}

[[noreturn]] void fail_with(const Diagnostics& diagnostics) {
  fail(DPSIM_ERR_INPUT, lines_of(diagnostics, bus::GsdDiagnostic::Level::kError));
}

std::unique_ptr<dpsim_gsd> parse(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  bus::GsdResult result = bus::parse_gsd(in, name);
  if (!result.gsd) fail_with(result.diagnostics);
  return std::make_unique<dpsim_gsd>(dpsim_gsd{std::move(*result.gsd), std::move(result.diagnostics), ""});
}

bus::GsdChoice choice_of(const char* const* modules, std::size_t count) {
  capi::need_buffer(modules, count, "modules");
  bus::GsdChoice choice;
  for (std::size_t i = 0; i < count; ++i) {
    need(modules[i], "a module");
    choice.modules.emplace_back(modules[i]);
  }
  return choice;
}

bus::SlaveParameters parameters_of(const bus::Gsd& gsd, const bus::GsdSetup& setup, std::uint32_t flags) {
  bus::SlaveParameters parameters;
  parameters.ident = gsd.ident;
  parameters.user_prm = setup.user_prm;
  parameters.cfg = setup.chk_cfg;
  parameters.input_length = setup.lengths.input;
  parameters.output_length = setup.lengths.output;
  parameters.min_slave_interval_us = gsd.min_slave_interval.value_or(0) * 100;
  if ((flags & DPSIM_PRM_DPV1) == 0) return parameters;
  const std::string why = bus::enable_dpv1(gsd, parameters);
  if (!why.empty()) fail(DPSIM_ERR_INPUT, gsd.file + ": " + why);
  return parameters;
}

dpsim_gsd_info info_of(const bus::Gsd& gsd) {
  dpsim_gsd_info info{};
  info.ident = gsd.ident;
  info.revision = static_cast<std::uint8_t>(gsd.revision);
  info.dpv1 = gsd.dpv1 ? 1 : 0;
  for (std::size_t i = 0; i < gsd.bauds.size(); ++i)
    if (gsd.bauds[i].supported) info.bauds |= 1U << i;
  info.modules = static_cast<std::uint32_t>(gsd.modules.size());
  info.vendor = gsd.vendor.c_str();
  info.model = gsd.model.c_str();
  return info;
}

}  // namespace

dpsim_status dpsim_gsd_load(const char* path, dpsim_gsd** gsd) {
  return guarded(
      __func__,
      [&] {
        need(path, "path");
        need(gsd, "gsd");
        *gsd = parse(tb::read_file(path, tb::kGsdFile), path).release();
      });
}

dpsim_status dpsim_gsd_parse(const char* text, size_t length, const char* name, dpsim_gsd** gsd) {
  return guarded(
      __func__,
      [&] {
        capi::need_buffer(text, length, "text");
        need(name, "name");
        need(gsd, "gsd");
        *gsd = parse(length == 0 ? std::string() : std::string(text, length), name).release();
      });
}

void dpsim_gsd_destroy(dpsim_gsd* gsd) { delete gsd; }

dpsim_status dpsim_gsd_warnings(dpsim_gsd* gsd, const char** text) {
  return guarded(
      __func__,
      [&] {
        need(gsd, "gsd");
        need(text, "text");
        gsd->text = lines_of(gsd->remarks, bus::GsdDiagnostic::Level::kWarning);
        *text = gsd->text.c_str();
      });
}

dpsim_status dpsim_gsd_get_info(dpsim_gsd* gsd, dpsim_gsd_info* info) {
  return guarded(
      __func__,
      [&] {
        need(gsd, "gsd");
        capi::give(info_of(gsd->gsd), info, "info");
      });
}

dpsim_status dpsim_gsd_module(dpsim_gsd* gsd, size_t index, const char** name) {
  return guarded(
      __func__,
      [&] {
        need(gsd, "gsd");
        need(name, "name");
        if (index >= gsd->gsd.modules.size())
          fail(DPSIM_ERR_NOT_FOUND, "the file has no module " + std::to_string(index) + ", it has " +
                                        std::to_string(gsd->gsd.modules.size()));
        *name = gsd->gsd.modules[index].name.c_str();
      });
}

dpsim_status dpsim_gsd_slave(dpsim_gsd* gsd, const char* const* modules, size_t module_count, uint32_t flags,
                             dpsim_slave* slave) {
  return guarded(
      __func__,
      [&] {
        need(gsd, "gsd");
        const bus::GsdSetup setup = bus::set_up(gsd->gsd, choice_of(modules, module_count));
        if (!setup.ok()) fail_with(setup.diagnostics);
        dpsim_slave made = capi::slave_of(parameters_of(gsd->gsd, setup, flags));
        made.flags |= flags;
        capi::give(made, slave, "slave");
      });
}

dpsim_status dpsim_gsd_report(dpsim_gsd* gsd, const char* const* modules, size_t module_count, int32_t json,
                              const char** text) {
  return guarded(
      __func__,
      [&] {
        need(gsd, "gsd");
        need(text, "text");
        const bus::GsdSetup setup = bus::set_up(gsd->gsd, choice_of(modules, module_count));
        if (module_count != 0 && !setup.ok()) fail_with(setup.diagnostics);
        std::ostringstream out;
        bus::print_gsd_report(gsd->gsd, setup, gsd->remarks, out,
                              json != 0 ? bus::GsdFormat::kJson : bus::GsdFormat::kText);
        gsd->text = out.str();
        *text = gsd->text.c_str();
      });
}
