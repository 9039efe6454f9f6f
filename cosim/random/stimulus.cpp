#include "cosim/random/stimulus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "cosim/random/random_cases.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kLongest = Tick{1} << 40;

/// Verbs of every chip besides the user's.
const std::vector<VerbRow>& own_verbs() {
  static const std::vector<VerbRow> verbs = {
      {Verb::kSend, "send", {{"rate", &Action::rate, 0, 9}, {"reply", &Action::reply_bits, 0, 2000}}, nullptr, true},
      {Verb::kSpike, "spike", {{"low", &Action::low, 1, kLongest}}, nullptr},
      {Verb::kReset, "reset", {{"low", &Action::low, 1, kLongest}}, nullptr},
      {Verb::kSync, "sync", {}, nullptr},
      {Verb::kAlone, "alone", {}, nullptr}};
  return verbs;
}

/// Null if none is `wanted`.
template <class Wanted>
const VerbRow* find_verb(const tb::ChipKind& kind, const Wanted& wanted) {
  for (const std::vector<VerbRow>* verbs : {&own_verbs(), &kind.random()->words().verbs}) {
    const auto found = std::find_if(verbs->begin(), verbs->end(), wanted);
    if (found != verbs->end()) return &*found;
  }
  return nullptr;
}

const VerbRow* verb_called(const tb::ChipKind& kind, const std::string& word) {
  return find_verb(
      kind, [&word](const VerbRow& each) { return word == each.word; });
}

/// Faults on the wire, `key=position` or `key=position:number:number`.
struct FaultField {
  const char* key;
  std::size_t numbers;  ///< after the position
  std::optional<std::vector<long>> (*get)(const bus::WireFaults&);
  void (*set)(bus::WireFaults&, const std::vector<long>&);
};

std::optional<std::vector<long>> numbers(const std::optional<std::size_t>& at, std::vector<long> more = {}) {
  if (!at) return std::nullopt;
  more.insert(more.begin(), static_cast<long>(*at));
  return more;
}

const FaultField kFaults[] = {
    {"parity", 0, [](const bus::WireFaults& f) { return numbers(f.wrong_parity_at); },
     [](bus::WireFaults& f, const std::vector<long>& n) { f.wrong_parity_at = static_cast<std::size_t>(n[0]); }},
    {"stop", 0, [](const bus::WireFaults& f) { return numbers(f.missing_stop_at); },
     [](bus::WireFaults& f, const std::vector<long>& n) { f.missing_stop_at = static_cast<std::size_t>(n[0]); }},
    {"gap", 1, [](const bus::WireFaults& f) { return numbers(f.gap_before, {f.gap_millibits}); },
     [](bus::WireFaults& f, const std::vector<long>& n) {
       f.gap_before = static_cast<std::size_t>(n[0]);
       f.gap_millibits = static_cast<int>(n[1]);
     }},
    {"cut", 1, [](const bus::WireFaults& f) { return numbers(f.truncate_after, {f.truncate_bits}); },
     [](bus::WireFaults& f, const std::vector<long>& n) {
       f.truncate_after = static_cast<std::size_t>(n[0]);
       f.truncate_bits = static_cast<int>(n[1]);
     }},
    {"glitch", 2,
     [](const bus::WireFaults& f) {
       return numbers(f.glitch_at, {f.glitch.start_millibits, f.glitch.length_millibits});
     },
     [](bus::WireFaults& f, const std::vector<long>& n) {
       f.glitch_at = static_cast<std::size_t>(n[0]);
       f.glitch = {static_cast<int>(n[1]), static_cast<int>(n[2])};
     }}};

std::string faults_text(const bus::WireFaults& faults) {
  std::string text;
  for (const FaultField& field : kFaults) {
    const auto values = field.get(faults);
    if (!values) continue;
    text += fmt::format(" {}={}", field.key, fmt::join(*values, ":"));
  }
  return text;
}

bool is_aimed(const Action& action) { return action.during != nullptr; }

/// True for verbs of user and board, whose lanes observe the chip.
bool may_be_aimed(Verb verb) { return verb == Verb::kReset || verb >= Verb::kPin; }

constexpr const char* kDuring = "during";
constexpr const char* kSet = "set";

