#include "io/input/input_error.hpp"
#include "io/waves/vcd_writer.hpp"
#include "io/waves/wave_writer.hpp"
#ifdef DSDPV1_WITH_FST
#include "io/waves/fst_writer.hpp"
#endif

namespace dsdpv1::tb {
namespace {

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() > ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

void check_wave_name(const std::string& path) {
#ifdef DSDPV1_WITH_FST
  const bool fst = true;
#else
  const bool fst = false;
#endif
  if (ends_with(path, ".vcd") || (fst && ends_with(path, ".fst"))) return;
  if (ends_with(path, ".fst"))
    throw InputError(path, 0, "this program was built without FST (Verilator's fstapi was not found), expected .vcd");
  throw InputError(path, 0, "the ending of a wave file decides its format, expected .vcd or .fst");
}

std::unique_ptr<WaveWriter> open_wave(const std::string& path, const std::string& date) {
  check_wave_name(path);
#ifdef DSDPV1_WITH_FST
  if (ends_with(path, ".fst")) return std::make_unique<FstWriter>(path, date);
#endif
  return std::make_unique<VcdWriter>(path, date);
}

}  // namespace dsdpv1::tb
