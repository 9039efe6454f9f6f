#include "io/waves/deferred_wave.hpp"

namespace dsdpv1::tb {

void DeferredWave::open() {
  writer_ = open_wave(path_, date_);
  for (const auto& declaration : declarations_) declaration(*writer_);
}

WaveWriter::Signal DeferredWave::wire(const std::string& name, int width) {
  declare([this, name, width](WaveWriter& writer) { signals_.push_back(writer.wire(name, width)); });
  return declared_++;
}

WaveWriter::Signal DeferredWave::words(const std::string& name) {
  declare([this, name](WaveWriter& writer) { signals_.push_back(writer.words(name)); });
  return declared_++;
}

}  // namespace dsdpv1::tb