/// "C1_request".
std::string word_of(const char* part) {
  std::string word = part;
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::string part_words(const std::vector<const char*>& parts) {
  std::string words;
  for (const char* part : parts) words += fmt::format("{}{}", words.empty() ? "" : ", ", word_of(part));
  return words;
}

std::string line_of(const Action& action, const tb::ChipKind& kind) {
  const VerbRow& verb = *find_verb(kind, [&action](const VerbRow& each) { return each.verb == action.verb; });
  std::string line = verb.word;
  if (action.verb == Verb::kSync || action.verb == Verb::kAlone) return line;
  line += fmt::format(" +{}", action.delay);
  if (action.verb == Verb::kPin) line += fmt::format(" {}", kind.pins()[action.pin].name);
  for (const Field& field : verb.fields) {
    const Tick value = action.*field.member;
    line += field.hex ? fmt::format(" {}={:X}", field.key, value) : fmt::format(" {}={}", field.key, value);
  }
  if (is_aimed(action)) line += fmt::format(" {}={}:{}", kDuring, word_of(action.during), action.within);
  line += faults_text(action.faults);
  for (std::size_t i = 0; i < action.bytes.size(); ++i)
    line += fmt::format("{}{:02X}", i == 0 ? " : " : " ", action.bytes[i]);
  return line;
}

/// Reads one line, word by word.
class LineParser {
 public:
  LineParser(const std::string& line, const std::string& file, int number, const tb::ChipKind& kind)
      : words_(line), file_(file), number_(number), kind_(kind) {}

  /// nullopt for an empty line or a comment.
  std::optional<Action> parse() {
    std::string word;
    if (!(words_ >> word) || word[0] == '#' || word == kSet) return std::nullopt;
    verb_ = verb_called(kind_, word);
    if (verb_ == nullptr) fail_verb(word);
    Action action;
    action.verb = verb_->verb;
    while (words_ >> word)
      if (word == ":")
        bytes(action);
      else
        argument(action, word);
    return action;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed) const {
    throw tb::InputError(file_, number_, what + ", allowed: " + allowed);
  }
  [[noreturn]] void fail_verb(const std::string& word) const {
    for (const tb::ChipKind* other : tb::chip_kinds())
      if (other->random() != nullptr && verb_called(*other, word) != nullptr)
        fail(fmt::format("{} is an action of the {}'s host", word, other->title()),
             fmt::format("--chip {}", other->name()));
    std::string allowed = "send, spike";
    for (const VerbRow& each : words().verbs) allowed += fmt::format(", {}", each.word);
    fail("unknown action " + word, allowed + ", reset, sync, alone, set, repeat, end");
  }
  const Vocabulary& words() const { return kind_.random()->words(); }
  long number(const std::string& text, int base, Tick least, Tick most) const {
    std::size_t used = 0;
    long value = 0;
    try {
      value = std::stol(text, &used, base);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != text.size() || value < least || value > most)
      fail("wrong number " + text,
           base == 16 ? fmt::format("{:X} to {:X}, hexadecimal", least, most) : fmt::format("{} to {}", least, most));
    return value;
  }
  void argument(Action& action, const std::string& word) {
    const std::size_t equals = word.find('=');
    if (word[0] == '+')
      action.delay = number(word.substr(1), 10, 0, kLongest);
    else if (equals != std::string::npos)
      assign(action, word.substr(0, equals), word.substr(equals + 1));
    else
      pin(action, word);
  }
  void assign(Action& action, const std::string& key, const std::string& text) const {
    std::string allowed = "+DELAY";
    for (const Field& field : verb_->fields) {
      if (key == field.key) {
        action.*field.member = number(text, field.hex ? 16 : 10, field.least, field.most);
        return;
      }
      allowed += fmt::format(", {}=", field.key);
    }
    if (may_be_aimed(action.verb)) {
      if (key == kDuring) return aim(action, text);
      allowed += fmt::format(", {}=", kDuring);
    }
    for (const FaultField& field : kFaults) {
      if (!verb_->faults) break;
      if (key == field.key) return field.set(action.faults, split(text, field.numbers + 1));
      allowed += fmt::format(", {}=", field.key);
    }
    fail("unknown argument " + key, allowed);
  }
  /// PART:TICKS
  void aim(Action& action, const std::string& text) const {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string part = text.substr(0, colon);
    for (const char* each : words().access_parts)
      if (part == word_of(each)) action.during = each;
    if (!is_aimed(action)) fail("unknown part of an access " + part, part_words(words().access_parts));
    if (colon == text.size()) fail("no time in " + text, "PART:TICKS");
    action.within = number(text.substr(colon + 1), 10, 0, kLongest);
  }
  std::vector<long> split(const std::string& text, std::size_t count) const {
    std::vector<long> values;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ':');) values.push_back(number(part, 10, 0, 1'000'000));
    if (values.size() != count) fail("wrong fault " + text, fmt::format("{} numbers with : between them", count));
    return values;
  }
  void pin(Action& action, const std::string& word) const {
    for (PinNumber i = 0; i < end_of(kind_.pins()) && action.verb == Verb::kPin; ++i) {
      if (!kind_.pins()[i].input || word != kind_.pins()[i].name) continue;
      action.pin = i;
      return;
    }
    fail("unknown word " + word, "+DELAY, KEY=VALUE, : BYTES, and the name of an input pin behind pin");
  }
  void bytes(Action& action) {
    for (std::string word; words_ >> word;)
      action.bytes.push_back(static_cast<std::uint8_t>(number(word, 16, 0, 0xFF)));
  }

  std::istringstream words_;
  const std::string& file_;
  int number_;
  const tb::ChipKind& kind_;
  const VerbRow* verb_ = nullptr;
};

