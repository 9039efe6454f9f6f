#pragma once
// Shared by the text and the JSON report. Internal to the GSD report.
#include <string>
#include <utility>
#include <vector>

#include "bus/gsd/setup.hpp"

namespace dsdpv1::bus::gsd {

/// One line of the explanation of a Set_Prm or Chk_Cfg.
struct Explained {
  std::size_t position = 0, size = 1;  ///< bytes of the telegram's data
  std::string words;
};

/// Feature keywords with their values, under the GSD's names.
std::vector<std::pair<std::string, bool>> features(const Gsd& gsd);
/// Limits in the file, under the GSD's names.
std::vector<std::pair<std::string, int>> limits(const Gsd& gsd);

/// "bits 0-1", empty for whole bytes.
std::string bits(const GsdParameter& parameter);
/// "Filter = 2 (60 Hz)".
std::string describe(const GsdPrmField& field);

/// Explains a Set_Prm from `set_prm_bytes`, byte by byte and field by field; `owner` names the module of a field.
std::vector<Explained> explain_set_prm(const Gsd& gsd, const Bytes& set_prm, const GsdSetup& setup);
std::vector<Explained> explain_chk_cfg(const Bytes& chk_cfg);

/// The Set_Prm of a station with one chosen module, without limit checks. Chk_Cfg, lengths and fields are those of the
/// module alone.
GsdSetup alone(const Gsd& gsd, std::size_t module);

void print_text(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks, std::ostream& out);
void print_json(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks, std::ostream& out);

}  // namespace dsdpv1::bus::gsd
