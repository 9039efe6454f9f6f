#pragma once
#include <string>

#include "tb/regress/tables.hpp"

namespace tb::regress {

/// index.html: one page that needs nothing but the files beside it. A click on a heading sorts, a word filters.
std::string page(const Report& report);

}  // namespace tb::regress
