#include "tb/waves/fst_writer.hpp"

#include <fstapi.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "tb/report/output_file.hpp"
#include "tb/scenario/input_error.hpp"
#include "tb/waves/level_text.hpp"

namespace tb {

namespace {

/// The writer of `part`, which becomes `path` when it is complete.
void* create(const std::string& path, const std::string& part) {
  {
    OutputFile probe(path);  // gives the reason when the file cannot be created; fstapi does not
  }
  void* const context = fstWriterCreate(part.c_str(), 1);
  if (context == nullptr) throw InputError(path, 0, "cannot be written as FST");
  return context;
}

}  // namespace

FstWriter::FstWriter(std::string path)
    : path_(std::move(path)), part_(part_name(path_)), context_(create(path_, part_)) {
  fstWriterSetTimescaleFromString(context_, "1ps");
  fstWriterSetVersion(context_, "dsdpv1-sim");
  fstWriterSetDate(context_, "");  // the same run gives the same file
  fstWriterSetPackType(context_, FST_WR_PT_LZ4);
}

FstWriter::~FstWriter() {
  if (context_ == nullptr) return;
  fstWriterClose(context_);
  std::remove(part_.c_str());
}

void FstWriter::open_scope(const std::string& name) {
  fstWriterSetScope(context_, FST_ST_VCD_MODULE, name.c_str(), nullptr);
}
void FstWriter::close_scope() { fstWriterSetUpscope(context_); }

WaveWriter::Signal FstWriter::wire(const std::string& name, int width) {
  widths_.push_back(width);
  const std::string range = width > 1 ? " [" + std::to_string(width - 1) + ":0]" : "";
  return fstWriterCreateVar(context_, FST_VT_VCD_WIRE, FST_VD_IMPLICIT, static_cast<std::uint32_t>(width),
                            (name + range).c_str(), 0);
}

WaveWriter::Signal FstWriter::words(const std::string& name) {
  widths_.push_back(0);
  return fstWriterCreateVar(context_, FST_VT_GEN_STRING, FST_VD_IMPLICIT, 0, name.c_str(), 0);
}

void FstWriter::move_to(bus::Tick at) {
  if (at < now_) throw std::logic_error("wave changes out of order");
  if (now_ < 0 || picoseconds(at) != picoseconds(now_)) fstWriterEmitTimeChange(context_, picoseconds(at));
  now_ = at;
}

void FstWriter::set(bus::Tick at, Signal signal, int level) {
  move_to(at);
  const auto text = level_text(level, widths_.at(signal - 1));
  fstWriterEmitValueChange(context_, signal, text.data());
}

void FstWriter::say(bus::Tick at, Signal signal, std::string_view word) {
  move_to(at);
  fstWriterEmitVariableLengthValueChange(context_, signal, word.data(), static_cast<std::uint32_t>(word.size()));
}

void FstWriter::finish(bus::Tick end) {
  move_to(std::max(end, now_));
  fstWriterClose(context_);
  context_ = nullptr;
  rename_part(part_, path_);
}

}  // namespace tb
