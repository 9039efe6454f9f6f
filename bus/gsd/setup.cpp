#include "bus/gsd/setup.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "bus/gsd/statement.hpp"

namespace dsdpv1::bus {
namespace {

constexpr int kMaxData = 244;  // bytes of one data exchange in one direction, and of a Chk_Cfg
constexpr std::size_t kMaxUserPrm = 237;

using Modules = std::vector<std::size_t>;

bool has_references(const Gsd& gsd) {
  return std::any_of(
      gsd.modules.begin(), gsd.modules.end(), [](const GsdModule& m) { return m.reference.has_value(); });
}

template <typename Matches>
Modules matching(const Gsd& gsd, const Matches& matches) {
  Modules found;
  for (std::size_t i = 0; i < gsd.modules.size(); ++i)
    if (matches(i)) found.push_back(i);
  return found;
}

Modules with_reference(const Gsd& gsd, std::int64_t number) {
  return matching(
      gsd, [&](std::size_t i) { return gsd.modules[i].reference == number; });
}

Modules candidates(const Gsd& gsd, const std::string& name) {
  const std::string wanted(gsd::trim(name));
  Modules found = matching(gsd, [&](std::size_t i) { return gsd.modules[i].name == wanted; });
  if (!found.empty()) return found;
  found = matching(gsd, [&](std::size_t i) { return gsd::lower(gsd.modules[i].name) == gsd::lower(wanted); });
  const auto number = gsd::to_number(wanted);
  if (!found.empty() || !number) return found;
  if (has_references(gsd)) return with_reference(gsd, *number);
  return matching(gsd, [&](std::size_t i) { return static_cast<std::int64_t>(i) + 1 == *number; });
}

/// Some names to choose from, for messages.
std::string some_modules(const Gsd& gsd) {
  constexpr std::size_t kShown = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(kShown, gsd.modules.size()); ++i)
    list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", gsd.modules[i].name);
  return gsd.modules.size() > kShown ? list + ", ..." : list;
}

/// Writes parameters into bytes and records the field at each place.
class PrmBuilder {
 public:
  PrmBuilder(const Gsd& gsd, const Modules& modules, const std::vector<GsdOverride>& overrides)
      : gsd_(gsd), modules_(modules), overrides_(overrides) {}

  void add(const GsdPrmBlock& block, std::optional<std::size_t> module) {
    const std::size_t base = result_.bytes.size();
    result_.bytes.resize(base + prm_length(gsd_, block));
    for (const GsdPrmConst& constant : block.constants) {
      const std::size_t at = base + static_cast<std::size_t>(constant.offset);
      std::copy(constant.bytes.begin(), constant.bytes.end(), result_.bytes.begin() + static_cast<std::ptrdiff_t>(at));
      result_.fields.push_back({at, constant.bytes.size(), module, nullptr, 0, {}});
    }
    for (const GsdPrmRef& ref : block.refs)
      add_parameter(gsd_.parameters.at(ref.parameter), base + static_cast<std::size_t>(ref.offset), module);
  }

  GsdUserPrm finish() {
    for (std::size_t i = 0; i < overrides_.size(); ++i) {
      if (used_.count(i) == 0)
        fail(0, fmt::format("{} has no parameter \"{}\"{}", owner(overrides_[i].module), overrides_[i].parameter,
                            offered(overrides_[i].module)));
    }
    return std::move(result_);
  }

 private:
  void add_parameter(const GsdParameter& parameter, std::size_t at, std::optional<std::size_t> module) {
    std::int64_t value = module && is_slot_number(parameter) ? slot(parameter, *module) : parameter.preset;
    for (std::size_t i = 0; i < overrides_.size(); ++i) {
      if (overrides_[i].module != module || !names(overrides_[i], parameter)) continue;
      used_.insert(i);
      value = overridden(overrides_[i], parameter);
    }
    store(parameter, at, value);
    result_.fields.push_back(
        {at, static_cast<std::size_t>(size_of(parameter.type)), module, &parameter, value, text(parameter, value)});
  }

  /// ISO 15745-3 writes the name both ways.
  static bool is_slot_number(const GsdParameter& parameter) {
    const std::string name = gsd::lower(parameter.name);
    return name == "[slotnumber]" || name == "[slot_number]";
  }

  /// The slot of a module, or the default after a reported error.
  std::int64_t slot(const GsdParameter& parameter, std::size_t module) {
    const std::int64_t number = module < gsd_.slots.size()
                                    ? gsd_.slots[module].number
                                    : gsd_.module_offset.value_or(1) + static_cast<std::int64_t>(module);
    if (takes(parameter, number)) return number;
    fail(parameter.line, fmt::format("{} is in slot {}, \"{}\" allows {}", owner(module), number, parameter.name,
                                     allowed_words(parameter)));
    return parameter.preset;
  }

