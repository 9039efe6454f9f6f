#include "lab/compare/both_wave.hpp"

#include <algorithm>

namespace dsdpv1::tb::compare {
namespace {

std::string without_blanks(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

}  // namespace

BothWave::BothWave(const std::string& path, const std::vector<Pair>& pairs)
    : writer_(open_wave(path)), signals_(pairs.size()) {
  for (const auto& [scope, side] : {std::pair("a", &Signals::a), std::pair("b", &Signals::b)}) {
    writer_->open_scope(scope);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Net& net = pairs[i].a.net;
      signals_[i].text = net.kind != WaveKind::kBits;
      signals_[i].*side = signals_[i].text ? writer_->words(without_blanks(pairs[i].name))
                                           : writer_->wire(without_blanks(pairs[i].name), static_cast<int>(net.width));
    }
    writer_->close_scope();
  }
  writer_->open_scope("differs");
  any_ = writer_->wire("any", 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) signals_[i].differs = writer_->wire(without_blanks(pairs[i].name), 1);
  writer_->close_scope();
}

void BothWave::write(Picoseconds at, WaveWriter::Signal signal, bool text, std::string_view value) {
  if (text)
    writer_->say(at, signal, value);
  else
    writer_->set(at, signal, value);
}

void BothWave::set(const Scale& scale, Time time, std::uint32_t pair, std::string_view a, std::string_view b,
                   bool differs) {
  const Picoseconds at{scale.picoseconds(time)};
  Signals& own = signals_[pair];
  const bool any_before = different_ != 0;
  if (!own.known || own.a_value != a) write(at, own.a, own.text, own.a_value = a);
  if (!own.known || own.b_value != b) write(at, own.b, own.text, own.b_value = b);
  if (!own.known || own.different != differs) writer_->set(at, own.differs, differs ? "1" : "0");
  different_ = different_ + (differs ? 1U : 0U) - (own.different ? 1U : 0U);
  own.different = differs;
  own.known = true;
  if (!begun_ || any_before != (different_ != 0)) writer_->set(at, any_, different_ != 0 ? "1" : "0");
  begun_ = true;
}

void BothWave::finish(const Scale& scale, Time end) { writer_->finish(Picoseconds{scale.picoseconds(end)}); }

}  // namespace dsdpv1::tb::compare
