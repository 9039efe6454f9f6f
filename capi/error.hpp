#pragma once
// Failure of a C API call: an exception inside the library, a code and a message at its boundary.
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include "dsdpv1/types.h"

namespace dsdpv1::capi {

class Error : public std::runtime_error {
 public:
  Error(dpsim_status code, const std::string& text) : std::runtime_error(text), status(code) {}
  const dpsim_status status;
};

/// Turns the exception that is being handled into its status, and keeps "function: what is wrong" for this thread.
dpsim_status note_error(const char* function) noexcept;

/// The body of a function of the API: catches all exceptions.
template <class Body>
dpsim_status guarded(const char* function, const Body& body) noexcept {
  try {
    body();
    return DPSIM_OK;
  } catch (...) {
    return note_error(function);
  }
}

[[noreturn]] void fail(dpsim_status status, const std::string& text);
/// A pointer that must not be NULL; `name` is its name in the header.
inline void need(const void* pointer, const char* name) {
  if (pointer == nullptr) fail(DPSIM_ERR_ARGUMENT, std::string(name) + " is NULL");
}
/// A buffer of `count` elements, NULL only if `count` is 0.
inline void need_buffer(const void* pointer, std::size_t count, const char* name) {
  if (count != 0) need(pointer, name);
}
/// A value that must be from `low` to `high`.
void need_range(const char* name, long long value, long long low, long long high);

}  // namespace dsdpv1::capi
