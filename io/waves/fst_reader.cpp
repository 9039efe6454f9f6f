#include "io/waves/fst_reader.hpp"

#include <fmt/format.h>

#include "io/input/input_error.hpp"
#include "io/waves/fst_blocks.hpp"
#include "io/waves/fst_handle.hpp"
#include "io/waves/level_text.hpp"
#include "io/waves/wave_name.hpp"

namespace dsdpv1::tb {
namespace {

/// Limit for a file that is compressed as a whole (GHDL; vvp -fst-space), which is unpacked in memory.
constexpr std::uint64_t kMostUnpacked = std::uint64_t{1} << 30U;

// ------------------------------------------------------------------------------------ in the process that has fstapi
struct Heading {
  std::uint64_t begin, end;
  int exponent;
};

enum class Entry : std::uint8_t { kScope, kUpscope, kVariable, kEnd };

/// An entry of the hierarchy; its name follows.
struct HierarchyRecord {
  Entry entry;
  WaveKind kind;
  std::uint32_t width, handle, name;
};

/// A change; the value follows.
struct ChangeRecord {
  std::uint64_t time;
  std::uint32_t handle, length;
  enum : std::uint32_t { kOff, kOn, kChange, kEnd } what;
};

template <class Record>
void put(std::FILE* to, const Record& record) {
  std::fwrite(&record, sizeof record, 1, to);
}

WaveKind kind_of(unsigned char type) {
  switch (type) {
    case FST_VT_GEN_STRING: return WaveKind::kText;
    case FST_VT_VCD_EVENT: return WaveKind::kEvent;
    case FST_VT_VCD_REAL:
    case FST_VT_VCD_REAL_PARAMETER:
    case FST_VT_VCD_REALTIME:
    case FST_VT_SV_SHORTREAL: return WaveKind::kReal;
    default: return WaveKind::kBits;
  }
}

void put_hierarchy(std::FILE* to, HierarchyRecord record, const char* name) {
  record.name = static_cast<std::uint32_t>(std::strlen(name));
  put(to, record);
  std::fwrite(name, 1, record.name, to);
}

void tell_declarations(const std::string& path, std::FILE* to) {
  const FstHandle reader = open_fst(path);
  if (!reader) return;
  put(to, Heading{fstReaderGetStartTime(reader.get()), fstReaderGetEndTime(reader.get()),
                  fstReaderGetTimescale(reader.get())});
  while (const fstHier* entry = fstReaderIterateHier(reader.get())) {
    if (entry->htyp == FST_HT_SCOPE) put_hierarchy(to, {Entry::kScope, {}, 0, 0, 0}, entry->u.scope.name);
    if (entry->htyp == FST_HT_UPSCOPE) put_hierarchy(to, {Entry::kUpscope, {}, 0, 0, 0}, "");
    if (entry->htyp != FST_HT_VAR) continue;
    const auto& variable = entry->u.var;
    put_hierarchy(to, {Entry::kVariable, kind_of(variable.typ), variable.length, variable.handle, 0}, variable.name);
  }
  put_hierarchy(to, {Entry::kEnd, {}, 0, fstReaderGetMaxHandle(reader.get()), 0}, "");
}

/// Writes the changes that fstapi delivers, and marks the times at which the simulator recorded nothing.
class Teller {
 public:
  Teller(void* reader, std::FILE* to)
      : reader_(reader), to_(to), pauses_(fstReaderGetNumberDumpActivityChanges(reader)) {}
  void tell() {
    fstReaderIterBlocks2(reader_, change, change_of_word, this, nullptr);
    pauses_until(fstReaderGetEndTime(reader_));
    put(to_, ChangeRecord{fstReaderGetEndTime(reader_), 0, 0, ChangeRecord::kEnd});
  }

 private:
  static void change(void* self, std::uint64_t time, fstHandle handle, const unsigned char* value) {
    change_of_word(self, time, handle, value,
                   static_cast<std::uint32_t>(std::strlen(reinterpret_cast<const char*>(value))));
  }
  static void change_of_word(void* self, std::uint64_t time, fstHandle handle, const unsigned char* value,
                             std::uint32_t length) {
    Teller& teller = *static_cast<Teller*>(self);
    teller.pauses_until(time);
    put(teller.to_, ChangeRecord{time, handle, length, ChangeRecord::kChange});
    std::fwrite(value, 1, length, teller.to_);
  }
  void pauses_until(std::uint64_t time) {
    for (; next_ < pauses_ && fstReaderGetDumpActivityChangeTime(reader_, next_) <= time; ++next_)
      put(to_, ChangeRecord{
                   fstReaderGetDumpActivityChangeTime(reader_, next_), 0, 0,
                   fstReaderGetDumpActivityChangeValue(reader_, next_) != 0 ? ChangeRecord::kOn : ChangeRecord::kOff});
  }

