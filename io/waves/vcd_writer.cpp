#include "io/waves/vcd_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/waves/level_text.hpp"
#include "io/waves/recover.hpp"

namespace dsdpv1::tb {
namespace {

// Readers that do not know `string` variables (sigrok) skip their values, and read the short name after them
// separately. So it must not look like a change, a time ('#') or a command ('$').
constexpr char kWordsBegin = '~', kFirst = '%', kLast = '}';

/// The short name of a signal, in the characters % to }; those of words begin with ~.
std::string identifier(WaveWriter::Signal signal, bool words) {
  constexpr unsigned kBase = kLast - kFirst + 1;
  std::string text = words ? std::string(1, kWordsBegin) : "";
  do {
    text += static_cast<char>(kFirst + signal % kBase);
    signal /= kBase;
  } while (signal != 0);
  return text;
}

}  // namespace

VcdWriter::VcdWriter(const std::string& path, const std::string& date) : file_(path) {
  file_.write(fmt::format("$version {}{} $end\n", kWaveAuthor, DSDPV1_VERSION));
  if (!date.empty()) file_.write(fmt::format("$date {} $end\n", date));
  file_.write("$timescale 1 ps $end\n");
}

void VcdWriter::open_scope(const std::string& name) { file_.write(fmt::format("$scope module {} $end\n", name)); }
void VcdWriter::close_scope() { file_.write("$upscope $end\n"); }

WaveWriter::Signal VcdWriter::add(const std::string& name, int width) {
  const auto signal = static_cast<Signal>(widths_.size());
  widths_.push_back(width);
  names_.push_back(identifier(signal, width == kWords));
  declare(name, signal);
  return signal;
}

void VcdWriter::declare(const std::string& name, Signal signal) {
  const int width = widths_.at(signal);
  const std::string range = width > 1 ? fmt::format(" [{}:0]", width - 1) : "";
  const char* const type = width == kWords ? "string" : "wire";
  file_.write(fmt::format("$var {} {} {} {}{} $end\n", type, std::max(width, 1), names_.at(signal), name, range));
}

WaveWriter::Signal VcdWriter::wire(const std::string& name, int width) { return add(name, width); }
WaveWriter::Signal VcdWriter::words(const std::string& name) { return add(name, kWords); }
void VcdWriter::alias(const std::string& name, Signal of) { declare(name, of); }

Picoseconds VcdWriter::in_order(bus::Tick at) {
  if (at < now_) throw std::logic_error("wave changes out of order");
  now_ = at;
  return {picoseconds(at)};
}

void VcdWriter::move_to(Picoseconds at) {
  if (!time_) file_.write("$enddefinitions $end\n");
  if (time_ != at.count) file_.write(fmt::format("#{}\n", at.count));
  time_ = at.count;
}

void VcdWriter::set(bus::Tick at, Signal signal, int level) {
  const int width = widths_.at(signal);
  const auto text = level_text(level, width);
  set(in_order(at), signal, {text.data(), static_cast<std::size_t>(width)});
}

void VcdWriter::set(Picoseconds at, Signal signal, std::string_view levels) {
  move_to(at);
  file_.write(levels.size() == 1 ? fmt::format("{}{}\n", levels, names_.at(signal))
                                 : fmt::format("b{} {}\n", levels, names_.at(signal)));
}

void VcdWriter::say(bus::Tick at, Signal signal, std::string_view word) { say(in_order(at), signal, word); }

void VcdWriter::say(Picoseconds at, Signal signal, std::string_view word) {
  move_to(at);
  std::string text;
  for (const char c : word)
    text += c == ' ' ? "_" : c == '\\' ? "\\\\" : std::string(1, c);  // it ends at the first blank
  file_.write(fmt::format("s{} {}\n", text, names_.at(signal)));
}

void VcdWriter::finish(bus::Tick end) { finish(in_order(std::max(end, now_))); }

void VcdWriter::finish(Picoseconds end) {
  move_to(end);
  file_.commit();
}

}  // namespace dsdpv1::tb
