// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/object.hpp"

#include <vector>

#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

std::vector<std::unique_ptr<Object>>& objects() {
  static std::vector<std::unique_ptr<Object>> all;
  return all;
}

std::string& last_error() {
  static std::string text;
  return text;
}

}  // namespace

void check(dpsim_status status) {
  if (status != DPSIM_OK) throw Error(status, dpsim_error_message());
}

const char* Object::take() {
  taken_.clear();
  if (!messages_.empty()) {
    taken_ = std::move(messages_.front());
    messages_.pop_front();
  }
  return taken_.c_str();
}

int32_t keep(std::unique_ptr<Object> object) {
  objects().push_back(std::move(object));
  return static_cast<int32_t>(objects().size());
}

Object& object(int32_t handle) {
  const auto index = static_cast<std::size_t>(handle) - 1;
  if (handle < 1 || index >= objects().size() || !objects()[index])
    throw Error(DPSIM_ERR_ARGUMENT, "handle " + std::to_string(handle) + " is none: was the object created?");
  return *objects()[index];
}

void drop(int32_t handle) {
  object(handle);
  objects()[static_cast<std::size_t>(handle) - 1].reset();
}

void set_error(const std::string& text) { last_error() = text; }
const std::string& error() { return last_error(); }

}  // namespace dsdpv1::simulator

const char* dsdpv1_error() { return dsdpv1::simulator::error().c_str(); }

const char* dsdpv1_message(int32_t handle) {
  const char* text = "";
  dsdpv1::simulator::guarded([&] {
    text = dsdpv1::simulator::object(handle).take();
    return 0;
  });
  return text;
}

int32_t dsdpv1_close(int32_t handle) {
  return dsdpv1::simulator::guarded([&] {
    dsdpv1::simulator::drop(handle);
    return 0;
  });
}
