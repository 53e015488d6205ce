#include "core/base/Printable.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>

namespace tacto {

namespace {

struct Character {
    char32_t code = 0;
    std::size_t bytes = 0;  // 0: not UTF-8
};

/// Returns the first character of `text`; accepts only shortest forms.
Character firstOf(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xf0 && lead < 0xf5   ? 4
                              : lead >= 0xe0 && lead < 0xf0 ? 3
                              : lead >= 0xc2 && lead < 0xe0 ? 2
                                                            : 0;
    if (bytes == 0 || text.size() < bytes) return {};
    char32_t code = lead & (0xffU >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        code = code << 6 | (byte(i) & 0x3fU);
    }
    constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool isSurrogate = code >= 0xd800 && code < 0xe000;
    if (code < kSmallest[bytes] || code > 0x10ffff || isSurrogate) return {};
    return {code, bytes};
}

}  // namespace

bool isControl(char32_t code) noexcept { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

bool isHidden(char32_t code) noexcept {
    return code == 0x61c || (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2060 && code <= 0x206f) || code == 0xfeff || (code >= 0xfff9 && code <= 0xfffb) ||
           (code >= 0xe0000 && code <= 0xe007f);
}

std::string printable(std::string_view text, Newlines newlines) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const auto [code, bytes] = firstOf(text);
        if (bytes == 0) {
            fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned char>(text.front()));
            text.remove_prefix(1);
            continue;
        }
        if (isControl(code) && !(code == '\n' && newlines == Newlines::Keep))
            fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned>(code));
        else if (isHidden(code))
            fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(code));
        else
            out.append(text.substr(0, bytes));
        text.remove_prefix(bytes);
    }
    return out;
}

bool isUtf8(std::string_view text) noexcept {
    while (!text.empty()) {
        const auto bytes = firstOf(text).bytes;
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}

std::size_t charactersOf(std::string_view utf8) noexcept {
    return static_cast<std::size_t>(
        std::count_if(utf8.begin(), utf8.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

std::string withoutNumbers(std::string_view text) {
    std::string out;
    bool inNumber = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto isDigit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
        const auto isAny = [&](std::size_t at, std::string_view of) {
            return at < text.size() && of.find(text[at]) != std::string_view::npos;
        };
        const bool goesOn =
            inNumber && ((isAny(i, ".,") && isDigit(i + 1)) ||
                         (isAny(i, "eE") && (isDigit(i + 1) || (isAny(i + 1, "+-") && isDigit(i + 2)))) ||
                         (isAny(i, "+-") && isAny(i - 1, "eE") && isDigit(i + 1)));
        if (isDigit(i) || goesOn) {
            if (!inNumber) out += "…";
            inNumber = true;
            continue;
        }
        inNumber = false;
        out += text[i];
    }
    return out;
}

}  // namespace tacto
