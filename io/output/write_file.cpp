#include "io/output/write_file.hpp"

#include "io/output/output_file.hpp"

namespace dsdpv1::tb {

void write_file(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace dsdpv1::tb
