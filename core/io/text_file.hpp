#pragma once
#include <functional>
#include <string>

namespace bulbus::inline io {

/// Does a file that is written bit by bit begin anew, or go on behind what it holds?
enum class FileStart { anew, continued };

/// The bytes of a file; empty if it cannot be read. Not collective.
std::string content_of(const std::string& path);

/// Writes a whole file under a temporary name and renames it: a reader sees the old file or the new one,
/// never a part. Throws std::runtime_error. Not collective.
void write_whole(const std::string& path, const std::string& text);

/// The same where `write` makes the file of the temporary name. Throws std::runtime_error.
void write_whole(const std::string& path, const std::function<void(const std::string&)>& write);

/// The second half of the same, for files that a library writes, once their content is on the disk: the name
/// outlives a power cut only with what it names. Throws std::runtime_error.
void settle(const std::string& temporary, const std::string& path);

}  // namespace bulbus::inline io
