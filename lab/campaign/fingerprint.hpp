#pragma once
// Tells contents apart (FNV-1a, 64 bits, no protection against intent), and keeps them.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace dsdpv1::tb::campaign {

std::string fingerprint(const std::string& text);
/// "0.1.0 1f0c...": the version and what the program is made of, so that a program built anew counts as another one.
std::string program_identity(const std::string& version);
/// Of a file's content; nullopt when there is no such file, it is a folder or may not be read. Throws InputError when
/// it is no regular file (every run reads it again), and when the machine refuses to read it now.
std::optional<std::string> fingerprint_of_file(const std::string& path);

/// The last line that is not empty.
std::string last_line(const std::string& text);
/// The whole content, empty when it cannot be read.
std::string content(const std::string& path);
/// Its JSON; discarded when it has none.
nlohmann::ordered_json read_json(const std::string& path);
/// One line without a line end. What is not UTF-8 (a file name may be so) is replaced.
std::string text_of(const nlohmann::ordered_json& json);
/// As it comes back from a file.
nlohmann::ordered_json as_kept(const nlohmann::ordered_json& json);

}  // namespace dsdpv1::tb::campaign
