#include "tb/waves/fst_file.hpp"

#include <fstapi.h>
#include <unistd.h>

#include <cerrno>

#include "tb/input/input_error.hpp"
#include "tb/waves/fst_io.h"
#include "tb/waves/recover.hpp"

namespace tb {

namespace {

/// Looked at before it is opened: to open a FIFO is to wait for its reader.
const std::string& regular(const std::string& path) {
  if (!find_place(path).direct) return path;
  throw InputError(path, 0, "is no regular file, allowed for FST is one; a device or FIFO can take a .vcd");
}

}  // namespace

FstFile::FstFile(const std::string& path)
    : part_(regular(path)), declarations_(part_.part() + ".hier"), context_(create()) {
  fstWriterSetTimescaleFromString(context_, "1ps");
  fstWriterSetVersion(context_, kWaveVersion);
  fstWriterSetDate(context_, "");  // the same run gives the same changes, and no other sign of when it was
  fstWriterSetPackType(context_, FST_WR_PT_LZ4);
  keep_error();
}

void* FstFile::create() {
  fst_io_take_error();
  fst_io_create_on(part_.take_descriptor());
  void* const context = fstWriterCreate(part_.part().c_str(), 1);
  const int error = fst_io_take_error();
  if (context == nullptr) {
    ::unlink(declarations_.text().c_str());
    refuse_output(part_.path(), error != 0 ? error : ENOMEM);
  }
  error_ = error;
  return context;
}

FstFile::~FstFile() {
  if (context_ != nullptr) close();
}

void FstFile::keep_error() {
  const int error = fst_io_take_error();
  if (error_ == 0) error_ = error;
}

void FstFile::open_scope(const std::string& name) {
  fstWriterSetScope(context_, FST_ST_VCD_MODULE, name.c_str(), nullptr);
}

void FstFile::close_scope() { fstWriterSetUpscope(context_); }

FstFile::Handle FstFile::variable(const std::string& name, std::uint32_t width, Handle alias) {
  const fstVarType type = width != 0 ? FST_VT_VCD_WIRE : FST_VT_GEN_STRING;
  return fstWriterCreateVar(context_, type, FST_VD_IMPLICIT, width, name.c_str(), alias);
}

void FstFile::move_to(std::uint64_t time) {
  if (time_ == time || failed()) return;
  fstWriterEmitTimeChange(context_, time);
  keep_error();
  if (time_) ++steps_;
  time_ = time;
}

void FstFile::set(Handle variable, const char* levels) {
  if (failed()) return;
  fstWriterEmitValueChange(context_, variable, levels);
  changed_ = true;
}

void FstFile::say(Handle variable, std::string_view word) {
  if (failed()) return;
  fstWriterEmitVariableLengthValueChange(context_, variable, word.data(), static_cast<std::uint32_t>(word.size()));
  changed_ = true;
}

/// fstapi writes the block at the next change of time, which may be far away: so there is one now. Without a change of
/// value it would spoil its table of times, so then there is no block.
void FstFile::save(std::uint64_t time) {
  if (!changed_ || !time_) return;
  const bool block = steps_ > 1 && time_ != time;
  fstWriterFlushContext(context_);
  move_to(time);
  if (!block) return;
  changed_ = false;
  steps_ = 1;
}

void FstFile::check() const {
  if (failed()) refuse_output(part_.path(), error_);
}

void FstFile::close() {
  fstWriterClose(context_);
  context_ = nullptr;
  keep_error();
}

void FstFile::finish() {
  close();
  check();
  if (!fst_is_complete(part_.part())) throw InputError(part_.path(), 0, "cannot be written: it does not read back");
  part_.place();
}

}  // namespace tb
