#include "core/base/Utf16.h"

#include <array>
#include <cstdint>

#include "core/base/Printable.h"

namespace tacto {

namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

void appendCodePoint(std::uint32_t c, std::string& text) {
    std::array<char, 4> bytes{};
    text.append(bytes.data(), encodeUtf8(c, bytes));
}

}  // namespace

std::optional<Utf16Order> utf16OrderOf(std::string_view bytes) noexcept {
    if (bytes.starts_with("\xFF\xFE")) return Utf16Order::Little;
    if (bytes.starts_with("\xFE\xFF")) return Utf16Order::Big;
    return std::nullopt;
}

std::size_t appendAsUtf8(std::string_view bytes, Utf16Order order, std::string& text) {
    const auto unitAt = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(order == Utf16Order::Little ? first | second << 8U : first << 8U | second);
    };
    const auto isHigh = [](std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; };
    const auto isLow = [](std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; };
    std::size_t i = 0;
    while (i + 1 < bytes.size()) {
        const auto unit = unitAt(i);
        if (!isHigh(unit)) {
            appendCodePoint(isLow(unit) ? kReplacement : unit, text);
            i += 2;
            continue;
        }
        if (i + 3 >= bytes.size()) break;
        const auto next = unitAt(i + 2);
        if (isLow(next)) {
            appendCodePoint(0x10000 + ((unit - 0xD800) << 10U) + (next - 0xDC00), text);
            i += 4;
        } else {
            appendCodePoint(kReplacement, text);
            i += 2;
        }
    }
    return i;
}

std::string asUtf8(std::string_view bytes) {
    const auto order = utf16OrderOf(bytes);
    if (!order) return std::string(bytes);
    std::string text;
    (void)appendAsUtf8(bytes.substr(2), *order, text);  // half a character at the end may be lost
    return text;
}

std::string latin1AsUtf8(std::string_view text) {
    if (isUtf8(text)) return std::string(text);
    std::string result;
    for (const char c : text) appendCodePoint(static_cast<unsigned char>(c), result);
    return result;
}

}  // namespace tacto
