#pragma once
// The reports of a module through its analysis ports, to any number of listeners.
#include <tlm.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/profibus/event.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// A pin has this level from tick `at` on; the chip's ticks: simulation time less the phase.
template <class Pin, class Level>
struct PinChange {
  Tick at = 0;
  Pin pin{};
  Level level = 0;
};

/// An access of a host through a socket: one byte.
struct AccessReport {
  Tick begin = 0, end = 0;  ///< the chip's, as those of PinChange
  bool write = false;
  std::uint16_t address = 0;
  std::int16_t value = 0;  ///< written or read; negative: nothing certain was read
  bool ok = true;          ///< TLM_OK_RESPONSE
  bool ahead = false;      ///< carried out ahead of simulation time
};

struct ModuleEnd {};

/// A port that knows its listeners.
template <class T>
class ListenedPort : public tlm::tlm_analysis_port<T> {
 public:
  using tlm::tlm_analysis_port<T>::tlm_analysis_port;
  void bind(tlm::tlm_analysis_if<T>& listener) override {
    tlm::tlm_analysis_port<T>::bind(listener);
    listeners_.push_back(&listener);
  }
  /// Also in a call of a listener.
  bool unbind(tlm::tlm_analysis_if<T>& listener) override {
    for (auto*& each : listeners_)
      if (each == &listener) each = nullptr;
    if (telling_ == 0) forget();
    return tlm::tlm_analysis_port<T>::unbind(listener);
  }
  bool bound() const { return !listeners_.empty(); }
  /// As write(), but `tell(call)` makes each call, so that an exception need not keep the others from being told.
  template <class Tell>
  void tell_each(const T& what, const Tell& tell) {
    if (listeners_.empty()) return;
    ++telling_;
    for (std::size_t i = 0; i < listeners_.size(); ++i)
      if (listeners_[i] != nullptr) tell([&] { listeners_[i]->write(what); });
    if (--telling_ == 0) forget();
  }

 private:
  void forget() { listeners_.erase(std::remove(listeners_.begin(), listeners_.end(), nullptr), listeners_.end()); }

  std::vector<tlm::tlm_analysis_if<T>*> listeners_;
  int telling_ = 0;  ///< calls of tell_each in progress
};

// In the library alone: its bases are virtual, and the tables for their construction of two compilers do not fit each
// other. So for every instantiation.
extern template class ListenedPort<profibus::Event>;
extern template class ListenedPort<AccessReport>;
extern template class ListenedPort<Tick>;
extern template class ListenedPort<ModuleEnd>;
extern template class ListenedPort<std::uint8_t>;

}  // namespace dsdpv1::systemc
