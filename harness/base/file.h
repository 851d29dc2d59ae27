// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ml {

// The bytes of a file. Throws UsageError when it is missing, not a regular file, unreadable, or larger than
// `limit` bytes.
std::vector<std::byte> read_file(const std::filesystem::path& path, size_t limit = size_t{2} << 30);
std::string read_text_file(const std::filesystem::path& path, size_t limit = size_t{64} << 20);

// Writes to a temporary file beside `path`, flushes it to the disk, and renames it: a reader sees the old
// file or the new one, never a part. Throws SystemError (directory not writable, disk full) and leaves no
// temporary file behind.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

// Makes the directory and its parents, and checks that files can be made in it. Throws SystemError.
void make_output_directory(const std::filesystem::path& path);

}  // namespace ml
