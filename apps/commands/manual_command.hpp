#pragma once
// manual, completion: the program's own options as a manual page and as completions of shells, so that neither can go
// stale.
#include <string>

namespace CLI {
class App;
}

namespace dsdpv1::app {

/// The manual page in roff, for man(1).
std::string manual_page(const CLI::App& app);
/// Completion for `shell`, bash or zsh; throws InputError for others.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace dsdpv1::app
