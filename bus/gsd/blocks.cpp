// The contents of blocks and the keywords outside blocks.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "bus/gsd/parser.hpp"

namespace dsdpv1::bus::gsd {
namespace {

constexpr std::int64_t kMaxNumber = 0xFFFF;  // for PrmText, ExtUserPrmData and module references
constexpr std::int64_t kMaxText = 0xFFFFFFFF;
constexpr std::size_t kMaxCfg = 244;  // one Chk_Cfg

constexpr std::array<GsdType, 8> kTypes = {GsdType::kBit,        GsdType::kBitArea,    GsdType::kUnsigned8,
                                           GsdType::kUnsigned16, GsdType::kUnsigned32, GsdType::kSigned8,
                                           GsdType::kSigned16,   GsdType::kSigned32};

const GsdType* find_type(std::string_view key) {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](GsdType type) { return lower(name(type)) == key; });
  return found == kTypes.end() ? nullptr : &*found;
}

bool is_bits(GsdType type) { return type == GsdType::kBit || type == GsdType::kBitArea; }

GsdRange type_range(const GsdParameter& parameter) {
  return range_of(parameter.type, parameter.last_bit - parameter.first_bit + 1);
}

bool within(const std::vector<GsdRange>& ranges, std::int64_t value) {
  return std::any_of(
      ranges.begin(), ranges.end(), [&](const GsdRange& r) { return value >= r.low && value <= r.high; });
}

}  // namespace

std::optional<std::int64_t> Parser::number(const Statement& statement, std::int64_t low, std::int64_t high) {
  Values values(statement, diagnostics_);
  const auto value = values.number(low, high);
  if (value) values.finish();
  return value;
}

std::optional<int> Parser::offset(const Statement& statement) {
  const auto value = to_number(statement.index.value_or(""));
  if (value && *value >= 0 && *value < static_cast<std::int64_t>(kMaxCfg)) return static_cast<int>(*value);
  diagnostics_.error(statement.line, fmt::format("{} has no offset, {}(0) to {}(243) is allowed", statement.title(),
                                                 statement.keyword, statement.keyword));
  return std::nullopt;
}

// ---- outside blocks

void Parser::in_top(const Statement& statement) {
  if (read_prm_block(gsd.prm, statement, statement.key)) return;
  const Keyword* keyword = find_keyword(statement.key);
  if (keyword == nullptr) {
    keyword = statement.equals ? guess_keyword(statement.key) : nullptr;
    if (keyword != nullptr)
      diagnostics_.warning(statement.line, fmt::format("{} is read as {}", statement.keyword, keyword->name));
  }
  if (keyword == nullptr) return keep(gsd.keywords, statement);
  if (!statement.equals) {
    diagnostics_.error(statement.line,
                       fmt::format("{} has no '=', {} = value is needed", keyword->name, keyword->name));
    return;
  }
  read_keyword(*keyword, statement);
}

void Parser::read_keyword(const Keyword& keyword, const Statement& statement) {
  const std::string key = lower(keyword.name);
  if (!settings.seen.insert(key).second)
    diagnostics_.warning(statement.line, fmt::format("{} is given again, the last value counts", keyword.name));
  Values values(statement, diagnostics_);
  if (keyword.kind == Kind::kNumber) {
    if (const auto value = values.number(keyword.low, keyword.high))
      settings.numbers[key] = *value;
    else
      return;
  } else if (keyword.kind == Kind::kText) {
    settings.texts[key] = values.text();
    if (static_cast<std::int64_t>(settings.texts[key].size()) > keyword.high)
      diagnostics_.warning(statement.line, fmt::format("{} is longer than {} characters", keyword.name, keyword.high));
  } else if (keyword.kind == Kind::kBytes) {
    const auto bytes = values.bytes();
    if (bytes) settings.user_prm_data = GsdPrmConst{0, *bytes, statement.line};
    return;
  } else {
    settings.texts[key] = statement.value;
    return;
  }
  values.finish();
}

// ---- parameter bytes of the station and of modules

bool Parser::read_prm_block(GsdPrmBlock& block, const Statement& statement, std::string_view key) {
  if (key == "ext_user_prm_data_const")
    read_prm_const(block, statement);
  else if (key == "ext_user_prm_data_ref")
    read_prm_ref(block, statement);
  else
    return false;
  return true;
}

