#pragma once
// Din_Buffer_SM: the three input buffers (M 5.2.5.2; A17). The user fills U; N has the newest inputs; D is sent.
#include "model/spc3/buffer_states.hpp"

namespace dsdpv1::spc3 {

class DinBuffers {
 public:
  void reset() { *this = DinBuffers(); }

  /// New_Din_Buffer_Cmd: U becomes N. Its answer, the user's new buffer.
  std::uint8_t give() {
    states_.pass_on(states_.u);
    return states_.u;
  }
  /// Before an answer with inputs, and at Freeze: the newest become D.
  void take() {
    if (states_.n != 0) states_.fetch(states_.d);
  }
  bool has_new() const { return states_.n != 0; }

  const BufferStates& states() const { return states_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [states] = *this;
    archive(states);
  }

 private:
  BufferStates states_;
};

}  // namespace dsdpv1::spc3
