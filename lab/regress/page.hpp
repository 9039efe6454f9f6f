#pragma once
#include <string>

#include "lab/regress/tables.hpp"

namespace dsdpv1::tb::regress {

/// index.html: one page that needs only the files beside it. A click on a heading sorts, a word filters.
std::string page(const Report& report);

}  // namespace dsdpv1::tb::regress