void Parser::read_prm_const(GsdPrmBlock& block, const Statement& statement) {
  const auto at = offset(statement);
  if (!at) return;
  if (auto bytes = Values(statement, diagnostics_).bytes())
    block.constants.push_back({*at, std::move(*bytes), statement.line});
}

void Parser::read_prm_ref(GsdPrmBlock& block, const Statement& statement) {
  const auto at = offset(statement);
  const auto parameter = at ? number(statement, 0, kMaxNumber) : std::nullopt;
  if (parameter) block.refs.push_back({*at, static_cast<int>(*parameter), statement.line});
}

void Parser::read_length(GsdPrmBlock& block, const Statement& statement) {
  if (const auto length = number(statement, 0, static_cast<std::int64_t>(kMaxCfg)))
    block.length = static_cast<int>(*length);
}

// ---- Module

bool Parser::begin_module(const Statement& statement) {
  module_ = {};
  module_.line = statement.line;
  Values values(statement, diagnostics_);
  auto module_name = values.string();
  if (!module_name) return false;
  module_.name = std::string(trim(*module_name));
  if (values.at_end()) {
    diagnostics_.error(statement.line, "Module has no identifier bytes, 1 to 244 are needed");
    return false;
  }
  auto bytes = values.bytes();
  if (!bytes) return false;
  if (bytes->size() > kMaxCfg) {
    diagnostics_.error(statement.line,
                       fmt::format("Module has {} identifier bytes, 1 to 244 are allowed", bytes->size()));
    return false;
  }
  module_.cfg = std::move(*bytes);
  if (!statement.equals) diagnostics_.warning(statement.line, "Module has no '='");
  return true;
}

void Parser::end_module() { gsd.modules.push_back(std::move(module_)); }

void Parser::in_module(const Statement& statement) {
  const bool f_keyword = statement.key.compare(0, 2, "f_") == 0;
  const std::string key = f_keyword ? statement.key.substr(2) : statement.key;
  GsdPrmBlock& block = f_keyword ? module_.f_prm : module_.prm;
  if (statement.keyword.empty() && is_number_list(statement.value)) {
    if (const auto value = number(statement, 0, kMaxNumber)) module_.reference = static_cast<int>(*value);
  } else if (read_prm_block(block, statement, key)) {
    return;
  } else if (key == "ext_module_prm_data_len") {
    read_length(block, statement);
  } else if (key == "preset") {
    if (const auto value = number(statement, 0, 1)) module_.preset = *value == 1;
  } else if (key == "info_text") {
    module_.info_text = Values(statement, diagnostics_).text();
  } else {
    keep(module_.keywords, statement);
  }
}

// ---- PrmText

bool Parser::begin_prm_text(const Statement& statement) {
  const auto value = number(statement, 0, kMaxNumber);
  if (!value) return false;
  prm_text_ = static_cast<int>(*value);
  if (!gsd.prm_texts.emplace(prm_text_, std::map<std::int64_t, std::string>{}).second)
    diagnostics_.warning(statement.line, fmt::format("PrmText {} is defined again, its texts are added", prm_text_));
  return true;
}

void Parser::in_prm_text(const Statement& statement) {
  if (statement.key != "text") return keep(gsd.keywords, statement);
  const auto value = to_number(statement.index.value_or(""));
  if (!value || *value < -kMaxText || *value > kMaxText) {
    diagnostics_.error(statement.line,
                       fmt::format("{} has no value in parentheses, Text(0) = \"...\" is the form", statement.title()));
    return;
  }
  gsd.prm_texts[prm_text_][*value] = Values(statement, diagnostics_).text();
}

// ---- ExtUserPrmData

bool Parser::begin_parameter(const Statement& statement) {
  parameter_ = {};
  parameter_.line = statement.line;
  typed_ = false;
  Values values(statement, diagnostics_);
  const auto value = values.number(0, kMaxNumber);
  if (!value) return false;
  parameter_.number = static_cast<int>(*value);
  parameter_.name = std::string(trim(values.text()));
  return true;
}

