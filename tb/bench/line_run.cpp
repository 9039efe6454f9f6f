#include "tb/bench/line_run.hpp"

namespace dsdpv1::tb {

void LineRun::begin(const bus::CharacterRun& run) {
  end();
  bool level = true;
  for (std::size_t i = 0; i < run.size; ++i) {
    const unsigned frame = bus::frame_of(run.bytes[i]);
    for (int bit = 0; bit < bus::kCharacterBits; ++bit) {
      const bool sent = ((frame >> bit) & 1U) != 0;
      if (sent != level) edges_.push_back(run.character(i) + bit * run.bit);
      level = sent;
    }
  }
}

}  // namespace dsdpv1::tb