/// The lines of a file; those between `repeat COUNT` and `end` several times.
class FileParser {
 public:
  FileParser(const std::string& file, const tb::ChipKind& kind) : file_(file), kind_(kind) {}

  Stimulus parse(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      ++number_;
      std::istringstream words(line);
      std::string verb, argument, more;
      words >> verb >> argument >> more;
      if (verb == "repeat")
        repeat(more.empty() ? argument : fmt::format("{} {}", argument, more));
      else if (verb == "end")
        end(argument);
      else if (auto action = LineParser(line, file_, number_, kind_).parse())
        add(std::move(*action));
    }
    if (count_ != 0) fail(repeat_line_, "repeat without its end", "end behind the lines that are repeated");
    return std::move(stimulus_);
  }

 private:
  static constexpr int kMostRepeats = 1000;
  static constexpr std::size_t kMostActions = 1'000'000;  // a quarter of a gigabyte; random cases have some thousands
  [[noreturn]] void fail(int line, const std::string& what, const std::string& allowed) const {
    throw tb::InputError(file_, line, what + ", allowed: " + allowed);
  }
  void check_length(int line, std::size_t actions) const {
    if (actions > kMostActions) fail(line, "too many actions", fmt::format("{} in all", kMostActions));
  }
  void add(Action action) {
    check_length(number_, stimulus_.size() + 1);
    stimulus_.push_back(std::move(action));
  }
  void repeat(const std::string& argument) {
    if (count_ != 0) fail(number_, "repeat within repeat", fmt::format("end first, of line {}", repeat_line_));
    const bool digits =
        !argument.empty() && argument.size() <= 4 && argument.find_first_not_of("0123456789") == std::string::npos;
    count_ = digits ? std::stoi(argument) : 0;
    if (count_ < 1 || count_ > kMostRepeats)
      fail(number_, "wrong count " + argument, fmt::format("repeat 1 to repeat {}", kMostRepeats));
    first_ = stimulus_.size();
    repeat_line_ = number_;
  }
  void end(const std::string& argument) {
    if (count_ == 0) fail(number_, "end without repeat", "repeat COUNT before it");
    if (!argument.empty()) fail(number_, "unknown word " + argument, "end alone");
    const Stimulus lines(stimulus_.begin() + static_cast<std::ptrdiff_t>(first_), stimulus_.end());
    check_length(repeat_line_, first_ + lines.size() * static_cast<std::size_t>(count_));
    for (; count_ > 1; --count_) stimulus_.insert(stimulus_.end(), lines.begin(), lines.end());
    count_ = 0;
  }

  const std::string& file_;
  const tb::ChipKind& kind_;
  Stimulus stimulus_;
  int number_ = 0, count_ = 0, repeat_line_ = 0;
  std::size_t first_ = 0;
};

}  // namespace

std::string to_text(const Stimulus& stimulus, const tb::ChipKind& kind, const std::vector<std::string>& set) {
  std::string text =
      "# Stimulus for the lockstep of model and RTL, see docs/cosim.md. Times are ticks of 1/12 ns, 250 a cycle.\n";
  for (const std::string& each : set) text += fmt::format("{} {}\n", kSet, each);
  for (const Action& action : stimulus) text += line_of(action, kind) + "\n";
  return text;
}

std::vector<std::string> settings_in(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream lines(text);
  for (std::string line, word, setting; std::getline(lines, line);) {
    std::istringstream words(line);
    if (words >> word && word == kSet && std::getline(words >> std::ws, setting)) all.push_back(setting);
  }
  return all;
}

Stimulus parse_stimulus(const std::string& text, const std::string& file, const tb::ChipKind& kind) {
  return FileParser(file, kind).parse(text);
}

}  // namespace dsdpv1::cosim
