#include "tb/bench/line_run.hpp"

namespace dsdpv1::tb {

void LineRun::begin(const bus::CharacterRun& run) {
  end();
  bus::for_each_change(run, [this](bus::Tick at, bool /*level*/) { edges_.push_back(at); });
}

}  // namespace dsdpv1::tb
