#include "drivers/sigrok/SrLayout.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "drivers/sigrok/ZipDirectory.h"

namespace tacto::sigrok_driver {

namespace {

constexpr std::size_t kMaxText = 1'000'000;
constexpr std::uint64_t kMaxChannels = 1024;

using Values = std::map<std::string, std::string, std::less<>>;

std::string_view trimmed(std::string_view text) {
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

/// The device's section; nothing where there is none or more than one.
std::optional<Values> deviceOf(std::string_view metadata) {
    Values values;
    int devices = 0;
    bool inDevice = false;
    while (!metadata.empty()) {
        const std::size_t end = metadata.find('\n');
        const auto line = trimmed(metadata.substr(0, end));
        metadata.remove_prefix(end == std::string_view::npos ? metadata.size() : end + 1);
        if (line.starts_with('[')) {
            inDevice = line.starts_with("[device ");
            if (inDevice) ++devices;
        } else if (const std::size_t equals = line.find('='); inDevice && equals != std::string_view::npos) {
            values[std::string(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
        }
    }
    return devices == 1 ? std::optional(std::move(values)) : std::nullopt;
}

/// A whole number; `otherwise` where it is not there, nothing where it is not one or above `most`.
std::optional<std::uint64_t> numberIn(const Values& values, std::string_view key, std::uint64_t otherwise,
                                      std::uint64_t most) {
    const auto found = values.find(key);
    if (found == values.end()) return otherwise;
    std::uint64_t number = 0;
    const char* const end = found->second.data() + found->second.size();
    const auto read = std::from_chars(found->second.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || number > most) return std::nullopt;
    return number;
}

/// Whether libsigrok understands `text` as the frequency that a reader would: "1 MHz", "2.5 kHz", "44100".
bool isFrequency(std::string_view text) {
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || !(value >= 0 && value <= 1e18) || std::signbit(value)) return false;
    auto unit = trimmed(std::string_view(read.ptr, text.data() + text.size()));
    if (!unit.empty() && std::string_view("kKmMgGtT").find(unit.front()) != std::string_view::npos) {
        unit.remove_prefix(1);
    }
    return unit.empty() || unit == "Hz" || unit == "hz" || unit == "HZ";
}

class Reader {
public:
    Reader(std::string name, const std::vector<ZipEntry>& entries) : name_(std::move(name)) {
        for (const auto& entry : entries) entries_.emplace(entry.name, &entry);
    }

    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> broken(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}: {}", name_, fmt::format(text, std::forward<Args>(args)...));
    }
    [[nodiscard]] const ZipEntry* entry(std::string_view name) const {
        const auto found = entries_.find(name);
        return found == entries_.end() ? nullptr : found->second;
    }
    /// All in one entry of this name, or in several, numbered from 1.
    [[nodiscard]] std::vector<SrPiece> piecesOf(const std::string& base) const {
        if (const auto* whole = entry(base)) return {{whole->size, whole->crc}};
        std::vector<SrPiece> pieces;
        while (const auto* piece = entry(fmt::format("{}-{}", base, pieces.size() + 1))) {
            pieces.push_back({piece->size, piece->crc});
        }
        return pieces;
    }

private:
    const std::string name_;
    std::map<std::string, const ZipEntry*, std::less<>> entries_;
};

Result<SrLayout> layoutFrom(const Reader& reader, const Values& device) {
    SrLayout layout;
    const auto probes = numberIn(device, "total probes", 0, kMaxChannels);
    const auto analog = numberIn(device, "total analog", 0, kMaxChannels);
    const auto unit = numberIn(device, "unitsize", 0, kMaxChannels);
    if (!probes || !analog || !unit || *probes + *analog == 0) {
        return reader.broken("its metadata has no sensible number of channels; 1 to {} were expected", kMaxChannels);
    }
    for (std::uint64_t i = 0; i < *analog; ++i) {
        layout.analog.push_back(reader.piecesOf(fmt::format("analog-1-{}", *probes + i + 1)));
        if (SrLayout::sum(layout.analog.back()) % sizeof(float) != 0) {
            return reader.broken("analog channel {} has {} bytes; a multiple of 4 was expected", i + 1,
                                 SrLayout::sum(layout.analog.back()));
        }
        // libsigrok reads each piece by itself: a sample may not lie across two.
        for (const auto& piece : layout.analog.back()) {
            if (piece.bytes % sizeof(float) != 0) return reader.broken("analog channel {} ends within a sample", i + 1);
        }
    }
    if (const auto base = device.find("capturefile"); base != device.end() && *probes > 0) {
        if (base->second != "logic-1") return reader.broken("capturefile is {}; logic-1 was expected", base->second);
        layout.logicChannels = static_cast<std::size_t>(*probes);
        layout.logic = reader.piecesOf("logic-1");
        layout.unitSize = static_cast<std::size_t>(*unit);
        if (layout.unitSize * 8 < layout.logicChannels) {
            return reader.broken("unitsize is {}; at least {} were expected for {} logic channels", layout.unitSize,
                                 (layout.logicChannels + 7) / 8, layout.logicChannels);
        }
    }
    if (const auto rate = device.find("samplerate"); rate != device.end()) {
        layout.samplerate = rate->second;
        layout.samplerateIsSensible = isFrequency(layout.samplerate);
    }
    layout.bytes = SrLayout::sum(layout.logic);
    for (const auto& pieces : layout.analog) layout.bytes += SrLayout::sum(pieces);
    if (layout.bytes == 0) return reader.broken("it holds no samples");
    return layout;
}

}  // namespace

std::uint64_t SrLayout::sum(const std::vector<SrPiece>& pieces) noexcept {
    std::uint64_t bytes = 0;
    for (const auto& piece : pieces) bytes += piece.bytes;
    return bytes;
}

Result<SrLayout> readSrLayout(const std::filesystem::path& path) {
    auto file = ByteFile::open(path);
    if (!file) return failure(file);
    const auto entries = zipDirectory(*file);
    if (!entries) return failure(entries);
    const Reader reader(file->name(), *entries);
    const auto* const version = reader.entry("version");
    const auto* const metadata = reader.entry("metadata");
    if (version == nullptr || metadata == nullptr) {
        return reader.broken("this archive has no version and metadata; a sigrok session was expected");
    }
    const auto number = unpack(*file, *version, 100);
    if (!number) return failure(number);
    if (trimmed(*number) != "2") return reader.broken("version {} of .sr; 2 was expected", trimmed(*number));
    const auto text = unpack(*file, *metadata, kMaxText);
    if (!text) return failure(text);
    const auto device = deviceOf(*text);
    if (!device) return reader.broken("its metadata does not describe one device");
    return layoutFrom(reader, *device);
}

}  // namespace tacto::sigrok_driver
