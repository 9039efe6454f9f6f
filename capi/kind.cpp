#include "capi/kind.hpp"

#include "capi/error.hpp"

namespace dsdpv1::capi {

const std::vector<const Kind*>& kinds() {
  static const std::vector<const Kind*> all = {&dsdpv1_kind(), &dsdpv1_r_kind(), &dsdpv1_rsu_kind()};
  return all;
}

const Kind* find_kind(const char* name) {
  if (name == nullptr || *name == '\0') return kinds().front();
  for (const Kind* kind : kinds())
    if (name == std::string(kind->maker().name())) return kind;
  return nullptr;
}

const Kind& kind_of(const char* name) {
  if (const Kind* kind = find_kind(name)) return *kind;
  std::string allowed;
  for (const Kind* kind : kinds()) allowed += (allowed.empty() ? "" : ", ") + std::string(kind->maker().name());
  fail(DPSIM_ERR_NOT_FOUND, "kind is \"" + std::string(name) + "\", allowed are " + allowed);
}

}  // namespace dsdpv1::capi
