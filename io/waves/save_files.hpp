#pragma once
// Files for viewers that show a wave with its signals in groups by station, in a useful order.
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// Signals of a station that belong together, by their names in its scope.
struct SignalGroup {
  std::string title;  ///< one word
  std::vector<std::string> signals;
};

/// The files of a wave NAME.vcd or NAME.fst.
struct SaveFiles {
  std::string gtkwave;  ///< NAME.gtkw, a save file
  std::string surfer;   ///< NAME.sucl, a command file
};
SaveFiles save_files_of(const std::string& wave);

/// Writes both for a complete wave. Each scope has first its groups, with the signals that it has, then signals without
/// a group, then its scopes. Deeper scopes are left to the viewer's tree. Throws InputError.
void write_save_files(const std::string& wave, const std::vector<SignalGroup>& groups);

}  // namespace dsdpv1::tb
