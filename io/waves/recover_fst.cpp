// Rebuilds a complete FST file from a readable part.
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "io/input/input_error.hpp"
#include "io/output/nowhere.hpp"
#include "io/output/output_place.hpp"
#include "io/waves/fst_blocks.hpp"
#include "io/waves/fst_file.hpp"
#include "io/waves/fst_handle.hpp"
#include "io/waves/recover.hpp"

namespace dsdpv1::tb {
namespace {

void ignore(void* /*file*/, std::uint64_t /*time*/, fstHandle /*signal*/, const unsigned char* /*value*/) {}

/// fstapi ends the program, or worse, when a file is damaged; so it is read in another process first.
bool readable(const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!send_nowhere(STDERR_FILENO)) ::_exit(1);
    const FstHandle reader = open_fst(path);
    if (!reader) ::_exit(1);
    fstReaderSetFacProcessMaskAll(reader.get());
    ::_exit(fstReaderIterBlocks(reader.get(), ignore, nullptr, nullptr) == 1 ? 0 : 1);
  }
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

FstFile::Kind kind_in_copy(unsigned char type) {
  switch (type) {
    case FST_VT_VCD_EVENT: return FstFile::Kind::kEvent;
    case FST_VT_VCD_REAL:
    case FST_VT_VCD_REAL_PARAMETER:
    case FST_VT_VCD_REALTIME:
    case FST_VT_SV_SHORTREAL: return FstFile::Kind::kReal;
    default: return FstFile::Kind::kUsual;
  }
}

/// A file under construction, and its variables by the handles of the file being read.
struct Copy {
  Copy(const std::string& path, void* reader)
      : file(path, fstReaderGetDateString(reader), fstReaderGetTimescale(reader)) {}
  /// 0 for one that no name declares.
  FstFile::Handle of(fstHandle signal) {
    if (signal < variables.size()) return variables[signal];
    damaged = true;
    return 0;
  }
  FstFile file;
  std::vector<FstFile::Handle> variables{0};
  bool damaged = false;
};

void declare(void* reader, Copy& copy) {
  while (const fstHier* entry = fstReaderIterateHier(reader)) {
    if (entry->htyp == FST_HT_SCOPE) copy.file.open_scope(entry->u.scope.name);
    if (entry->htyp == FST_HT_UPSCOPE) copy.file.close_scope();
    if (entry->htyp != FST_HT_VAR) continue;
    const auto& variable = entry->u.var;
    const FstFile::Handle known = variable.is_alias != 0 ? copy.of(variable.handle) : 0;
    const std::uint32_t width = variable.typ == FST_VT_GEN_STRING ? 0 : variable.length;
    const FstFile::Handle own = copy.file.variable(variable.name, width, known, kind_in_copy(variable.typ));
    if (variable.is_alias == 0) copy.variables.push_back(own);
  }
}

void change(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value) {
  Copy& copy = *static_cast<Copy*>(to);
  copy.file.move_to(time);
  if (const FstFile::Handle own = copy.of(signal)) copy.file.set(own, reinterpret_cast<const char*>(value));
}

void change_of_word(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value, std::uint32_t length) {
  Copy& copy = *static_cast<Copy*>(to);
  copy.file.move_to(time);
  if (const FstFile::Handle own = copy.of(signal)) copy.file.say(own, {reinterpret_cast<const char*>(value), length});
}

void check_recoverable(const std::string& part) {
  const FstBlocks blocks = fst_blocks(part);
  if (blocks.names)
    throw InputError(part, 0, "is complete, so there is nothing to recover: give it the name that it should have");
  if (blocks.changes == 0) throw InputError(part, 0, "holds no changes yet, so there is nothing to recover");
  if (::access((part + ".hier").c_str(), R_OK) != 0)
    throw InputError(part, 0, "needs " + part + ".hier beside it, which has the names of the signals");
  if (!readable(part)) throw InputError(part, 0, "is damaged and cannot be read");
}

}  // namespace

bool fst_is_complete(const std::string& path) { return fst_blocks(path).complete() && open_fst(path) != nullptr; }

Recovered recover_fst(const std::string& part, const std::string& output) {
  check_recoverable(part);
  const FstHandle reader = open_fst(part);
  if (!reader) throw InputError(part, 0, "cannot be read");
  const std::uint64_t end = fstReaderGetEndTime(reader.get());
  Copy copy(output, reader.get());
  declare(reader.get(), copy);
  fstReaderSetFacProcessMaskAll(reader.get());
  fstReaderIterBlocksSetNativeDoublesOnCallback(reader.get(), 1);
  fstReaderIterBlocks2(reader.get(), change, change_of_word, &copy, nullptr);
  if (copy.damaged) throw InputError(part, 0, "has other names beside it, expected its own " + part + ".hier");
  copy.file.move_to(end);
  copy.file.finish();
  return {end, fstReaderGetTimescale(reader.get())};
}

}  // namespace dsdpv1::tb
