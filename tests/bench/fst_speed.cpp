// The FST library alone: writes again the changes of a wave read before. Prints the CPU time in seconds.
#include <fstapi.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/waves/fst_file.hpp"
#include "tests/bench/stopwatch.hpp"

namespace dsdpv1 {
namespace {

struct CloseReader {
  void operator()(void* reader) const { fstReaderClose(reader); }
};
using Reader = std::unique_ptr<void, CloseReader>;

struct Change {
  std::uint64_t time;
  fstHandle signal;
  bool is_word;
  std::string value;
};

struct Variable {
  std::string name;
  std::uint32_t width;  ///< 0: words
};

struct Wave {
  std::vector<Variable> variables;  ///< by handle - 1
  std::vector<Change> changes;
};

void keep_level(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value) {
  static_cast<Wave*>(to)->changes.push_back({time, signal, false, reinterpret_cast<const char*>(value)});
}

void keep_word(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value, std::uint32_t length) {
  static_cast<Wave*>(to)->changes.push_back({time, signal, true, {reinterpret_cast<const char*>(value), length}});
}

Wave read(const std::string& path) {
  const Reader reader(fstReaderOpen(path.c_str()));
  if (!reader) throw std::runtime_error(path + " is no FST wave");
  Wave wave;
  while (const fstHier* entry = fstReaderIterateHier(reader.get())) {
    if (entry->htyp != FST_HT_VAR) continue;
    const bool words = entry->u.var.typ == FST_VT_GEN_STRING;
    wave.variables.push_back({entry->u.var.name, words ? 0 : entry->u.var.length});
  }
  fstReaderSetFacProcessMaskAll(reader.get());
  fstReaderIterBlocks2(reader.get(), keep_level, keep_word, &wave, nullptr);
  if (wave.changes.empty()) throw std::runtime_error(path + " has no changes");
  return wave;
}

/// As FstWriter does it, into a file that is removed.
double seconds_to_write(const Wave& wave, const std::string& path) {
  const speed::Stopwatch watch;
  tb::FstFile file(path, "");
  std::vector<tb::FstFile::Handle> handles;
  for (const Variable& variable : wave.variables) handles.push_back(file.variable(variable.name, variable.width));
  for (const Change& change : wave.changes) {
    file.move_to(change.time);
    const tb::FstFile::Handle handle = handles.at(change.signal - 1);
    if (change.is_word)
      file.say(handle, change.value);
    else
      file.set(handle, change.value.c_str());
  }
  file.finish();
  const double seconds = watch.seconds();
  ::unlink(path.c_str());
  return seconds;
}

}  // namespace
}  // namespace dsdpv1

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s WAVE.fst\n", argv[0]);
    return 2;
  }
  try {
    const std::string wave = argv[1];
    std::printf("fst_library\t%.6g\n", dsdpv1::seconds_to_write(dsdpv1::read(wave), wave + ".again.fst"));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