void Parser::in_parameter(const Statement& statement) {
  if (const GsdType* type = find_type(statement.key)) return read_type(*type, statement);
  if (statement.key == "prm_text_ref") {
    if (const auto value = number(statement, 0, kMaxNumber)) parameter_.text_ref = static_cast<int>(*value);
  } else if (statement.key == "changeable") {
    if (const auto value = number(statement, 0, 1)) parameter_.changeable = *value == 1;
  } else if (statement.key == "visible") {
    if (const auto value = number(statement, 0, 1)) parameter_.visible = *value == 1;
  } else if (statement.equals || typed_) {
    keep(gsd.keywords, statement);
  } else {
    typed_ = true;  // reported once, not again at the end of the block
    diagnostics_.error(statement.line,
                       fmt::format("{} is no data type, Bit(n), BitArea(a-b), Unsigned8, Unsigned16, Unsigned32, "
                                   "Signed8, Signed16 and Signed32 are allowed",
                                   statement.keyword.empty() ? statement.value : statement.title()));
  }
}

void Parser::read_type(GsdType type, const Statement& statement) {
  typed_ = true;
  parameter_.type = type;
  if (is_bits(type) && !read_bits(statement)) return;
  read_preset(statement);
}

bool Parser::read_bits(const Statement& statement) {
  const std::string index = statement.index.value_or("");
  const std::size_t dash = index.find('-');
  const bool area = parameter_.type == GsdType::kBitArea && dash != std::string::npos;
  const auto first = to_number(trim(std::string_view(index).substr(0, area ? dash : index.size())));
  const auto last = area ? to_number(trim(std::string_view(index).substr(dash + 1))) : first;
  if (!first || !last || *first < 0 || *last > 7 || *first > *last) {
    diagnostics_.error(statement.line, fmt::format("{} names no bits of a byte, Bit(0) to Bit(7) and BitArea(a-b) with "
                                                   "0 <= a <= b <= 7 are allowed",
                                                   statement.title()));
    return false;
  }
  parameter_.first_bit = static_cast<int>(*first);
  parameter_.last_bit = static_cast<int>(*last);
  return true;
}

void Parser::read_preset(const Statement& statement) {
  const GsdRange whole = type_range(parameter_);
  Values values(statement, diagnostics_);
  const auto preset = values.number(whole.low, whole.high);
  if (!preset) return;
  parameter_.preset = *preset;
  if (values.at_end()) return;
  auto allowed = values.ranges();
  if (!allowed) return;
  parameter_.allowed = std::move(*allowed);
  for (const GsdRange& range : parameter_.allowed) {
    if (range.low >= whole.low && range.high <= whole.high) continue;
    diagnostics_.warning(statement.line, fmt::format("{}-{} is more than {} holds, {} to {}", range.low, range.high,
                                                     statement.title(), whole.low, whole.high));
  }
  if (!within(parameter_.allowed, *preset))
    diagnostics_.warning(statement.line, fmt::format("the default {} is none of the allowed values", *preset));
}

void Parser::end_parameter() {
  if (!typed_)
    diagnostics_.error(parameter_.line, "ExtUserPrmData has no data type, a line such as Unsigned8 0 0-255 is needed");
  if (gsd.parameters.count(parameter_.number) != 0) {
    diagnostics_.warning(parameter_.line,
                         fmt::format("ExtUserPrmData {} is defined again, the last counts", parameter_.number));
  }
  gsd.parameters[parameter_.number] = parameter_;
}

// ---- SlotDefinition

void Parser::in_slots(const Statement& statement) {
  if (statement.key != "slot") return keep(gsd.keywords, statement);
  GsdSlot slot;
  slot.line = statement.line;
  const auto index = to_number(statement.index.value_or(""));
  if (!index || *index < 0 || *index > 255) {
    diagnostics_.error(statement.line,
                       fmt::format("{} has no slot number, Slot(0) to Slot(255) is allowed", statement.title()));
    return;
  }
  slot.number = static_cast<int>(*index);
  Values values(statement, diagnostics_);
  const auto slot_name = values.string();
  const auto preset = slot_name ? values.number(0, kMaxNumber) : std::nullopt;
  if (!preset) return;
  slot.name = *slot_name;
  slot.preset = static_cast<int>(*preset);
  if (!values.at_end()) {
    auto allowed = values.ranges();
    if (!allowed) return;
    slot.allowed = std::move(*allowed);
  }
  gsd.slots.push_back(std::move(slot));
}

}  // namespace dsdpv1::bus::gsd
