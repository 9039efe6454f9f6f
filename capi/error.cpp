#include "capi/error.hpp"

#include <array>
#include <new>
#include <string>
#include <utility>

#include "bus/printable.hpp"
#include "capi/names.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::capi {
namespace {

std::string& message() {
  thread_local std::string text;
  return text;
}

thread_local bool has_no_memory = false;

dpsim_status keep(dpsim_status status, const char* function, const char* text) {
  has_no_memory = false;
  message() = bus::printable(std::string(function) + ": " + text);
  return status;
}

/// Errors about files and texts already contain their place. Quoted text is made one line without control effects.
dpsim_status keep_input(std::string text) {
  has_no_memory = false;
  message() = std::move(text);
  return DPSIM_ERR_INPUT;
}

dpsim_status classify(const char* function) {
  try {
    throw;
  } catch (const Error& error) {
    return error.status == DPSIM_ERR_INPUT ? keep_input(bus::printable_lines(error.what()))
                                           : keep(error.status, function, error.what());
  } catch (const tb::InputError& error) {
    return keep_input(bus::printable(error.what()));
  } catch (const std::invalid_argument& error) {
    return keep(DPSIM_ERR_ARGUMENT, function, error.what());
  } catch (const std::bad_alloc&) {
    has_no_memory = true;
    return DPSIM_ERR_NO_MEMORY;
  } catch (const std::exception& error) {
    return keep(DPSIM_ERR_INTERNAL, function, error.what());
  } catch (...) {
    return keep(DPSIM_ERR_INTERNAL, function, "an exception of no known type");
  }
}

}  // namespace

dpsim_status note_error(const char* function) noexcept {
  try {
    return classify(function);
  } catch (...) {  // no memory for the message
    has_no_memory = true;
    return DPSIM_ERR_NO_MEMORY;
  }
}

void fail(dpsim_status status, const std::string& text) { throw Error(status, text); }

void need_range(const char* name, long long value, long long low, long long high) {
  if (value >= low && value <= high) return;
  fail(DPSIM_ERR_ARGUMENT, std::string(name) + " is " + std::to_string(value) + ", expected " + std::to_string(low) +
                               " to " + std::to_string(high));
}

}  // namespace dsdpv1::capi

const char* dpsim_error_message() { return capi::has_no_memory ? "there is no memory left" : capi::message().c_str(); }

const char* dpsim_status_name(dpsim_status status) {
  static constexpr std::array<const char*, 11> kNames = {
      "DPSIM_OK",          "DPSIM_ERR_ARGUMENT", "DPSIM_ERR_SIZE",  "DPSIM_ERR_NOT_FOUND",   "DPSIM_ERR_TIME",
      "DPSIM_ERR_STATE",   "DPSIM_ERR_INPUT",    "DPSIM_ERR_SPACE", "DPSIM_ERR_UNSUPPORTED", "DPSIM_ERR_NO_MEMORY",
      "DPSIM_ERR_INTERNAL"};
  return status <= 0 && -status < static_cast<int>(kNames.size()) ? kNames.at(static_cast<std::size_t>(-status))
                                                                  : "unknown status";
}
