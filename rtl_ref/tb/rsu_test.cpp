// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Test of DSDPV1-RSU's serial ports alone, under Verilator: the statements of docs/microarchitecture_rsu.md about pins,
// cells and cycles. With `faults FILE` it switches each fault of dsdpv1_rsu/faults.txt on and plays the group that the
// file names for it, which has to fail.
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "rsu_bench.hpp"
#include "verilated.h"

namespace rtl {
namespace {

const std::map<std::string, void (*)(unsigned)> kGroups = {
    {"spi", rsu_spi}, {"owner", rsu_owner}, {"uart", rsu_uart}, {"exchange", rsu_exchange}};

int play_faults(const char* name) {
  std::ifstream file(name);
  std::string line;
  int planted = 0, found = 0;
  looks_for_fault = true;
  while (std::getline(file, line)) {
    unsigned number = 0;
    std::string block, group;
    if (!(std::istringstream(line) >> number >> block >> group)) continue;
    if (kGroups.count(group) == 0) continue;  // only lockstep finds it
    ++planted;
    try {
      kGroups.at(group)(number);
      std::printf("not found: %s\n", line.c_str());
    } catch (const Failure&) {
      ++found;
    }
  }
  std::printf("%d of %d faults found\n", found, planted);
  return planted != 0 && found == planted ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int test(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "faults") return play_faults(argv[2]);
  if (argc > 2 || (argc == 2 && kGroups.count(argv[1]) == 0)) {
    std::fprintf(stderr, "rsu_test: expected nothing, spi, owner, uart, exchange, or: faults FILE\n");
    return 2;
  }
  for (const auto& [name, play] : kGroups) {
    if (argc == 2 && name != argv[1]) continue;
    const int before = failures;
    play(0);
    std::printf("%s: %d failures\n", name.c_str(), failures - before);
  }
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace rtl

int main(int argc, char** argv) {
  Verilated::commandArgs(argc, argv);
  return rtl::test(argc, argv);
}
