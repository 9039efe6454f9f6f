#include "io/waves/fst_writer.hpp"

#include <algorithm>
#include <stdexcept>

#include "io/waves/level_text.hpp"

namespace dsdpv1::tb {

namespace {

std::string with_range(const std::string& name, int width) {
  return width > 1 ? name + " [" + std::to_string(width - 1) + ":0]" : name;
}

}  // namespace

WaveWriter::Signal FstWriter::wire(const std::string& name, int width) {
  widths_.push_back(width);
  return file_.variable(with_range(name, width), static_cast<std::uint32_t>(width));
}

WaveWriter::Signal FstWriter::words(const std::string& name) {
  widths_.push_back(0);
  return file_.variable(name, 0);
}

void FstWriter::alias(const std::string& name, Signal of) {
  const int width = widths_.at(of - 1);
  file_.variable(with_range(name, width), static_cast<std::uint32_t>(width), of);
}

void FstWriter::move_to(bus::Tick at) {
  if (at < now_) throw std::logic_error("wave changes out of order");
  if (at == moved_to_) return;
  file_.move_to(picoseconds(at));
  now_ = moved_to_ = at;
}

void FstWriter::set(bus::Tick at, Signal signal, int level) {
  move_to(at);
  file_.set(signal, level_text(level, widths_.at(signal - 1)).data());
}

void FstWriter::say(bus::Tick at, Signal signal, std::string_view word) {
  move_to(at);
  file_.say(signal, word);
}

void FstWriter::save(bus::Tick at) {
  now_ = std::max(at, now_);
  file_.save(picoseconds(now_));
}

void FstWriter::finish(bus::Tick end) {
  move_to(std::max(end, now_));
  file_.finish();
}

void FstWriter::set(Picoseconds at, Signal signal, std::string_view levels) {
  file_.move_to(at.count);
  file_.set(signal, std::string(levels).c_str());
}

void FstWriter::say(Picoseconds at, Signal signal, std::string_view word) {
  file_.move_to(at.count);
  file_.say(signal, word);
}

void FstWriter::finish(Picoseconds end) {
  file_.move_to(end.count);
  file_.finish();
}

}  // namespace dsdpv1::tb
