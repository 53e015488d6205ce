// ByteFile.h - a file read piece by piece. Not mapped into memory: a stick that is pulled out, or a file cut short by
// someone else, is an error here and not a signal that ends the program.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class ByteFile {
public:
    /// Errors: NotFound when it is not there, Io when it cannot be read or is not a plain file.
    [[nodiscard]] static Result<ByteFile> open(const std::filesystem::path& path);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// The next up to `count` bytes into `into`; fewer only at the end. Errors: Io.
    [[nodiscard]] Result<std::size_t> read(char* into, std::size_t count);
    /// Errors: Io.
    [[nodiscard]] Result<void> seek(std::uint64_t position);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    ByteFile(std::unique_ptr<std::FILE, Close> file, std::string name, std::uint64_t size);

    std::unique_ptr<std::FILE, Close> file_;
    std::string name_;
    std::uint64_t size_;
};

/// The file's first kHeadBytes (CaptureFormat.h). Errors: as ByteFile.
[[nodiscard]] Result<std::string> readHead(const std::filesystem::path& path);

}  // namespace tacto
