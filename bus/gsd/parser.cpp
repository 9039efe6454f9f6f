// Blocks of a GSD file and their nesting. bus/gsd/blocks.cpp reads their contents.
#include "bus/gsd/parser.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace dsdpv1::bus::gsd {

struct BlockKind {
  std::string_view name, end;
  std::string_view key, end_key;  ///< in lower case without underscores
  Scope scope;
  bool nests;  ///< may be nested in a Module or UnitDiagType
};

namespace {

constexpr BlockKind kBlocks[] = {
    {"Module", "EndModule", "module", "endmodule", Scope::kModule, false},
    {"PrmText", "EndPrmText", "prmtext", "endprmtext", Scope::kPrmText, false},
    {"ExtUserPrmData", "EndExtUserPrmData", "extuserprmdata", "endextuserprmdata", Scope::kParameter, false},
    {"SlotDefinition", "EndSlotDefinition", "slotdefinition", "endslotdefinition", Scope::kSlots, false},
    {"UnitDiagType", "EndUnitDiagType", "unitdiagtype", "endunitdiagtype", Scope::kKept, false},
    {"Unit_Diag_Area", "Unit_Diag_Area_End", "unitdiagarea", "unitdiagareaend", Scope::kKept, true},
    {"X_Unit_Diag_Area", "X_Unit_Diag_Area_End", "xunitdiagarea", "xunitdiagareaend", Scope::kKept, true},
    {"Data_Area_Beg", "Data_Area_End", "dataareabeg", "dataareaend", Scope::kKept, true},
    {"Version_Firmware_Download", "End_Version_Firmware_Download", "versionfirmwaredownload",
     "endversionfirmwaredownload", Scope::kKept, false},
    {"Physical_Interface", "End_Physical_Interface", "physicalinterface", "endphysicalinterface", Scope::kKept, false},
};

std::string bare(std::string_view key) {
  std::string result(key);
  result.erase(std::remove(result.begin(), result.end(), '_'), result.end());
  return result;
}

const BlockKind* find_block(const Statement& statement, std::string_view BlockKind::*member) {
  const std::string key = bare(statement.key);
  const auto found =
      std::find_if(std::begin(kBlocks), std::end(kBlocks), [&](const auto& kind) { return kind.*member == key; });
  return found == std::end(kBlocks) ? nullptr : found;
}

/// The begin of a long text, never cut inside a UTF-8 character.
std::string abridge(const std::string& text) {
  constexpr std::size_t kShown = 40;
  if (text.size() <= kShown) return text;
  std::size_t end = kShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

bool may_hold_area(std::string_view name) { return name == "Module" || name == "UnitDiagType"; }

}  // namespace

Scope Parser::scope() const {
  if (open_.empty()) return Scope::kTop;
  return open_.back().skipped ? Scope::kKept : open_.back().kind->scope;
}

void Parser::read(const Line& line) {
  const Statement statement = split_statement(line);
  if (statement.keyword.empty() && statement.value.front() == '#') return read_header(statement);
  started_ = true;
  if (const BlockKind* ended = find_block(statement, &BlockKind::end_key)) return close(*ended, statement);
  const BlockKind* begun = statement.index ? nullptr : find_block(statement, &BlockKind::key);
  if (begun != nullptr) return open(*begun, statement);
  read_content(statement);
}

void Parser::read_content(const Statement& statement) {
  switch (scope()) {
    case Scope::kTop: return in_top(statement);
    case Scope::kModule: return in_module(statement);
    case Scope::kPrmText: return in_prm_text(statement);
    case Scope::kParameter: return in_parameter(statement);
    case Scope::kSlots: return in_slots(statement);
    case Scope::kKept: return keep(gsd.keywords, statement);
  }
}

void Parser::read_header(const Statement& statement) {
  const std::string name = lower(trim(std::string_view(statement.value).substr(1)));
  if (name.compare(0, 11, "profibus_dp") != 0) {
    diagnostics_.warning(statement.line,
                         fmt::format("section {} is unknown, #Profibus_DP is the one for DP", statement.value));
    return;
  }
  if (started_) diagnostics_.warning(statement.line, "#Profibus_DP must stand before the first keyword");
  header_ = true;
}

void Parser::open(const BlockKind& kind, const Statement& statement) {
  const bool inside = !open_.empty() && !(kind.nests && may_hold_area(open_.back().kind->name));
  if (inside) {
    const Open outer = open_.back();
    diagnostics_.error(statement.line, fmt::format("{} begins inside the {} of line {}, {} is needed before it",
                                                   kind.name, outer.kind->name, outer.line, outer.kind->end));
    while (!open_.empty()) leave();
  }
  const bool skipped = !begin(kind.scope, statement);
  open_.push_back({&kind, statement.line, skipped});
}

bool Parser::begin(Scope kind, const Statement& statement) {
  if (kind == Scope::kModule) return begin_module(statement);
  if (kind == Scope::kPrmText) return begin_prm_text(statement);
  if (kind == Scope::kParameter) return begin_parameter(statement);
  if (kind == Scope::kKept && statement.equals) keep(gsd.keywords, statement);
  return true;
}

void Parser::close(const BlockKind& kind, const Statement& statement) {
  const auto same = [&](const Open& open) { return open.kind->key == kind.key; };
  if (std::none_of(open_.begin(), open_.end(), same)) {
    diagnostics_.error(statement.line,
                       fmt::format("{} without {}, it may only end an open {}", kind.end, kind.name, kind.name));
    return;
  }
  while (!same(open_.back())) {
    const Open& inner = open_.back();
    diagnostics_.error(statement.line, fmt::format("{} comes before the end of the {} of line {}, {} is needed first",
                                                   kind.end, inner.kind->name, inner.line, inner.kind->end));
    leave();
  }
  leave();
}

void Parser::leave() {
  if (scope() == Scope::kModule) end_module();
  if (scope() == Scope::kParameter) end_parameter();
  open_.pop_back();
}

void Parser::finish() {
  for (; !open_.empty(); open_.pop_back()) {
    const Open& open = open_.back();
    diagnostics_.error(open.line, fmt::format("{} is not closed, {} is needed", open.kind->name, open.kind->end));
  }
  if (!header_) diagnostics_.warning(1, "the header #Profibus_DP is missing");
}

void Parser::keep(std::vector<GsdKeyword>& list, const Statement& statement) {
  if (statement.keyword.empty() || (!statement.equals && !statement.index)) {
    const std::string shown = abridge(statement.title() + (statement.keyword.empty() ? "" : " ") + statement.value);
    diagnostics_.warning(statement.line, fmt::format("\"{}\" is no GSD statement, ignored", shown));
    return;
  }
  const bool known = find_keyword(statement.key) != nullptr || is_kept_silently(statement.key) ||
                     scope() == Scope::kKept || find_block(statement, &BlockKind::key) != nullptr;
  if (!known)
    diagnostics_.warning(statement.line, fmt::format("unknown keyword {}, kept without a meaning", statement.keyword));
  list.push_back({statement.title(), statement.value, statement.line});
}

}  // namespace dsdpv1::bus::gsd
