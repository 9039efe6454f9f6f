#pragma once
// Tells contents apart: FNV-1a, 64 bits, no protection against intent.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace tb::sweep {

std::string fingerprint(const std::string& text);
/// Of a file's content; nullopt when there is no such file, it is a folder or may not be read. Throws InputError when
/// it is no regular file (every run of a sweep reads it again), and when the machine refuses to read it now.
std::optional<std::string> fingerprint_of_file(const std::string& path);

/// The whole content, empty when it cannot be read.
std::string content(const std::string& path);
/// One line without a line end. What is not UTF-8 (a file name may be so) is replaced.
std::string text_of(const nlohmann::ordered_json& json);
/// As it comes back from a file.
nlohmann::ordered_json as_kept(const nlohmann::ordered_json& json);

}  // namespace tb::sweep
