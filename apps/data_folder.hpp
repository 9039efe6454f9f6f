#pragma once
#include <string>
#include <vector>

namespace dsdpv1::app {

/// The folder with scenarios/, traces/, rtl_ref/ and so on, under the names that they have in the source tree:
/// share/dsdpv1 where this program is installed, wherever that has been moved; for a program in its build folder the
/// source tree.
std::string data_folder();

/// The folder in it with the golden traces.
std::string golden_folder();

/// The documents in it with the rulings of a kind of chip.
std::vector<std::string> ruling_documents(const std::string& chip);

}  // namespace dsdpv1::app
