#pragma once
// What a master makes of a GSD file, for people and for programs: `dsdpv1-sim gsd FILE [--module NAME|N ...] [--json]`.
#include <iosfwd>
#include <string>
#include <vector>

#include "bus/gsd/gsd.hpp"
#include "bus/gsd/setup.hpp"

namespace dsdpv1::bus {

enum class GsdFormat : std::uint8_t { kText, kJson };

/// Prints ident, names, baud rates, limits, features, modules with their Chk_Cfg and Set_Prm, and the whole Set_Prm and
/// Chk_Cfg of `setup` byte by byte; `remarks` are those of the file, the setup brings its own. `setup` must be made
/// from `gsd`.
void print_gsd_report(const Gsd& gsd, const GsdSetup& setup, const std::vector<GsdDiagnostic>& remarks,
                      std::ostream& out, GsdFormat format);

struct GsdCommand {
  GsdChoice choice;  ///< empty: the modules that the file presets
  GsdFormat format = GsdFormat::kText;
};

/// The command itself: `in` is what `path` holds; prints the report to `out`. Returns 0, or 2 after errors in the file
/// or the choice; then they stand one a line in `err` and `out` is untouched. Limits that the file's own presets break
/// are warnings.
int gsd_command(std::istream& in, const std::string& path, const GsdCommand& command, std::ostream& out,
                std::ostream& err);

}  // namespace dsdpv1::bus
