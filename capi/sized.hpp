#pragma once
// Structs of the header that begin with their size, as compiled by the caller.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "capi/error.hpp"

namespace dsdpv1::capi {

/// The size of the first version of a struct; specialised for structs that have grown.
template <class T>
inline constexpr std::uint32_t kFirstSize = sizeof(T);

template <class T>
void check_size(const T& given, const char* name) {
  if (given.size >= kFirstSize<T> && given.size <= sizeof(T)) return;
  fail(DPSIM_ERR_SIZE, std::string("size of ") + name + " is " + std::to_string(given.size) + ", expected sizeof, " +
                           std::to_string(sizeof(T)) + " here");
}

/// The caller's struct; NULL means all defaults.
template <class T>
T options_of(const T* given, const char* name) {
  T options{};
  if (given == nullptr) return options;
  check_size(*given, name);
  std::memcpy(&options, given, given->size);
  return options;
}

/// Fills the caller's struct up to its size.
template <class T>
void give(T filled, T* result, const char* name) {
  need(result, name);
  check_size(*result, name);
  filled.size = result->size;
  std::memcpy(result, &filled, result->size);
}

}  // namespace dsdpv1::capi