  static bool names(const GsdOverride& change, const GsdParameter& parameter) {
    return change.parameter == parameter.name || gsd::to_number(change.parameter) == parameter.number;
  }

  const std::map<std::int64_t, std::string>* texts(const GsdParameter& parameter) const {
    return parameter.text_ref ? &gsd_.prm_texts.at(*parameter.text_ref) : nullptr;
  }

  std::string text(const GsdParameter& parameter, std::int64_t value) const {
    const auto* list = texts(parameter);
    if (list == nullptr) return {};
    const auto found = list->find(value);
    return found == list->end() ? std::string() : found->second;
  }

  std::optional<std::int64_t> value_of(const GsdOverride& change, const GsdParameter& parameter) const {
    if (const auto* list = texts(parameter)) {
      for (const auto& [value, words] : *list)
        if (words == change.value) return value;
    }
    return gsd::to_number(change.value);
  }

  /// The changed value, or the default after a reported error.
  std::int64_t overridden(const GsdOverride& change, const GsdParameter& parameter) {
    const auto value = value_of(change, parameter);
    if (value && takes(parameter, *value)) return *value;
    fail(parameter.line, fmt::format(R"("{}" is no value for "{}", {} is allowed)", change.value, parameter.name,
                                     allowed_words(parameter)));
    return parameter.preset;
  }

  static GsdRange whole(const GsdParameter& parameter) {
    return range_of(parameter.type, parameter.last_bit - parameter.first_bit + 1);
  }

  static bool takes(const GsdParameter& parameter, std::int64_t value) {
    const auto holds = [&](const GsdRange& range) { return value >= range.low && value <= range.high; };
    const auto& allowed = parameter.allowed;
    return holds(whole(parameter)) && (allowed.empty() || std::any_of(allowed.begin(), allowed.end(), holds));
  }

  static std::string allowed_words(const GsdParameter& parameter) {
    std::string list;
    for (const GsdRange& range :
         parameter.allowed.empty() ? std::vector<GsdRange>{whole(parameter)} : parameter.allowed) {
      if (!list.empty()) list += ", ";
      list += range.low == range.high ? fmt::format("{}", range.low) : fmt::format("{} to {}", range.low, range.high);
    }
    return list;
  }

  /// Stores bytes most significant first; bits leave the rest of their byte unchanged.
  void store(const GsdParameter& parameter, std::size_t at, std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    if (parameter.type == GsdType::kBit || parameter.type == GsdType::kBitArea) {
      const int width = parameter.last_bit - parameter.first_bit + 1;
      const auto mask = static_cast<unsigned>(((1 << width) - 1) << parameter.first_bit);
      const auto moved = static_cast<unsigned>(bits << static_cast<unsigned>(parameter.first_bit));
      result_.bytes[at] = static_cast<std::uint8_t>((result_.bytes[at] & ~mask) | (moved & mask));
      return;
    }
    const int size = size_of(parameter.type);
    for (int i = 0; i < size; ++i) {
      result_.bytes[at + static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(bits >> static_cast<unsigned>(8 * (size - 1 - i)));
    }
  }

  std::string owner(std::optional<std::size_t> module) const {
    if (!module) return "the station";
    if (*module >= modules_.size()) return fmt::format("module {}", *module + 1);
    return fmt::format("module {} \"{}\"", *module + 1, gsd_.modules.at(modules_[*module]).name);
  }

  std::string offered(std::optional<std::size_t> module) const {
    std::string list;
    for (const GsdPrmField& field : result_.fields)
      if (field.parameter != nullptr && field.module == module) list += fmt::format(", \"{}\"", field.parameter->name);
    return list.empty() ? ", it has none" : fmt::format(", it has {}", list.substr(2));
  }

  void fail(int line, std::string what) {
    result_.diagnostics.push_back({GsdDiagnostic::Level::kError, gsd_.file, line, std::move(what)});
  }

  const Gsd& gsd_;
  const Modules& modules_;
  const std::vector<GsdOverride>& overrides_;
  std::set<std::size_t> used_;
  GsdUserPrm result_;
};

/// Checks a setup against the file and the protocol.
class Limits {
 public:
  Limits(const Gsd& gsd, GsdSetup& setup) : gsd_(gsd), setup_(setup) {}

  void check(bool chosen) {
    check_count();
    if (chosen) check_slots();
    check_cfg();
    check_lengths();
    check_prm();
  }

 private:
  void error(std::string text) {
    setup_.diagnostics.push_back({GsdDiagnostic::Level::kError, gsd_.file, 0, std::move(text)});
  }

