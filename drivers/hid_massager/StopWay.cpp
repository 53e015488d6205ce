#include "drivers/hid_massager/StopWay.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace tacto::hid {

namespace {

constexpr std::size_t kMaxBytes = 4096;
constexpr std::string_view kNone = "-";

template <class Bytes>
std::string hex(const Bytes& bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    if (bytes.empty()) return std::string(kNone);
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

std::optional<std::uint8_t> byteOf(std::string_view text) {
    std::uint8_t value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.empty() || read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::vector<std::uint8_t>> bytesOf(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    if (text == kNone) return bytes;
    if (text.empty() || text.size() % 2 != 0 || text.size() > 2 * kMaxBytes) return std::nullopt;
    for (std::size_t i = 0; i < text.size(); i += 2) {
        const auto byte = byteOf(text.substr(i, 2));
        if (!byte) return std::nullopt;
        bytes.push_back(*byte);
    }
    return bytes;
}

}  // namespace

bool StopWay::needsClaim() const noexcept {
    constexpr std::uint8_t kTypeMask = 0x60;
    constexpr std::uint8_t kVendor = 0x40;
    constexpr std::uint8_t kRecipientMask = 0x1F;
    constexpr std::uint8_t kInterface = 1;
    if (kind != Kind::Usb) return false;
    if (endpoint != 0) return true;
    return (setup[0] & kTypeMask) != kVendor && (setup[0] & kRecipientMask) == kInterface;
}

std::vector<std::string> StopWay::arguments() const {
    if (kind == Kind::Hidraw) return {"hidraw", node, hex(bytes)};
    return {"usb",
            node,
            hex(std::array{interface}),
            hex(std::array{endpoint}),
            endpoint == 0 ? hex(setup) : std::string(kNone),
            hex(bytes)};
}

std::optional<StopWay> StopWay::read(int count, char** arguments) {
    const auto text = [&](int i) { return std::string_view(arguments[i]); };
    StopWay way;
    if (count == 3 && text(0) == "hidraw") {
        const auto bytes = bytesOf(text(2));
        if (!bytes || bytes->empty()) return std::nullopt;
        way.node = text(1);
        way.bytes = *bytes;
        return way;
    }
    if (count != 6 || text(0) != "usb") return std::nullopt;
    const auto interface = byteOf(text(2));
    const auto endpoint = byteOf(text(3));
    const auto setup = bytesOf(text(4));
    auto bytes = bytesOf(text(5));
    if (!interface || !endpoint || !setup || !bytes) return std::nullopt;
    if (*endpoint == 0 ? setup->size() != way.setup.size() : !setup->empty() || bytes->empty()) return std::nullopt;
    way.kind = Kind::Usb;
    way.node = text(1);
    way.interface = *interface;
    way.endpoint = *endpoint;
    std::ranges::copy(*setup, way.setup.begin());
    way.bytes = std::move(*bytes);
    return way;
}

}  // namespace tacto::hid
