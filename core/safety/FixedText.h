// FixedText.h - a short text without heap memory, for rows and reasons made in code that must not allocate.
//
// Longer texts are cut at a whole UTF-8 character. Trivially copyable.
//
// Thread-safety: a value.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tacto {

template <std::size_t N>
class FixedText {
public:
    constexpr FixedText() noexcept = default;
    constexpr FixedText(std::string_view text) noexcept { assign(text); }  // implicit, because it is a text
    constexpr FixedText(const char* text) noexcept { assign(text == nullptr ? std::string_view{} : text); }

    [[nodiscard]] constexpr std::string_view view() const noexcept { return {characters_.data(), size_}; }
    [[nodiscard]] constexpr const char* c_str() const noexcept { return characters_.data(); }
    [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr bool operator==(const FixedText& other) const noexcept { return view() == other.view(); }

private:
    constexpr void assign(std::string_view text) noexcept {
        size_ = text.size() < N ? text.size() : N;
        // A continuation byte is 10xxxxxx: never cut before such a byte.
        while (size_ < text.size() && size_ > 0 && (static_cast<unsigned char>(text[size_]) & 0xC0U) == 0x80U) --size_;
        for (std::size_t i = 0; i < size_; ++i) characters_[i] = text[i];
    }
    std::array<char, N + 1> characters_{};  // always ends with a zero
    std::size_t size_ = 0;
};

}  // namespace tacto
