#pragma once
// A GSD file as seen by a master, as text or JSON: `dsdpv1-sim gsd FILE [--module NAME|N ...] [--json]`.
#include <iosfwd>
#include <string>
#include <vector>

#include "bus/gsd/gsd.hpp"
#include "bus/gsd/setup.hpp"

namespace dsdpv1::bus {

enum class GsdFormat : std::uint8_t { kText, kJson };

/// Prints ident, names, baud rates, limits, features, modules with their Chk_Cfg and Set_Prm, and the complete Set_Prm
/// and Chk_Cfg of `setup` byte by byte; `remarks` are those about the file, in addition to the setup's. `setup` must be
/// made from `gsd`.
void print_gsd_report(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks,
                      std::ostream& out, GsdFormat format);

struct GsdCommand {
  GsdChoice choice;  ///< empty: the modules that the file presets
  GsdFormat format = GsdFormat::kText;
};

/// The command: `in` is the content of `path`; prints the report to `out`. Returns 0, or 2 after errors in the file or
/// the choice, which are written to `err`, one per line, and leave `out` untouched. Limits violated by the file's
/// presets are warnings.
int gsd_command(std::istream& in, const std::string& path, const GsdCommand& command, std::ostream& out,
                std::ostream& err);

}  // namespace dsdpv1::bus
