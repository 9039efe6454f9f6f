#pragma once
// fstapi's reader, closed at the end. Only for code that survives its crash: see ChildStream.
#include <fstapi.h>

#include <memory>
#include <string>

namespace dsdpv1::tb {

struct CloseFst {
  void operator()(void* reader) const { fstReaderClose(reader); }
};
using FstHandle = std::unique_ptr<void, CloseFst>;

inline FstHandle open_fst(const std::string& path) { return FstHandle(fstReaderOpen(path.c_str())); }

}  // namespace dsdpv1::tb
