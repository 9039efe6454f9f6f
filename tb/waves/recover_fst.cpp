// FST: the blocks of a file, and a complete file from what is readable of one.
#include <fcntl.h>
#include <fstapi.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <vector>

#include "tb/input/input_error.hpp"
#include "tb/output/output_place.hpp"
#include "tb/waves/fst_file.hpp"
#include "tb/waves/recover.hpp"

namespace tb {
namespace {

struct Blocks {
  unsigned changes = 0;
  bool geometry = false, names = false;
  bool whole = false;  ///< the last block ends where the file does
};

std::uint64_t big_endian(std::istream& in) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8U | static_cast<std::uint64_t>(in.get() & 0xFF);
  return value;
}

void count(Blocks& blocks, int tag) {
  if (tag == FST_BL_VCDATA_DYN_ALIAS2) ++blocks.changes;
  if (tag == FST_BL_GEOM) blocks.geometry = true;
  if (tag == FST_BL_HIER_LZ4 || tag == FST_BL_HIER_LZ4DUO) blocks.names = true;
}

/// Each is a tag and its length, which counts itself. The first that is not finished has the tag "skip".
Blocks blocks_of(const std::string& path) {
  Blocks blocks;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  std::uint64_t at = 0;
  while (in && at < size) {
    in.seekg(static_cast<std::streamoff>(at));
    const int tag = in.get();
    const std::uint64_t length = big_endian(in);
    if (!in || tag == FST_BL_SKIP || length < 8 || length > size - at - 1) return blocks;
    count(blocks, tag);
    at += 1 + length;
  }
  blocks.whole = in && at == size;
  return blocks;
}

struct CloseReader {
  void operator()(void* reader) const { fstReaderClose(reader); }
};
using Reader = std::unique_ptr<void, CloseReader>;

Reader open_reader(const std::string& path) { return Reader(fstReaderOpen(path.c_str())); }

void ignore(void* /*file*/, std::uint64_t /*time*/, fstHandle /*signal*/, const unsigned char* /*value*/) {}

/// fstapi ends the program, or worse, when a file is damaged; so it is read in another process first.
bool readable(const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
    const Reader reader = open_reader(path);
    if (!reader) ::_exit(1);
    fstReaderSetFacProcessMaskAll(reader.get());
    ::_exit(fstReaderIterBlocks(reader.get(), ignore, nullptr, nullptr) == 1 ? 0 : 1);
  }
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A file under construction, and its variables by the handles of the one that is read.
struct Copy {
  explicit Copy(const std::string& path) : file(path) {}
  FstFile file;
  std::vector<FstFile::Handle> variables{0};
};

void declare(void* reader, Copy& copy) {
  while (const fstHier* entry = fstReaderIterateHier(reader)) {
    if (entry->htyp == FST_HT_SCOPE) copy.file.open_scope(entry->u.scope.name);
    if (entry->htyp == FST_HT_UPSCOPE) copy.file.close_scope();
    if (entry->htyp != FST_HT_VAR) continue;
    const bool words = entry->u.var.typ == FST_VT_GEN_STRING;
    copy.variables.push_back(copy.file.variable(entry->u.var.name, words ? 0 : entry->u.var.length));
  }
}

void change(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value) {
  Copy& copy = *static_cast<Copy*>(to);
  copy.file.move_to(time);
  copy.file.set(copy.variables.at(signal), reinterpret_cast<const char*>(value));
}

void change_of_word(void* to, std::uint64_t time, fstHandle signal, const unsigned char* value, std::uint32_t length) {
  Copy& copy = *static_cast<Copy*>(to);
  copy.file.move_to(time);
  copy.file.say(copy.variables.at(signal), {reinterpret_cast<const char*>(value), length});
}

void check_recoverable(const std::string& part) {
  const Blocks blocks = blocks_of(part);
  if (blocks.names)
    throw InputError(part, 0, "is complete, so there is nothing to recover: give it the name that it should have");
  if (blocks.changes == 0) throw InputError(part, 0, "holds no changes yet, so there is nothing to recover");
  if (::access((part + ".hier").c_str(), R_OK) != 0)
    throw InputError(part, 0, "needs " + part + ".hier beside it, which has the names of the signals");
  if (!readable(part)) throw InputError(part, 0, "is damaged and cannot be read");
}

}  // namespace

bool fst_is_complete(const std::string& path) {
  const Blocks blocks = blocks_of(path);
  if (!blocks.whole || blocks.changes == 0 || !blocks.geometry || !blocks.names) return false;
  return open_reader(path) != nullptr;
}

std::uint64_t recover_fst(const std::string& part, const std::string& output) {
  check_recoverable(part);
  const Reader reader = open_reader(part);
  if (!reader) throw InputError(part, 0, "cannot be read");
  const std::uint64_t end = fstReaderGetEndTime(reader.get());
  Copy copy(output);
  declare(reader.get(), copy);
  fstReaderSetFacProcessMaskAll(reader.get());
  fstReaderIterBlocks2(reader.get(), change, change_of_word, &copy, nullptr);
  copy.file.move_to(end);
  copy.file.finish();
  return end;
}

}  // namespace tb