  void check_count() {
    const auto count = static_cast<int>(setup_.modules.size());
    const int most = gsd_.modular ? gsd_.max_modules.value_or(kMaxData) : std::max(1, gsd_.max_modules.value_or(1));
    if (count == 0) error("no module is chosen, at least one is needed");
    if (count > most) error(fmt::format("{} modules are chosen, 1 to {} are allowed", count, most));
  }

  void check_slots() {
    if (gsd_.slots.empty()) return;
    if (setup_.modules.size() > gsd_.slots.size())
      error(fmt::format("{} modules are chosen, the station has {} slots", setup_.modules.size(), gsd_.slots.size()));
    for (std::size_t i = 0; i < std::min(setup_.modules.size(), gsd_.slots.size()); ++i)
      check_slot(gsd_.slots[i], setup_.modules[i]);
  }

  void check_slot(const GsdSlot& slot, std::size_t index) {
    const GsdModule& module = gsd_.modules[index];
    const auto takes = [&](const GsdRange& range) {
      return module.reference && *module.reference >= range.low && *module.reference <= range.high;
    };
    if (slot.allowed.empty() || module.reference == slot.preset) return;
    if (std::none_of(slot.allowed.begin(), slot.allowed.end(), takes)) {
      error(fmt::format("module \"{}\" does not fit slot {}, line {} says which modules are allowed", module.name,
                        slot.number, slot.line));
    }
  }

  void check_cfg() {
    const std::size_t size = setup_.chk_cfg.size();
    if (size > kMaxData) error(fmt::format("Chk_Cfg has {} bytes, 1 to {} are allowed", size, kMaxData));
    if (!setup_.lengths.ok()) error(setup_.lengths.error);
  }

  bool check_length(const char* what, int bytes, std::optional<int> limit, const char* keyword, int most) {
    if (bytes > most)
      error(fmt::format("{} are {} bytes, 0 to {} are allowed", what, bytes, most));
    else if (limit && bytes > *limit)
      error(fmt::format("{} are {} bytes, {} = {} is the most", what, bytes, keyword, *limit));
    else
      return true;
    return false;
  }

  void check_lengths() {
    const CfgLengths& data = setup_.lengths;
    const bool input = check_length("inputs", data.input, gsd_.max_input, "Max_Input_Len", kMaxData);
    const bool output = check_length("outputs", data.output, gsd_.max_output, "Max_Output_Len", kMaxData);
    if (!input || !output) return;
    check_length("inputs and outputs", data.input + data.output, gsd_.max_data, "Max_Data_Len", 2 * kMaxData);
  }

  /// Max_User_Prm_Data_Len is only a warning: files give it with and without the modules' parameters.
  void check_prm() {
    const std::size_t size = setup_.user_prm.size();
    if (size > kMaxUserPrm)
      error(fmt::format("the user parameters have {} bytes, 0 to {} are allowed", size, kMaxUserPrm));
    if (!gsd_.max_user_prm || static_cast<int>(size) <= *gsd_.max_user_prm) return;
    setup_.diagnostics.push_back(
        {GsdDiagnostic::Level::kWarning, gsd_.file, 0,
         fmt::format("the user parameters have {} bytes, Max_User_Prm_Data_Len = {}", size, *gsd_.max_user_prm)});
  }

  const Gsd& gsd_;
  GsdSetup& setup_;
};

/// The modules of a choice; reports those not found.
Modules chosen_modules(const Gsd& gsd, const std::vector<std::string>& names, std::vector<GsdDiagnostic>& diagnostics) {
  Modules modules;
  for (const std::string& module_name : names) {
    std::string why;
    const auto found = find_module(gsd, module_name, why);
    if (found)
      modules.push_back(*found);
    else
      diagnostics.push_back({GsdDiagnostic::Level::kError, gsd.file, 0, why});
  }
  return modules;
}

/// A station's modules, and where those of the choice stand among them.
struct Station {
  Modules modules;
  std::vector<std::size_t> places;
};

Station station_of(const Gsd& gsd, const Modules& chosen) {
  Station station;
  if (gsd.fix_preset_modules) station.modules = matching(gsd, [&](std::size_t i) { return gsd.modules[i].preset; });
  Modules fixed = station.modules;
  for (const std::size_t module : chosen) {
    const auto at = std::find(fixed.begin(), fixed.end(), module);
    if (at != fixed.end()) {
      station.places.push_back(static_cast<std::size_t>(at - fixed.begin()));
      *at = gsd.modules.size();  // once: another one is added
    } else {
      station.places.push_back(station.modules.size());
      station.modules.push_back(module);
    }
  }
  return station;
}

/// The overrides with positions in the station. A position beyond the choice stays one.
std::vector<GsdOverride> in_station(std::vector<GsdOverride> overrides, const Station& station) {
  for (GsdOverride& change : overrides)
    if (change.module)
      change.module = *change.module < station.places.size() ? station.places[*change.module] : station.modules.size();
  return overrides;
}

}  // namespace

bool GsdSetup::ok() const {
  return std::none_of(
      diagnostics.begin(), diagnostics.end(), [](const auto& d) { return d.level == GsdDiagnostic::Level::kError; });
}

Modules preset_modules(const Gsd& gsd) {
  Modules presets;
  for (const GsdSlot& slot : gsd.slots) {
    const Modules found = slot.preset != 0 ? with_reference(gsd, slot.preset) : Modules{};
    if (!found.empty()) presets.push_back(found.front());
  }
  if (presets.empty()) presets = matching(gsd, [&](std::size_t i) { return gsd.modules[i].preset; });
  if (presets.empty() && !gsd.modular && gsd.modules.size() == 1) presets.push_back(0);
  return presets;
}

std::optional<std::size_t> find_module(const Gsd& gsd, const std::string& name, std::string& why) {
  const Modules found = candidates(gsd, name);
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    why = gsd.modules.empty() ? fmt::format("module \"{}\" is unknown, the file defines no modules", name)
                              : fmt::format("module \"{}\" is unknown, {} are allowed", name, some_modules(gsd));
  } else {
    why = fmt::format("\"{}\" is the name of {} modules, choose by {}", name, found.size(),
                      has_references(gsd) ? "module reference number" : "position in the file");
  }
  return std::nullopt;
}

