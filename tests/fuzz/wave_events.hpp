#pragma once
// All of a wave, whatever its format.
#include "io/input/input_error.hpp"
#include "io/waves/wave_reader.hpp"
#include "tests/fuzz/in_memory.hpp"

namespace dsdpv1::fuzz {

inline void check_declarations(const tb::WaveDeclarations& declared) {
  for (const tb::WaveVariable& each : declared.variables)
    promise(each.scope < declared.scopes.size() && each.signal < declared.signals.size(), "a variable has its place");
}

inline void check_event(const tb::WaveDeclarations& declared, const tb::WaveEvent& event) {
  if (event.kind != tb::WaveEvent::Kind::kChange) return;
  promise(event.signal < declared.signals.size(), "a change is of a signal");
  const tb::WaveSignal& signal = declared.signals[event.signal];
  if (signal.kind != tb::WaveKind::kBits) return;
  promise(event.value.size() == signal.width, "a value is as wide as its signal");
  promise(event.value.find_first_not_of("01xz") == std::string_view::npos, "a bit is 0, 1, x or z");
}

inline void read_wave(const std::uint8_t* data, std::size_t size) {
  const std::string path = file_of(data, size);
  try {
    const std::unique_ptr<tb::WaveReader> reader = tb::read_wave(path);
    check_declarations(reader->declarations());
    std::uint64_t now = 0;
    for (tb::WaveEvent event; reader->next(event); now = event.time) {
      promise(event.time >= now, "time never decreases");
      check_event(reader->declarations(), event);
    }
  } catch (const tb::InputError& error) {
    promise_named(error.what(), path);
  }
}

}  // namespace dsdpv1::fuzz
