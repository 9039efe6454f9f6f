#pragma once
// Readers of captures: their output and errors.
#include "bus/capture/captured_telegram.hpp"
#include "bus/telegram/explain.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1::fuzz {

/// Takes each telegram in words, as `decode` does.
inline void take(const bus::capture::CapturedTelegram& telegram) {
  promise(telegram.end >= telegram.start, "a telegram does not end before it begins");
  promise(!telegram.baud || (*telegram.baud >= 0 && *telegram.baud < bus::kBaudCount), "a rate is one of the table");
  bus::capture::damage_words(telegram.damage);
  bus::explain_bytes(bus::decode(telegram.bytes));
}

/// `read` of a capture; an exception has one line.
template <class Read>
void read_capture(const Read& read) {
  try {
    read();
  } catch (const bus::capture::CaptureError& error) {
    promise(*error.what() != '\0', "an error has words");
  }
}

}  // namespace dsdpv1::fuzz
