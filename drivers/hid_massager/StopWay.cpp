#include "drivers/hid_massager/StopWay.h"

#include <fmt/format.h>
#include <string_view>

#include "core/base/LocaleFreeText.h"

namespace tacto::hid {

namespace {

constexpr std::size_t kMaxBytes = 4096;
constexpr std::size_t kSetupBytes = 8;

std::string hex(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

std::optional<std::vector<std::uint8_t>> bytesOf(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    if (text.empty() || text.size() % 2 != 0 || text.size() > 2 * kMaxBytes) return std::nullopt;
    for (std::size_t i = 0; i < text.size(); i += 2) {
        const auto byte = parseWhole<std::uint8_t>(text.substr(i, 2), 16);
        if (!byte) return std::nullopt;
        bytes.push_back(*byte);
    }
    return bytes;
}

}  // namespace

std::vector<std::string> StopWay::arguments() const {
    return {kind == Kind::Hidraw ? "hidraw" : "usb", node, hex(bytes)};
}

std::optional<StopWay> StopWay::read(int count, char** arguments) {
    if (count != 3) return std::nullopt;
    const std::string_view kind = arguments[0];
    auto bytes = bytesOf(arguments[2]);
    if ((kind != "hidraw" && kind != "usb") || !bytes) return std::nullopt;
    if (kind == "usb" && bytes->size() != kSetupBytes) return std::nullopt;
    return StopWay{kind == "usb" ? Kind::Usb : Kind::Hidraw, arguments[1], std::move(*bytes)};
}

}  // namespace tacto::hid
