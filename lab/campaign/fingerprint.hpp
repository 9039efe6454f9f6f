#pragma once
// Fingerprints of contents (FNV-1a, 64 bits; not a protection against intent), and reading and writing them.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace dsdpv1::tb::campaign {

std::string fingerprint(const std::string& text);
/// "0.1.0 1f0c...": the version and a fingerprint of the program, so that a rebuilt program counts as another one.
std::string program_identity(const std::string& version);
/// A file's fingerprint; nullopt when it is missing, a folder or not readable. Throws InputError when
/// it is not a regular file (every run reads it again), and when it cannot be read now.
std::optional<std::string> fingerprint_of_file(const std::string& path);

/// The last line that is not empty.
std::string last_line(const std::string& text);
/// The whole content, empty when it cannot be read.
std::string content(const std::string& path);
/// Its JSON; discarded when it has none.
nlohmann::ordered_json read_json(const std::string& path);
/// One line without a line end. Invalid UTF-8 (possible in file names) is replaced.
std::string text_of(const nlohmann::ordered_json& json);
/// The value as read back from a file.
nlohmann::ordered_json as_kept(const nlohmann::ordered_json& json);

}  // namespace dsdpv1::tb::campaign
