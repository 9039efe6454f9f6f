#include "tb/report/html/page.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "bus/printable.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/html/page_data.hpp"
#include "tb/report/markup.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1::tb::html {

// The files of this folder, made by cmake/embed.cmake.
extern const std::string_view kPageHtml, kPageCss, kD3, kD3Licence;
extern const std::string_view kScriptNumbers, kScriptPicture, kScriptTelegrams, kScriptHistogram, kScriptMargins,
    kScriptTiming, kScriptPage;

namespace {

std::string escaped(const std::string& text) { return markup_escaped(bus::printable_lines(text)); }

std::string title_of(const RunResult& result, const std::string& version) {
  return fmt::format("{}: {} (dsdpv1-sim {})", result.scenario, words(result), version);
}

std::string scripts() {
  std::string text;
  for (const std::string_view each :
       {kScriptNumbers, kScriptPicture, kScriptTelegrams, kScriptHistogram, kScriptMargins, kScriptTiming, kScriptPage})
    text += each;
  return text;
}

using Pieces = std::map<std::string, std::string, std::less<>>;

/// Replaces each @NAME@ by its piece; the text of a piece is not searched again.
std::string filled(std::string_view page, const Pieces& pieces) {
  std::string text;
  while (true) {
    const std::size_t begin = page.find('@');
    text += page.substr(0, begin);
    if (begin == std::string_view::npos) return text;
    const std::size_t end = page.find('@', begin + 1);
    text += pieces.at(std::string(page.substr(begin + 1, end - begin - 1)));
    page.remove_prefix(end + 1);
  }
}

}  // namespace

std::string page(const RunResult& result, const RunRecorder& recorder, const std::string& version) {
  return filled(kPageHtml, {{"TITLE", escaped(title_of(result, version))},
                            {"STYLE", std::string(kPageCss)},
                            {"TEXT", escaped(whole_summary(result))},
                            {"DATA", page_data(result, recorder, version)},
                            {"D3_LICENCE", std::string(kD3Licence)},
                            {"D3", std::string(kD3)},
                            {"SCRIPT", scripts()}});
}

}  // namespace dsdpv1::tb::html
