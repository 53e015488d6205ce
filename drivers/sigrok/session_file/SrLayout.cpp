#include "drivers/sigrok/session_file/SrLayout.h"

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <zip.h>

#include "core/base/LocaleFreeText.h"
#include "core/formats/TextBlocks.h"

namespace tacto::sigrok_driver {

namespace {

constexpr std::uint64_t kMaxText = 1'000'000;
constexpr std::uint64_t kMaxChannels = 1024;
constexpr std::uint64_t kMaxRatio = 1032;  // largest factor by which deflate can compress

using Values = std::map<std::string, std::string, std::less<>>;

/// Returns the section of the device; nothing unless there is exactly one.
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

/// Reads a whole number. Returns `otherwise` if the key is missing, nothing if the value is no number or above `most`.
std::optional<std::uint64_t> numberIn(const Values& values, std::string_view key, std::uint64_t otherwise,
                                      std::uint64_t most) {
    const auto found = values.find(key);
    if (found == values.end()) return otherwise;
    const auto number = parseWhole<std::uint64_t>(found->second);
    return number && *number <= most ? number : std::nullopt;
}

/// True if libsigrok reads `text` as the frequency that a person would read: "1 MHz", "2.5 kHz", "44100".
bool isFrequency(std::string_view text) {
    const auto value = takeNumber(text);
    if (!value || !(*value >= 0 && *value <= 1e18) || std::signbit(*value)) return false;
    auto unit = trimmed(text);
    if (!unit.empty() && std::string_view("kKmMgGtT").find(unit.front()) != std::string_view::npos) {
        unit.remove_prefix(1);
    }
    return unit.empty() || unit == "Hz" || unit == "hz" || unit == "HZ";
}

/// The entries of a .sr archive, as the archive's directory lists them.
class Archive {
public:
    /// Errors: ParseError if the file is no archive, or if an entry is neither stored nor deflated or states a larger
    /// size than deflate can produce: a forged size must not use up memory.
    static Result<Archive> open(const ByteFile& file) {
        int error = 0;
        Archive archive(file.name(), Handle(::zip_open(file.name().c_str(), ZIP_RDONLY, &error)));
        const auto count = archive.zip_ ? ::zip_get_num_entries(archive.zip_.get(), 0) : 0;
        if (count <= 0) return archive.incomplete("it has no directory that can be read");
        for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
            zip_stat_t entry;
            if (::zip_stat_index(archive.zip_.get(), i, 0, &entry) != 0) return archive.incomplete("it is damaged");
            const bool packed = entry.comp_method == ZIP_CM_DEFLATE;
            if ((!packed && entry.comp_method != ZIP_CM_STORE) || entry.comp_size > file.size() ||
                entry.size > (packed ? entry.comp_size * kMaxRatio + 64 : entry.comp_size)) {
                return archive.incomplete("its entry {} cannot be unpacked to {} bytes", entry.name, entry.size);
            }
            archive.entries_.emplace(entry.name, entry);
        }
        return archive;
    }

    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> broken(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}: {}", name_, fmt::format(text, std::forward<Args>(args)...));
    }
    [[nodiscard]] bool has(std::string_view name) const { return entries_.contains(name); }
    /// Returns the pieces: one entry with the name `base`, or several entries numbered from 1.
    [[nodiscard]] std::vector<SrPiece> piecesOf(const std::string& base) const {
        std::vector<SrPiece> pieces;
        const auto take = [&](const std::string& name) {
            const auto found = entries_.find(name);
            if (found != entries_.end()) pieces.push_back({found->second.size, found->second.crc});
            return found != entries_.end();
        };
        if (take(base)) return pieces;
        while (take(fmt::format("{}-{}", base, pieces.size() + 1))) {
        }
        return pieces;
    }
    /// Returns the text of an existing entry. Errors: ParseError if it is damaged or larger than `most`.
    [[nodiscard]] Result<std::string> unpack(std::string_view name, std::uint64_t most) const {
        const auto& entry = entries_.find(name)->second;
        if (entry.size > most || entry.comp_size > most) {
            return incomplete("its entry {} has {} bytes, at most {} make sense", name, entry.size, most);
        }
        const std::unique_ptr<zip_file_t, decltype(&::zip_fclose)> file(::zip_fopen_index(zip_.get(), entry.index, 0),
                                                                        &::zip_fclose);
        std::string text(static_cast<std::size_t>(entry.size), '\0');
        char beyond = 0;
        // libzip checks size and checksum only when asked for more bytes than there are.
        if (!file || ::zip_fread(file.get(), text.data(), text.size()) != static_cast<zip_int64_t>(text.size()) ||
            ::zip_fread(file.get(), &beyond, 1) != 0) {
            return incomplete("its entry {} is damaged", name);
        }
        return text;
    }

private:
    struct Discard {
        void operator()(zip_t* zip) const noexcept { ::zip_discard(zip); }
    };
    using Handle = std::unique_ptr<zip_t, Discard>;
    Archive(std::string name, Handle zip) : name_(std::move(name)), zip_(std::move(zip)) {}
    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> incomplete(fmt::format_string<Args...> text, Args&&... args) const {
        return broken("{}; a complete .sr archive was expected", fmt::format(text, std::forward<Args>(args)...));
    }

