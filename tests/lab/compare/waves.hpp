#pragma once
// Made-up waves in a folder of one test.
#include <filesystem>
#include <fstream>
#include <string>

#include "lab/compare/comparison.hpp"
#include "tests/app/folder.hpp"

namespace dsdpv1::compare_test {

/// A VCD with the scope `t` and in it `declarations` ("wire 1 ! a", one a line); changes as they are.
inline std::string vcd(const std::string& declarations, const std::string& changes,
                       const std::string& timescale = "1 ns") {
  std::string text = "$timescale " + timescale + " $end\n$scope module t $end\n";
  std::size_t begin = 0;
  for (std::size_t end = 0; begin < declarations.size(); begin = end + 1) {
    end = std::min(declarations.find('\n', begin), declarations.size());
    text += "$var " + declarations.substr(begin, end - begin) + " $end\n";
  }
  return text + "$upscope $end\n$enddefinitions $end\n" + changes;
}

class Waves {
 public:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
    return folder_.file(name);
  }
  std::string path(const std::string& name) const { return folder_.file(name); }
  const std::filesystem::path& folder() const { return folder_.path(); }
  tb::compare::Result compare(const std::string& a, const std::string& b,
                              const tb::compare::Options& options = {}) const {
    return tb::compare::Comparison(write("a.vcd", a), write("b.vcd", b), options).run();
  }

 private:
  app_test::Folder folder_;
};

/// "a@15: 0 1", the first difference of all, or "equal".
inline std::string first(const tb::compare::Result& result) {
  if (!result.first) return "equal";
  const tb::compare::SignalResult& signal = result.signals[*result.first];
  return signal.name + "@" + std::to_string(signal.first->at) + ": " + signal.first->a + " " + signal.first->b;
}

}  // namespace dsdpv1::compare_test
