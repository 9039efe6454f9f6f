#include "io/input/suggest.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dsdpv1::tb {
namespace {

/// Insertions, deletions, replacements and exchanges of neighbours that turn `a` into `b`; no letter changes twice.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& wrong, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = wrong.size() / 2 + 1;  // a typing error changes at most half of the word
  for (const std::string& word : known) {
    const std::size_t d = distance(wrong, word);
    if (d < least) {
      least = d;
      best = word;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& wrong, const std::vector<std::string>& known) {
  const std::string word = nearest(wrong, known);
  return word.empty() ? "" : " (did you mean " + word + "?)";
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace dsdpv1::tb