  void* reader_;
  std::FILE* to_;
  std::uint32_t pauses_, next_ = 0;
};

void tell_changes(const std::string& path, const std::vector<bool>& selected, std::FILE* to) {
  const FstHandle reader = open_fst(path);
  if (!reader) return;
  for (std::size_t i = 0; i < selected.size(); ++i)
    if (selected[i]) fstReaderSetFacProcessMask(reader.get(), static_cast<fstHandle>(i + 1));
  Teller(reader.get(), to).tell();
}

}  // namespace

// ------------------------------------------------------------------------------------------------------- in this one
FstReader::FstReader(std::string path) : path_(std::move(path)) {
  check_file();
  read_declarations();
  selected_.assign(declarations_.signals.size(), true);
}

void FstReader::check_file() const {
  const FstBlocks blocks = fst_blocks(path_);
  if (!blocks.header && blocks.unpacked == 0) throw InputError(path_, 0, "is no wave, expected VCD and FST");
  if (blocks.unpacked > kMostUnpacked)
    throw InputError(path_, 0,
                     fmt::format("is an FST of {} MB that is compressed as a whole, expected at most {} MB",
                                 blocks.unpacked >> 20U, kMostUnpacked >> 20U));
  if (blocks.damaged) damaged();
  if (!blocks.complete())
    throw InputError(
        path_, 0,
        "is an FST that was cut, expected a complete one: was the simulator stopped while it wrote? dsdpv1-sim "
        "recover completes it if its .hier is beside it");
  if (blocks.variables > kMostWaveVariables)
    throw InputError(
        path_, 0,
        "declares " + std::to_string(blocks.variables) + " variables, expected " + std::to_string(kMostWaveVariables));
}

void FstReader::damaged() const { throw InputError(path_, 0, "is an FST that is damaged, expected a complete one"); }

void FstReader::read_declarations() {
  ChildStream told([this](std::FILE* to) { tell_declarations(path_, to); });
  Heading heading{};
  if (!told.read(heading) || heading.exponent < -15 || heading.exponent > 2) damaged();
  begin_ = now_ = heading.begin;
  last_ = heading.end;
  declarations_.exponent = heading.exponent;
  WaveScopes scopes(declarations_);
  while (read_entry(told, scopes)) {
  }
}

/// Reads an entry of the hierarchy; false at its end.
bool FstReader::read_entry(ChildStream& told, WaveScopes& scopes) {
  HierarchyRecord record{};
  if (!told.read(record)) damaged();
  names_ += record.name;
  if (names_ > kMostWaveNames || record.handle > kMostWaveVariables || record.width > kMostWaveWidth) damaged();
  std::string name(record.name, '\0');
  if (!told.read(name.data(), name.size())) damaged();
  if (record.handle > declarations_.signals.size()) declarations_.signals.resize(record.handle);
  switch (record.entry) {
    case Entry::kScope: scopes.open(name); break;
    case Entry::kUpscope:
      if (!scopes.close()) damaged();
      break;
    case Entry::kVariable: add_variable(scopes.current(), name, {record.kind, record.width}, record.handle); break;
    case Entry::kEnd: return false;
  }
  return true;
}

void FstReader::add_variable(std::uint32_t scope, const std::string& name, const WaveSignal& signal,
                             std::uint32_t handle) {
  if (handle == 0) damaged();
  const bool bits = signal.kind == WaveKind::kBits;
  declarations_.signals[handle - 1] = {signal.kind, bits ? signal.width : 0U};
  WaveName parsed = parse_wave_name(name, signal.width);
  declarations_.variables.push_back({scope, std::move(parsed.name), parsed.range, handle - 1});
}

bool FstReader::next(WaveEvent& event) {
  if (!changes_) changes_.emplace([this](std::FILE* to) { tell_changes(path_, selected_, to); });
  ChangeRecord record{};
  for (;;) {
    if (!changes_->read(record) || record.time < now_) damaged();
    now_ = record.time;
    if (record.what == ChangeRecord::kEnd) return false;
    const bool change = record.what == ChangeRecord::kChange;
    if (change && (record.handle == 0 || record.handle > declarations_.signals.size())) damaged();
    if (record.length > kMostWaveWidth) damaged();
    value_.resize(record.length);
    if (!changes_->read(value_.data(), record.length)) damaged();
    if (change && !normalise(declarations_.signals[record.handle - 1])) damaged();
    const bool event_variable = change && declarations_.signals[record.handle - 1].kind == WaveKind::kEvent;
    if (event_variable && value_ != "1") continue;  // each event has a value where the file begins
    if (event_variable) value_.clear();
    event = {event_variable                     ? WaveEvent::Kind::kTrigger
             : change                           ? WaveEvent::Kind::kChange
             : record.what == ChangeRecord::kOn ? WaveEvent::Kind::kOn
                                                : WaveEvent::Kind::kOff,
             now_, change ? record.handle - 1 : 0, value_};
    return true;
  }
}

bool FstReader::normalise(const WaveSignal& declared) {
  if (declared.kind != WaveKind::kBits) return true;
  if (value_.size() != declared.width) return false;
  for (char& c : value_) {
    c = level_of(c);
    if (c == '\0') return false;
  }
  return true;
}

double FstReader::share() const {
  return last_ > begin_ ? static_cast<double>(now_ - begin_) / static_cast<double>(last_ - begin_) : 0;
}

}  // namespace dsdpv1::tb