    std::string name_;
    Handle zip_;
    std::map<std::string, zip_stat_t, std::less<>> entries_;
};

Result<SrLayout> layoutFrom(const Archive& archive, const Values& device) {
    SrLayout layout;
    const auto probes = numberIn(device, "total probes", 0, kMaxChannels);
    const auto analog = numberIn(device, "total analog", 0, kMaxChannels);
    const auto unit = numberIn(device, "unitsize", 0, kMaxChannels);
    if (!probes || !analog || !unit || *probes + *analog == 0) {
        return archive.broken("its metadata has no sensible number of channels; 1 to {} were expected", kMaxChannels);
    }
    for (std::uint64_t i = 0; i < *analog; ++i) {
        layout.analog.push_back(archive.piecesOf(fmt::format("analog-1-{}", *probes + i + 1)));
        if (SrLayout::sum(layout.analog.back()) % sizeof(float) != 0) {
            return archive.broken("analog channel {} has {} bytes; a multiple of 4 was expected", i + 1,
                                  SrLayout::sum(layout.analog.back()));
        }
        // libsigrok reads each piece separately: a sample must not be split between two pieces.
        for (const auto& piece : layout.analog.back()) {
            if (piece.bytes % sizeof(float) != 0)
                return archive.broken("analog channel {} ends within a sample", i + 1);
        }
    }
    if (const auto base = device.find("capturefile"); base != device.end() && *probes > 0) {
        if (base->second != "logic-1") return archive.broken("capturefile is {}; logic-1 was expected", base->second);
        layout.logicChannels = static_cast<std::size_t>(*probes);
        layout.logic = archive.piecesOf("logic-1");
        layout.unitSize = static_cast<std::size_t>(*unit);
        if (layout.unitSize * 8 < layout.logicChannels) {
            return archive.broken("unitsize is {}; at least {} were expected for {} logic channels", layout.unitSize,
                                  (layout.logicChannels + 7) / 8, layout.logicChannels);
        }
    }
    if (const auto rate = device.find("samplerate"); rate != device.end()) {
        layout.samplerate = rate->second;
        layout.samplerateIsSensible = isFrequency(layout.samplerate);
    }
    layout.bytes = SrLayout::sum(layout.logic);
    for (const auto& pieces : layout.analog) layout.bytes += SrLayout::sum(pieces);
    if (layout.bytes == 0) return archive.broken("it holds no samples");
    return layout;
}

}  // namespace

std::uint64_t SrLayout::sum(const std::vector<SrPiece>& pieces) noexcept {
    std::uint64_t bytes = 0;
    for (const auto& piece : pieces) bytes += piece.bytes;
    return bytes;
}

Result<SrLayout> readSrLayout(const std::filesystem::path& path) {
    const auto file = ByteFile::open(path);
    if (!file) return failure(file);
    const auto archive = Archive::open(*file);
    if (!archive) return failure(archive);
    if (!archive->has("version") || !archive->has("metadata")) {
        return archive->broken("this archive has no version and metadata; a sigrok session was expected");
    }
    const auto number = archive->unpack("version", 100);
    if (!number) return failure(number);
    if (trimmed(*number) != "2") return archive->broken("version {} of .sr; 2 was expected", trimmed(*number));
    const auto text = archive->unpack("metadata", kMaxText);
    if (!text) return failure(text);
    const auto device = deviceOf(*text);
    if (!device) return archive->broken("its metadata does not describe one device");
    return layoutFrom(*archive, *device);
}

}  // namespace tacto::sigrok_driver
