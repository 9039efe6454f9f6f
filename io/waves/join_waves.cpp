#include "io/waves/join_waves.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "io/input/input_error.hpp"
#include "io/waves/wave_reader.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {
namespace {

constexpr int kPicosecond = -12;

std::string without_blanks(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// One of the parts while it is read.
class Part {
 public:
  explicit Part(const WavePart& what) : what_(what), reader_(read_wave(what.file)) {
    if (declarations().exponent != kPicosecond)
      throw InputError(what.file, 0, "is a wave of another time scale, expected picoseconds");
    outputs_.resize(declarations().signals.size());
    early_.resize(outputs_.size());
    advance();
  }

  const WaveDeclarations& declarations() const { return reader_->declarations(); }
  /// The scope of a variable in the joined wave.
  std::string scope_of(const WaveVariable& variable) const {
    std::string scope = declarations().scopes.at(variable.scope);
    if (scope == what_.left_out)
      scope.clear();
    else if (!what_.left_out.empty() && scope.rfind(what_.left_out + ".", 0) == 0)
      scope.erase(0, what_.left_out.size() + 1);
    if (what_.scope.empty() || scope.empty()) return what_.scope + scope;
    return what_.scope + "." + scope;
  }
  void declare(const WaveVariable& variable, WaveWriter& writer) {
    const WaveSignal& signal = declarations().signals.at(variable.signal);
    if (signal.kind == WaveKind::kEvent) return;  // writers have none
    std::optional<WaveWriter::Signal>& output = outputs_.at(variable.signal);
    const std::string name = without_blanks(variable.name);
    if (output)
      writer.alias(name, *output);
    else if (signal.kind == WaveKind::kBits)
      output = writer.wire(name, static_cast<int>(signal.width));
    else
      output = writer.words(name);
  }

  /// The next change; absent: the part is over.
  const std::optional<WaveEvent>& next() const { return next_; }
  std::uint64_t begin() const { return reader_->begin(); }
  std::uint64_t end() const { return reader_->end(); }
  void write_next(WaveWriter& writer) {
    if (next_->kind == WaveEvent::Kind::kChange) write(writer, next_->time, next_->signal, next_->value);
    advance();
  }
  /// Skips all changes before `begin` and writes the resulting values there.
  void skip_to(std::uint64_t begin, WaveWriter& writer) {
    for (; next_ && next_->time < begin; advance())
      if (next_->kind == WaveEvent::Kind::kChange) early_.at(next_->signal) = std::string(next_->value);
    for (std::size_t i = 0; i < early_.size(); ++i)
      if (early_[i]) write(writer, begin, static_cast<std::uint32_t>(i), *early_[i]);
  }

 private:
  void advance() {
    WaveEvent event;
    next_ = reader_->next(event) ? std::optional<WaveEvent>(event) : std::nullopt;
  }
  void write(WaveWriter& writer, std::uint64_t time, std::uint32_t signal, std::string_view value) const {
    const std::optional<WaveWriter::Signal>& output = outputs_.at(signal);
    if (!output) return;
    if (declarations().signals.at(signal).kind == WaveKind::kBits)
      writer.set(Picoseconds{time}, *output, value);
    else
      writer.say(Picoseconds{time}, *output, value);
  }

  WavePart what_;
  std::unique_ptr<WaveReader> reader_;
  std::vector<std::optional<WaveWriter::Signal>> outputs_;  ///< by signal of the part
  std::vector<std::optional<std::string>> early_;           ///< the same: the last value before the beginning
  std::optional<WaveEvent> next_;
};

/// Scopes as a tree, each with its declarations, both in order of first appearance.
class Scope {
 public:
  void add(const std::string& path, Part& part, const WaveVariable& variable) {
    if (path.empty()) {
      variables_.emplace_back(&part, &variable);
      return;
    }
    const std::size_t point = path.find('.');
    inner(path.substr(0, point)).add(point == std::string::npos ? "" : path.substr(point + 1), part, variable);
  }
  void declare(WaveWriter& writer) const {
    for (const auto& [part, variable] : variables_) part->declare(*variable, writer);
    for (const auto& [name, scope] : scopes_) {
      writer.open_scope(without_blanks(name));
      scope->declare(writer);
      writer.close_scope();
    }
  }

 private:
  Scope& inner(const std::string& name) {
    const auto [place, is_new] = places_.emplace(name, scopes_.size());
    if (is_new) scopes_.emplace_back(name, std::make_unique<Scope>());
    return *scopes_[place->second].second;
  }

  std::vector<std::pair<Part*, const WaveVariable*>> variables_;
  std::vector<std::pair<std::string, std::unique_ptr<Scope>>> scopes_;
  std::map<std::string, std::size_t> places_;
};

/// The part with the earliest change, the first of several; null when all are over.
Part* earliest(const std::vector<std::unique_ptr<Part>>& parts) {
  Part* found = nullptr;
  for (const std::unique_ptr<Part>& part : parts)
    if (part->next() && (found == nullptr || part->next()->time < found->next()->time)) found = part.get();
  return found;
}

}  // namespace

void join_waves(const std::vector<WavePart>& parts, const std::string& to) {
  std::vector<std::unique_ptr<Part>> open;
  open.reserve(parts.size());
  for (const WavePart& each : parts) open.push_back(std::make_unique<Part>(each));
  Scope root;
  for (const std::unique_ptr<Part>& part : open)
    for (const WaveVariable& variable : part->declarations().variables)
      root.add(part->scope_of(variable), *part, variable);
  const std::unique_ptr<WaveWriter> writer = open_wave(to);
  root.declare(*writer);
  const Part& first = *open.front();
  for (const std::unique_ptr<Part>& part : open) part->skip_to(first.begin(), *writer);
  for (Part* part = earliest(open); part != nullptr; part = earliest(open)) {
    if (!first.next() && part->next()->time > first.end()) break;
    part->write_next(*writer);
  }
  writer->finish(Picoseconds{first.end()});
}

}  // namespace dsdpv1::tb
