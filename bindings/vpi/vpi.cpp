// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The functions of simulator.h as system functions of VPI: dsdpv1_model_step is $dsdpv1_model_step. The signature of a
// C++ function determines how its arguments are read from the call and written back to it.
#include <vpi_user.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "bindings/simulator/simulator.h"

namespace {

constexpr int kTextBits = 8 * 2048;  // for a function that returns text
constexpr int kWords = DSDPV1_BYTES / 4;

int64_t read_number(vpiHandle from, int words) {
  s_vpi_value value{};
  value.format = vpiVectorVal;
  vpi_get_value(from, &value);
  const int size = vpi_get(vpiSize, from);
  uint64_t number = 0;
  for (int i = 0; i < words && i * 32 < size; ++i) {
    const uint64_t known = static_cast<uint32_t>(value.value.vector[i].aval & ~value.value.vector[i].bval);
    number |= known << (32 * i);
  }
  return static_cast<int64_t>(number);
}

template <std::size_t Count>
void write_words(vpiHandle to, std::array<s_vpi_vecval, Count>& words) {
  s_vpi_value value{};
  value.format = vpiVectorVal;
  value.value.vector = words.data();
  vpi_put_value(to, &value, nullptr, vpiNoDelay);
}

void write_number(vpiHandle to, uint64_t number) {
  std::array<s_vpi_vecval, 2> words{};
  words[0].aval = static_cast<decltype(s_vpi_vecval::aval)>(number & 0xFFFF'FFFFU);
  words[1].aval = static_cast<decltype(s_vpi_vecval::aval)>(number >> 32U);
  write_words(to, words);
}

/// An argument of a call: `read` fetches it before, `pass` passes it to the function, `write` stores it afterwards.
template <class Type>
struct Argument;

template <>
struct Argument<int32_t> {
  int32_t value = 0;
  void read(vpiHandle from) { value = static_cast<int32_t>(read_number(from, 1)); }
  int32_t pass() const { return value; }
  void write(vpiHandle) {}
};

template <>
struct Argument<int64_t> {
  int64_t value = 0;
  void read(vpiHandle from) { value = read_number(from, 2); }
  int64_t pass() const { return value; }
  void write(vpiHandle) {}
};

template <>
struct Argument<const char*> {
  std::string value;
  void read(vpiHandle from) {
    s_vpi_value text{};
    text.format = vpiStringVal;
    vpi_get_value(from, &text);
    value = text.value.str == nullptr ? "" : text.value.str;
  }
  const char* pass() const { return value.c_str(); }
  void write(vpiHandle) {}
};

template <>
struct Argument<int32_t*> {
  int32_t value = 0;
  void read(vpiHandle from) { value = static_cast<int32_t>(read_number(from, 1)); }
  int32_t* pass() { return &value; }
  void write(vpiHandle to) { write_number(to, static_cast<uint32_t>(value)); }
};

template <>
struct Argument<int64_t*> {
  int64_t value = 0;
  void read(vpiHandle from) { value = read_number(from, 2); }
  int64_t* pass() { return &value; }
  void write(vpiHandle to) { write_number(to, static_cast<uint64_t>(value)); }
};

struct Vector {
  std::array<uint32_t, kWords> value{};
  void read(vpiHandle from) {
    s_vpi_value vector{};
    vector.format = vpiVectorVal;
    vpi_get_value(from, &vector);
    const int words = std::min(kWords, (vpi_get(vpiSize, from) + 31) / 32);
    for (int i = 0; i < words; ++i)
      value[static_cast<std::size_t>(i)] =
          static_cast<uint32_t>(vector.value.vector[i].aval & ~vector.value.vector[i].bval);
  }
};

template <>
struct Argument<const uint32_t*> : Vector {
  const uint32_t* pass() const { return value.data(); }
  void write(vpiHandle) {}
};

template <>
struct Argument<uint32_t*> : Vector {
  uint32_t* pass() { return value.data(); }
  void write(vpiHandle to) {
    std::array<s_vpi_vecval, kWords> words{};
    for (std::size_t i = 0; i < words.size(); ++i) words[i].aval = static_cast<decltype(s_vpi_vecval::aval)>(value[i]);
    write_words(to, words);
  }
};

void give_back(vpiHandle call, int32_t result) {
  s_vpi_value value{};
  value.format = vpiIntVal;
  value.value.integer = result;
  vpi_put_value(call, &value, nullptr, vpiNoDelay);
}

void give_back(vpiHandle call, int64_t result) { write_number(call, static_cast<uint64_t>(result)); }

void give_back(vpiHandle call, const char* result) {
  std::string text = result;
  s_vpi_value value{};
  value.format = vpiStringVal;
  value.value.str = text.data();
  vpi_put_value(call, &value, nullptr, vpiNoDelay);
}

template <class Function>
struct Call;

template <class Result, class... Types>
struct Call<Result (*)(Types...)> {
  static constexpr std::size_t kCount = sizeof...(Types);
  static constexpr int kBits = std::is_same_v<Result, const char*> ? kTextBits : 8 * static_cast<int>(sizeof(Result));

  template <std::size_t... Index>
  static void run(Result (*function)(Types...), vpiHandle call, std::index_sequence<Index...>) {
    std::array<vpiHandle, sizeof...(Types) + 1> handles{};
    if constexpr (sizeof...(Types) > 0) {
      vpiHandle all = vpi_iterate(vpiArgument, call);
      for (std::size_t i = 0; i < sizeof...(Types); ++i) handles[i] = vpi_scan(all);
      vpi_free_object(all);
    }
    std::tuple<Argument<Types>...> arguments;
    (std::get<Index>(arguments).read(handles[Index]), ...);
    give_back(call, function(std::get<Index>(arguments).pass()...));
    (std::get<Index>(arguments).write(handles[Index]), ...);
  }
};

template <auto Function>
PLI_INT32 carry_out(PLI_BYTE8*) {
  using Its = Call<decltype(Function)>;
  Its::run(Function, vpi_handle(vpiSysTfCall, nullptr), std::make_index_sequence<Its::kCount>{});
  return 0;
}

/// Before the simulation: stops it if a call has a wrong number of arguments.
template <auto Function>
PLI_INT32 check_call(PLI_BYTE8* name) {
  vpiHandle call = vpi_handle(vpiSysTfCall, nullptr);
  vpiHandle all = vpi_iterate(vpiArgument, call);
  std::size_t count = 0;
  while (all != nullptr && vpi_scan(all) != nullptr) ++count;
  constexpr std::size_t kWanted = Call<decltype(Function)>::kCount;
  if (count == kWanted) return 0;
  std::string form = "%s:%d: %s has %u arguments, it needs %u\n";  // VPI takes non-const texts
  vpi_printf(form.data(), vpi_get_str(vpiFile, call), vpi_get(vpiLineNo, call), name, static_cast<unsigned>(count),
             static_cast<unsigned>(kWanted));
  vpi_control(vpiFinish, 1);
  return 0;
}

template <auto Function>
PLI_INT32 result_size(PLI_BYTE8*) {
  return Call<decltype(Function)>::kBits;
}

template <auto Function>
void add(const char* name) {
  static_assert(std::is_pointer_v<decltype(Function)>);
  constexpr bool kSized = Call<decltype(Function)>::kBits != 32;
  std::string text = name;
  s_vpi_systf_data data{};
  data.type = vpiSysFunc;
  data.sysfunctype = kSized ? vpiSizedFunc : vpiIntFunc;
  data.tfname = text.data();
  data.calltf = carry_out<Function>;
  data.compiletf = check_call<Function>;
  data.sizetf = kSized ? result_size<Function> : nullptr;
  data.user_data = const_cast<char*>(name);  // NOLINT(cppcoreguidelines-pro-type-const-cast): VPI's signature
  vpi_register_systf(&data);
}

#define DSDPV1_ADD(function) add<function>("$" #function)

void add_all() {
  DSDPV1_ADD(dsdpv1_error);
  DSDPV1_ADD(dsdpv1_message);
  DSDPV1_ADD(dsdpv1_close);
  DSDPV1_ADD(dsdpv1_model_create);
  DSDPV1_ADD(dsdpv1_model_step);
  DSDPV1_ADD(dsdpv1_scoreboard_create);
  DSDPV1_ADD(dsdpv1_scoreboard_step);
  DSDPV1_ADD(dsdpv1_scoreboard_matched);
  DSDPV1_ADD(dsdpv1_checker_create);
  DSDPV1_ADD(dsdpv1_checker_step);
  DSDPV1_ADD(dsdpv1_checker_finish);
  DSDPV1_ADD(dsdpv1_checker_applied);
  DSDPV1_ADD(dsdpv1_master_create);
  DSDPV1_ADD(dsdpv1_master_load);
  DSDPV1_ADD(dsdpv1_master_step);
  DSDPV1_ADD(dsdpv1_master_add_gsd);
  DSDPV1_ADD(dsdpv1_master_add_slave);
  DSDPV1_ADD(dsdpv1_master_start);
  DSDPV1_ADD(dsdpv1_master_stop);
  DSDPV1_ADD(dsdpv1_master_set_baud);
  DSDPV1_ADD(dsdpv1_master_set_clear);
  DSDPV1_ADD(dsdpv1_master_release);
  DSDPV1_ADD(dsdpv1_master_activate);
  DSDPV1_ADD(dsdpv1_master_set_outputs);
  DSDPV1_ADD(dsdpv1_master_get_inputs);
  DSDPV1_ADD(dsdpv1_master_slave_state);
  DSDPV1_ADD(dsdpv1_master_exchanges);
  DSDPV1_ADD(dsdpv1_master_ask);
  DSDPV1_ADD(dsdpv1_master_request);
  DSDPV1_ADD(dsdpv1_master_global_control);
  DSDPV1_ADD(dsdpv1_master_set_slave_address);
  DSDPV1_ADD(dsdpv1_master_read);
  DSDPV1_ADD(dsdpv1_master_write);
  DSDPV1_ADD(dsdpv1_master_transport);
  DSDPV1_ADD(dsdpv1_master_done);
  DSDPV1_ADD(dsdpv1_master_add_connection);
  DSDPV1_ADD(dsdpv1_master_connect);
  DSDPV1_ADD(dsdpv1_master_abort);
  DSDPV1_ADD(dsdpv1_master_connection_state);
}

}  // namespace

/// The symbol that a simulator looks for in a VPI module.
extern "C" {
__attribute__((visibility("default"))) void (*vlog_startup_routines[])() = {add_all, nullptr};
}
