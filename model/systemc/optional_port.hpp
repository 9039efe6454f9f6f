#pragma once
// Ports that may stay unbound. sc_trace takes them as it takes an sc_in or sc_out, also before they are bound.
#include <string>
#include <systemc>
#include <utility>
#include <vector>

namespace dsdpv1::systemc {

/// `Interface`: of a signal.
template <class Interface>
class OptionalPort : public sc_core::sc_port<Interface, 1, sc_core::SC_ZERO_OR_MORE_BOUND> {
 public:
  using sc_core::sc_port<Interface, 1, sc_core::SC_ZERO_OR_MORE_BOUND>::sc_port;

  /// The signal's level in `file`; nothing if the port stays unbound.
  void add_trace(sc_core::sc_trace_file* file, const std::string& name) const {
    if (this->size() > 0)
      sc_core::sc_trace(file, (*this)->read(), name);
    else
      waiting_.emplace_back(file, name);
  }

 protected:
  void end_of_elaboration() override {
    if (this->size() == 0) return;
    for (const auto& [file, name] : std::exchange(waiting_, {})) add_trace(file, name);
  }

 private:
  mutable std::vector<std::pair<sc_core::sc_trace_file*, std::string>> waiting_;
};

template <class Interface>
void sc_trace(sc_core::sc_trace_file* file, const OptionalPort<Interface>& port, const std::string& name) {
  port.add_trace(file, name);
}

using OptionalIn = OptionalPort<sc_core::sc_signal_in_if<bool>>;
using OptionalOut = OptionalPort<sc_core::sc_signal_inout_if<bool>>;

}  // namespace dsdpv1::systemc
