#pragma once
// Identifier bytes of Chk_Cfg: the compact and the special format of tables A.3 to A.5 (APC3 manual; EN 50170).
#include <cstddef>
#include <string>
#include <vector>

#include "bus/bytes.hpp"

namespace dsdpv1::bus {

/// One direction of an identifier.
struct CfgDirection {
  int count = 0;       ///< bytes or words, 1..64; 0 = no data in this direction
  bool words = false;  ///< two bytes per unit
  bool whole = false;  ///< consistent over the whole module, else over one unit
  int bytes() const { return words ? 2 * count : count; }
};

struct CfgIdentifier {
  std::size_t position = 0;  ///< of its first byte
  std::size_t size = 1;      ///< bytes: the head, its length bytes and the vendor's bytes
  bool special = false;
  CfgDirection input, output;  ///< as seen by the master: input is sent by the slave
  Bytes vendor;                ///< manufacturer specific bytes
  bool empty() const { return input.count == 0 && output.count == 0; }
};

struct CfgLengths {
  int input = 0, output = 0;  ///< bytes, sum over all identifiers read
  std::vector<CfgIdentifier> identifiers;
  std::string error;  ///< empty, or why the bytes are not a complete list of identifiers
  bool ok() const { return error.empty(); }
};

/// Decodes a configuration. An empty one is valid with lengths 0. A special identifier whose vendor length is 15 has no
/// vendor bytes after it (EN 50170).
CfgLengths cfg_lengths(const Bytes& cfg);

/// An identifier as text: "input 4 bytes, consistent as a whole", "empty slot".
std::string describe(const CfgIdentifier& identifier);

}  // namespace dsdpv1::bus
