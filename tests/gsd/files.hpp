#pragma once
// Files of this folder, read as the tests need them.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/gsd/gsd.hpp"

namespace dsdpv1::gsd_test {

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

inline bus::GsdResult parse(const std::string& text, const std::string& name = "test.gsd") {
  std::istringstream in(text);
  return bus::parse_gsd(in, name);
}

/// A sample by its name without ".gsd"; throws when it has errors.
inline bus::Gsd sample(const std::string& name) {
  const bus::GsdResult result = parse(content(std::filesystem::path(GSD_SAMPLES) / (name + ".gsd")), name + ".gsd");
  for (const auto& diagnostic : result.diagnostics)
    if (!result.gsd) throw std::runtime_error(to_string(diagnostic));
  return result.gsd.value();
}

/// All .gsd files of a folder, in the order of their names.
inline std::vector<std::filesystem::path> files_of(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".gsd") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

inline std::vector<std::string> lines(const bus::GsdResult& result) {
  std::vector<std::string> list;
  for (const auto& diagnostic : result.diagnostics) list.push_back(to_string(diagnostic));
  return list;
}

/// A small valid file with `body` after its first seven lines.
inline std::string file_with(const std::string& body) {
  return "#Profibus_DP\nGSD_Revision = 3\nVendor_Name = \"V\"\nModel_Name = \"M\"\nIdent_Number = 0x1234\n"
         "12M_supp = 1\nMaxTsdr_12M = 800\n" +
         body;
}

}  // namespace dsdpv1::gsd_test