Modules modules_of_station(const Gsd& gsd, const Modules& chosen) { return station_of(gsd, chosen).modules; }

std::size_t prm_length(const Gsd& gsd, const GsdPrmBlock& block) {
  if (block.length) return static_cast<std::size_t>(*block.length);
  std::size_t end = 0;
  for (const GsdPrmConst& constant : block.constants)
    end = std::max(end, static_cast<std::size_t>(constant.offset) + constant.bytes.size());
  for (const GsdPrmRef& ref : block.refs)
    end = std::max(end, static_cast<std::size_t>(ref.offset + size_of(gsd.parameters.at(ref.parameter).type)));
  return end;
}

GsdUserPrm set_prm_user_bytes(const Gsd& gsd, const Modules& modules, const std::vector<GsdOverride>& overrides) {
  PrmBuilder builder(gsd, modules, overrides);
  builder.add(gsd.prm, std::nullopt);
  for (std::size_t i = 0; i < modules.size(); ++i) builder.add(gsd.modules.at(modules[i]).prm, i);
  for (std::size_t i = 0; i < modules.size(); ++i) builder.add(gsd.modules.at(modules[i]).f_prm, i);
  return builder.finish();
}

Bytes chk_cfg_bytes(const Gsd& gsd, const Modules& modules) {
  Bytes cfg;
  for (const std::size_t index : modules) {
    const Bytes& bytes = gsd.modules.at(index).cfg;
    cfg.insert(cfg.end(), bytes.begin(), bytes.end());
  }
  return cfg;
}

Bytes set_prm_bytes(std::uint16_t ident, const SetPrmHead& head, const Bytes& user_prm) {
  const bool watchdog = head.wd_fact_1 != 0 && head.wd_fact_2 != 0;
  const int status = (head.lock ? 0x80 : 0) | (head.unlock ? 0x40 : 0) | (head.sync ? 0x20 : 0) |
                     (head.freeze ? 0x10 : 0) | (watchdog ? 0x08 : 0);
  Bytes bytes = {static_cast<std::uint8_t>(status),
                 head.wd_fact_1,
                 head.wd_fact_2,
                 head.min_tsdr,
                 static_cast<std::uint8_t>(ident >> 8U),
                 static_cast<std::uint8_t>(ident & 0xFFU),
                 head.group};
  std::copy(user_prm.begin(), user_prm.end(), std::back_inserter(bytes));
  return bytes;
}

GsdSetup set_up(const Gsd& gsd, const GsdChoice& choice) {
  GsdSetup setup;
  const bool chosen = !choice.modules.empty();
  const Station station =
      station_of(gsd, chosen ? chosen_modules(gsd, choice.modules, setup.diagnostics) : preset_modules(gsd));
  setup.modules = station.modules;
  if (!setup.ok()) return setup;
  GsdUserPrm prm = set_prm_user_bytes(gsd, setup.modules, in_station(choice.overrides, station));
  setup.user_prm = std::move(prm.bytes);
  setup.fields = std::move(prm.fields);
  setup.diagnostics.insert(setup.diagnostics.end(), prm.diagnostics.begin(), prm.diagnostics.end());
  setup.chk_cfg = chk_cfg_bytes(gsd, setup.modules);
  setup.lengths = cfg_lengths(setup.chk_cfg);
  Limits(gsd, setup).check(chosen);
  return setup;
}

}  // namespace dsdpv1::bus
