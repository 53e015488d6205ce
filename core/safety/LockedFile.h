// LockedFile.h - a file of fixed size that one process at a time maps into memory, for data that must survive the
// process, however it ends.
//
// Thread-safety: none; one owner. A write into the mapping needs no system call.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <tl/expected.hpp>
#include <type_traits>

namespace tacto {

class LockedFile {
public:
    enum class Refusal { Held, NotItsOwn, Failed };
    struct Refused {
        Refusal why;
        int error = 0;  ///< errno of Failed
    };

    /// Opens `path`, or makes it with `mode` and all bits 0, and locks it. Refuses a link, a pipe and a file with a
    /// second name, because these serve another purpose.
    [[nodiscard]] static tl::expected<LockedFile, Refused> open(const std::filesystem::path& path, std::size_t size,
                                                                ::mode_t mode);
    ~LockedFile();
    LockedFile(LockedFile&& other) noexcept;
    LockedFile& operator=(LockedFile&&) = delete;

    [[nodiscard]] void* content() const noexcept { return content_; }
    [[nodiscard]] bool made() const noexcept { return made_; }    ///< true if this open() made the file
    [[nodiscard]] bool whole() const noexcept { return whole_; }  ///< false: the file existed with another size

private:
    LockedFile(int file, void* content, std::size_t size, bool made, bool whole)
        : file_(file), content_(content), size_(size), made_(made), whole_(whole) {}

    int file_;
    void* content_;
    std::size_t size_;
    bool made_;
    bool whole_;
};

/// FNV-1a over the given bytes. Detects a torn or damaged file, not a forged one.
[[nodiscard]] std::uint64_t checksumOf(const void* data, std::size_t size) noexcept;

/// Returns "tactoscope-cli (process 4711)".
[[nodiscard]] std::string programOf(std::int64_t process);

/// A part of such a file: its content and a checksum, which is set to 0 before the content changes.
template <class Content>
struct Checked {
    Content content{};
    std::uint64_t sum = 0;
    static_assert(std::is_trivially_copyable_v<Content>);

    [[nodiscard]] bool sound() const noexcept { return sum == checksumOf(&content, sizeof content); }
    void write(const Content& newer) noexcept {
        std::atomic_ref(sum).store(0, std::memory_order_relaxed);
        std::atomic_signal_fence(std::memory_order_seq_cst);  // because the process may end between any two stores
        content = newer;
        std::atomic_signal_fence(std::memory_order_seq_cst);
        std::atomic_ref(sum).store(checksumOf(&content, sizeof content), std::memory_order_relaxed);
    }
};

}  // namespace tacto
