#pragma once
// Files for viewers that show a wave at once as one wants to see it: its signals in groups by station, in an order that
// makes sense.
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// Signals of a station that belong together, by their names in its scope.
struct SignalGroup {
  std::string title;  ///< one word
  std::vector<std::string> signals;
};

/// Of a wave NAME.vcd or NAME.fst.
struct SaveFiles {
  std::string gtkwave;  ///< NAME.gtkw, a save file
  std::string surfer;   ///< NAME.sucl, a command file
};
SaveFiles save_files_of(const std::string& wave);

/// Writes both for a wave that is complete. In each scope the groups come first, of those signals that it has, then
/// what is in no group, then the scopes in it; what stands deeper is left to the viewer's tree. Throws InputError.
void write_save_files(const std::string& wave, const std::vector<SignalGroup>& groups);

}  // namespace dsdpv1::tb
