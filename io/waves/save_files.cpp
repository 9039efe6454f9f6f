#include "io/waves/save_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "io/output/write_file.hpp"
#include "io/waves/wave_reader.hpp"
#include "io/waves/wave_selection.hpp"

namespace dsdpv1::tb {
namespace {

/// 2^31 ps for 200 points of the screen, some 10 ms in a window: GTKWave has no "zoom to all", unlike Surfer.
constexpr double kZoom = -31;

/// The viewers' name of a signal.
struct Shown {
  std::string path;   ///< "demo.A"
  std::string range;  ///< "[10:0]"; empty: a single wire, or words
};

/// A scope, or a group of its signals, with its content.
struct Section {
  std::string title;
  bool is_scope = true;
  std::vector<Shown> signals = {};
  std::vector<Section> inner = {};
};

using Variables = std::vector<const WaveVariable*>;

Shown shown(const WaveDeclarations& declared, const WaveVariable& variable) {
  const std::uint32_t width = declared.signals[variable.signal].width;
  const std::string& scope = declared.scopes[variable.scope];
  return {scope.empty() ? variable.name : scope + "." + variable.name,
          width > 1 ? fmt::format("[{}:0]", width - 1) : ""};
}

/// Removes and returns those of `variables` that the group names, in its order.
Section take(const SignalGroup& group, const WaveDeclarations& declared, Variables& variables) {
  Section section{group.title, false};
  for (const std::string& name : group.signals) {
    const auto found =
        std::find_if(variables.begin(), variables.end(), [&](const WaveVariable* each) { return each->name == name; });
    if (found == variables.end()) continue;
    section.signals.push_back(shown(declared, **found));
    variables.erase(found);
  }
  return section;
}

Variables variables_in(const WaveDeclarations& declared, std::size_t scope) {
  Variables variables;
  for (const WaveVariable& each : declared.variables)
    if (each.scope == scope) variables.push_back(&each);
  return variables;
}

std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

Section plain(const WaveDeclarations& declared, std::size_t scope) {
  Section section{last_word(declared.scopes[scope])};
  for (const WaveVariable* each : variables_in(declared, scope)) section.signals.push_back(shown(declared, *each));
  return section;
}

Section station(const WaveDeclarations& declared, std::size_t scope, const std::vector<SignalGroup>& groups) {
  Section section{declared.scopes[scope]};
  Variables rest = variables_in(declared, scope);
  for (const SignalGroup& group : groups) {
    Section taken = take(group, declared, rest);
    if (!taken.signals.empty()) section.inner.push_back(std::move(taken));
  }
  for (const WaveVariable* each : rest) section.signals.push_back(shown(declared, *each));
  if (!section.inner.empty() && !section.signals.empty()) {  // signals without a group come after the groups
    section.inner.push_back({"states", false, std::move(section.signals)});
    section.signals.clear();
  }
  for (std::size_t i = 0; i < declared.scopes.size(); ++i) {
    const std::string& inner = declared.scopes[i];
    if (inner.rfind(section.title + ".", 0) != 0 || inner.find('.', section.title.size() + 1) != std::string::npos)
      continue;
    Section found = plain(declared, i);
    if (!found.signals.empty()) section.inner.push_back(std::move(found));
  }
  return section;
}

/// A scope with only a clock comes first, the others in order of declaration.
std::vector<Section> sections_of(const WaveDeclarations& declared, const std::vector<SignalGroup>& groups) {
  std::vector<Section> sections;
  for (std::size_t i = 0; i < declared.scopes.size(); ++i) {
    const std::string& scope = declared.scopes[i];
    if (scope.empty() || scope.find('.') != std::string::npos) continue;
    Section section = station(declared, i, groups);
    if (section.signals.empty() && section.inner.empty()) continue;
    sections.insert(scope == kClockScope ? sections.begin() : sections.end(), std::move(section));
  }
  return sections;
}

/// A scope is a group, which can be folded; a comment precedes each group of signals in it.
std::string gtkwave_text(const Section& section) {
  constexpr const char *kWire = "@28", *kHexadecimal = "@22";
  std::string text = fmt::format("{}\n-{}\n", section.is_scope ? "@800200" : "@200", section.title);
  for (const Shown& each : section.signals)
    text += fmt::format("{}\n{}{}\n", each.range.empty() ? kWire : kHexadecimal, each.path, each.range);
  for (const Section& each : section.inner) text += gtkwave_text(each);
  return section.is_scope ? text + fmt::format("@1000200\n-{}\n", section.title) : text;
}

/// Its commands have groups only for whole scopes, so a divider begins each.
std::string surfer_text(const Section& section, const std::string& prefix) {
  const std::string title = prefix + section.title;
  std::string text;
  if (!section.signals.empty()) text += fmt::format("divider_add {}\n", title);
  for (const Shown& each : section.signals) text += fmt::format("variable_add {}\n", each.path);
  for (const Section& each : section.inner) text += surfer_text(each, title + ":");
  return text;
}

}  // namespace

SaveFiles save_files_of(const std::string& wave) {
  const std::filesystem::path path(wave);
  const auto with = [&path](const char* ending) {
    return std::filesystem::path(path).replace_extension(ending).string();
  };
  return {with(".gtkw"), with(".sucl")};
}

void write_save_files(const std::string& wave, const std::vector<SignalGroup>& groups) {
  const std::unique_ptr<WaveReader> reader = read_wave(wave);
  const std::vector<Section> sections = sections_of(reader->declarations(), groups);
  std::string gtkwave = fmt::format("[*] dsdpv1-sim\n[dumpfile] \"{}\"\n[timestart] 0\n*{:.1f} -1\n",
                                    std::filesystem::absolute(wave).lexically_normal().string(), kZoom);
  std::string surfer;
  for (const Section& each : sections) {
    gtkwave += gtkwave_text(each);
    surfer += surfer_text(each, "");
  }
  const SaveFiles files = save_files_of(wave);
  write_file(files.gtkwave, gtkwave);
  write_file(files.surfer, surfer + "zoom_fit\n");
}

}  // namespace dsdpv1::tb
