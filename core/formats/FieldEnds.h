// FieldEnds.h - where the fields of a table end, found sixteen characters at a time and before anything is read.
//
// Thread-safety: none; one owner.
#pragma once

#include <array>
#include <cstdint>

namespace tacto {

class FieldEnds {
public:
    explicit FieldEnds(char separator) noexcept : separator_(separator) {}

    /// Looks at the text from `begin`, up to kLooked characters but not beyond `end`; 64 behind `end` may be read.
    void look(const char* begin, const char* end) noexcept;

    /// How many separators and ends of lines there are.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// The place of the `index`-th, counted from the `begin` that was looked from.
    [[nodiscard]] std::uint32_t operator[](std::size_t index) const noexcept { return ends_[index]; }

private:
    static constexpr std::size_t kLooked = 16 * 1024;
    static constexpr std::size_t kAtOnce = 64;
    char separator_;
    std::size_t count_ = 0;
    std::array<std::uint32_t, kLooked + kAtOnce> ends_{};
};

}  // namespace tacto
