#include "bus/capture/zip_archive.hpp"

#include <unzip.h>

#include <array>
#include <cstdio>

#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr int kWithCase = 1;

/// minizip's file access, redirected to bytes in memory.
voidpf open_bytes(voidpf bytes, const void* /*name*/, int /*mode*/) {
  auto& text = *static_cast<std::string*>(bytes);
  return fmemopen(text.data(), text.size(), "rb");  // read only
}

void check(bool good) {
  if (!good) throw CaptureError("a member of the archive is damaged, expected a session of sigrok");
}

}  // namespace

void ZipArchive::Close::operator()(void* file) const { unzClose(file); }

ZipArchive::ZipArchive(const std::string& bytes) {
  zlib_filefunc64_def calls;
  fill_fopen64_filefunc(&calls);
  calls.zopen64_file = open_bytes;
  calls.opaque = const_cast<std::string*>(&bytes);  // NOLINT(cppcoreguidelines-pro-type-const-cast): C, only reads
  file_.reset(unzOpen2_64("", &calls));
  if (!file_) throw CaptureError("is no whole ZIP archive, expected a session of sigrok");
}

bool ZipArchive::read(const std::string& member, const TakeBytes& take) {
  if (unzLocateFile(file_.get(), member.c_str(), kWithCase) != UNZ_OK) return false;
  unz_file_info64 info{};
  check(unzGetCurrentFileInfo64(file_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) == UNZ_OK);
  check(unzOpenCurrentFile(file_.get()) == UNZ_OK);
  std::array<char, 16'384> piece{};
  int size = 0;
  while ((size = unzReadCurrentFile(file_.get(), piece.data(), piece.size())) > 0)
    take(piece.data(), static_cast<std::size_t>(size));
  const bool whole = size == 0 && unztell64(file_.get()) == info.uncompressed_size;
  check(unzCloseCurrentFile(file_.get()) == UNZ_OK && whole);  // verifies the CRC
  return true;
}

}  // namespace dsdpv1::bus::capture
