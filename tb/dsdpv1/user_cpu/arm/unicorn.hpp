#pragma once
// Unicorn's functions, loaded when the first of them is wanted: linked, its 37 000 symbols would cost every start of a
// program some 10 ms, also of those that have no ARM board.
#include <unicorn/unicorn.h>

#include <string>

namespace arm {

struct Unicorn {
  /// Throws std::runtime_error with what is missing: there is no such library, or a function in it.
  explicit Unicorn(const std::string& library);

  decltype(&uc_open) open = nullptr;
  decltype(&uc_close) close = nullptr;
  decltype(&uc_ctl) ctl = nullptr;
  decltype(&uc_strerror) strerror = nullptr;
  decltype(&uc_hook_add) hook_add = nullptr;
  decltype(&uc_hook_del) hook_del = nullptr;
  decltype(&uc_mem_map_ptr) mem_map_ptr = nullptr;
  decltype(&uc_mmio_map) mmio_map = nullptr;
  decltype(&uc_reg_read) reg_read = nullptr;
  decltype(&uc_reg_write) reg_write = nullptr;
  decltype(&uc_emu_start) emu_start = nullptr;
  decltype(&uc_emu_stop) emu_stop = nullptr;
};

/// That of the version whose header this program was compiled with; it stays loaded.
const Unicorn& unicorn();

}  // namespace arm
