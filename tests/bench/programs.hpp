#pragma once
// Shared by the programs of the speed table: `PROGRAM ROW...` prints ROW<TAB>VALUE, one line per row.
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace dsdpv1::speed {

struct Row {
  std::string name;
  std::function<double()> measure;
};

inline const Row* find(const std::vector<Row>& rows, const char* name) {
  for (const Row& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

inline int wrong(const char* program, const std::vector<Row>& rows, const char* name) {
  std::string allowed;
  for (const Row& row : rows) allowed += " " + row.name;
  std::fprintf(stderr, "%s: unknown row %s, expected%s\n", program, name, allowed.c_str());
  return 2;
}

/// Exit code: 0, 1 if something could not be measured, 2 for an unknown row.
inline int run_rows(int argc, char** argv, const std::vector<Row>& rows) {
  for (int i = 1; i < argc; ++i)
    if (find(rows, argv[i]) == nullptr) return wrong(argv[0], rows, argv[i]);
  try {
    for (int i = 1; i < argc; ++i) {
      std::printf("%s\t%.6g\n", argv[i], find(rows, argv[i])->measure());
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return argc > 1 ? 0 : wrong(argv[0], rows, "(none)");
}

}  // namespace dsdpv1::speed
