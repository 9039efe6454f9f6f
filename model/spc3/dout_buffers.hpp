#pragma once
// Dout_Buffer_SM: the three output buffers (M 5.2.5.1; A17). The chip fills D; N has the newest outputs; U is the
// user's.
#include "model/spc3/buffer_states.hpp"

namespace dsdpv1::spc3 {

class DoutBuffers {
 public:
  void reset() { *this = DoutBuffers(); }

  /// D has new outputs, or zeros if `cleared`: it becomes N.
  void deliver(bool cleared) {
    const unsigned bit = 1U << states_.d;
    cleared_ = static_cast<std::uint8_t>(cleared ? cleared_ | bit : cleared_ & ~bit);
    states_.pass_on(states_.d);
  }
  /// Next_Dout_Buffer_Cmd: the newest outputs become the user's. Its answer.
  std::uint8_t next() {
    const bool is_new = states_.n != 0;
    if (is_new) states_.fetch(states_.u);
    const bool cleared = (cleared_ >> states_.u & 1U) != 0;
    return static_cast<std::uint8_t>(states_.u | (is_new ? 1U << 2 : 0U) | (cleared ? 1U << 3 : 0U));
  }

  const BufferStates& states() const { return states_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [states, cleared] = *this;
    archive(states, cleared);
  }

 private:
  BufferStates states_;
  std::uint8_t cleared_ = 0;  // a bit for each buffer
};

}  // namespace dsdpv1::spc3
