// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// Objects with numbers for the simulator, and the way of their errors back to it.
#include <cstdint>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <typeinfo>

#include "dsdpv1/dsdpv1.h"

namespace dsdpv1::simulator {

struct Error : std::runtime_error {
  Error(dpsim_status code, const std::string& what) : std::runtime_error(what), status(code) {}
  dpsim_status status;
};

/// Throws the C API's error.
void check(dpsim_status status);

class Object {
 public:
  virtual ~Object() = default;
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  void say(std::string text) { messages_.push_back(std::move(text)); }
  /// Takes the oldest message out of the queue; valid until the next call.
  const char* take();

 protected:
  Object() = default;

 private:
  std::deque<std::string> messages_;
  std::string taken_;
};

int32_t keep(std::unique_ptr<Object> object);
void drop(int32_t handle);
/// Throws if there is none.
Object& object(int32_t handle);

/// `Type` is a final class: comparing is faster than a dynamic_cast, which each event of the simulator would pay for.
template <class Type>
Type& get(int32_t handle) {
  static_assert(std::is_final_v<Type>);
  Object& found = object(handle);
  if (typeid(found) != typeid(Type))
    throw Error(DPSIM_ERR_ARGUMENT, "handle " + std::to_string(handle) + " is another kind of object");
  return static_cast<Type&>(found);
}

void set_error(const std::string& text);
const std::string& error();

/// Calls `function`; an exception becomes its status, with the text in dsdpv1_error().
template <class Function>
auto guarded(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (const Error& failed) {
    set_error(failed.what());
    return failed.status;
  } catch (const std::exception& failed) {
    set_error(failed.what());
    return DPSIM_ERR_INTERNAL;
  }
}

/// As above for a function that creates an object: 0 if it fails.
template <class Function>
int32_t created(const Function& function) {
  const int32_t handle = guarded([&] { return keep(function()); });
  return handle < 0 ? 0 : handle;
}

}  // namespace dsdpv1::simulator
