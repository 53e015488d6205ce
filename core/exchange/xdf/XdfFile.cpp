#include "core/exchange/xdf/XdfFile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/exchange/xdf/ClockLine.h"
#include "core/exchange/xdf/Gunzip.h"
#include "core/exchange/xdf/XdfNames.h"

namespace tacto {

namespace {

using namespace xdf;

template <class Number>
Number littleEndian(const char* bytes) noexcept {
    static_assert(std::endian::native == std::endian::little, "numbers in XDF files are little-endian");
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

/// Takes numbers from the front of some bytes; nothing once they do not suffice.
class Bytes {
public:
    explicit Bytes(std::string_view left) : left_(left) {}

    [[nodiscard]] std::size_t left() const noexcept { return left_.size(); }
    std::optional<std::string_view> take(std::uint64_t count) {
        if (count > left_.size()) return std::nullopt;
        const auto taken = left_.substr(0, static_cast<std::size_t>(count));
        left_.remove_prefix(taken.size());
        return taken;
    }
    template <class Number>
    std::optional<Number> number() {
        const auto bytes = take(sizeof(Number));
        return bytes ? std::optional(littleEndian<Number>(bytes->data())) : std::nullopt;
    }
    /// A length: how many bytes it takes, then these.
    std::optional<std::uint64_t> length() {
        switch (number<std::uint8_t>().value_or(0)) {
            case 1:
                return number<std::uint8_t>();
            case 4:
                return number<std::uint32_t>();
            case 8:
                return number<std::uint64_t>();
            default:
                return std::nullopt;
        }
    }

private:
    std::string_view left_;
};

double decoded(const char* bytes, Format format) noexcept {
    switch (format) {
        case Format::Int8:
            return littleEndian<std::int8_t>(bytes);
        case Format::Int16:
            return littleEndian<std::int16_t>(bytes);
        case Format::Int32:
            return littleEndian<std::int32_t>(bytes);
        case Format::Int64:
            return static_cast<double>(littleEndian<std::int64_t>(bytes));
        case Format::Float32:
            return static_cast<double>(littleEndian<float>(bytes));
        case Format::Double64:
            return littleEndian<double>(bytes);
        case Format::String:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// The samples of a chunk, checked.
struct SampleChunk {
    std::string_view samples;  ///< behind their number
    std::uint64_t count;
    std::size_t losses;  ///< how many damaged places came before it
};

struct ReadStream {
    SignalStream out;
    Format format = Format::Double64;
    std::vector<SampleChunk> chunks = {};
    std::vector<ClockOffset> offsets = {};
    std::optional<std::uint64_t> footerCount = {};
};

std::string textOf(const pugi::xml_node& node, const char* child) {
    return printable(trimmed(node.child_value(child)));
}

class XdfReader {
public:
    explicit XdfReader(std::string_view content) : content_(content) {}

    SignalFile read() {
        at_ = kMagic.size();
        while (at_ < content_.size()) {
            const auto begin = at_;
            if (!readChunk()) passDamage(begin);
        }
        if (damages_ > kShownDamages) warn("damaged at {} more places", damages_ - kShownDamages);
        for (const auto id : order_) {
            auto& stream = streams_.at(id);
            finish(stream);
            file_.streams.push_back(std::move(stream.out));
        }
        return std::move(file_);
    }

private:
    static constexpr std::size_t kShownDamages = 3;
    static constexpr double kMaxClock_s = 1e15;  // 30 million years; differences of such offsets are finite

    template <class... Args>
    void warn(fmt::format_string<Args...> text, Args&&... args) {
        file_.warnings.push_back(fmt::format(text, std::forward<Args>(args)...));
    }

    /// Reads the chunk at at_ and moves behind it; false if it is damaged.
    bool readChunk() {
        Bytes head(content_.substr(at_));
        const auto length = head.length();
        if (!length) return false;
        const auto begin = content_.size() - head.left();
        const auto chunk = head.take(*length);
        if (!chunk) return false;
        Bytes content(*chunk);
        const auto tag = content.number<std::uint16_t>();
        if (!tag) return false;
        if (!readContent(static_cast<Tag>(*tag), content)) return false;
        at_ = begin + chunk->size();
        return true;
    }

    bool readContent(Tag tag, Bytes& content) {
        switch (tag) {
            case Tag::FileHeader:
                return readFileHeader(*content.take(content.left()));
            case Tag::StreamHeader:
            case Tag::Samples:
            case Tag::ClockOffset:
            case Tag::StreamFooter: {
                const auto id = content.number<std::uint32_t>();
                return id && readOfStream(tag, *id, content);
            }
            case Tag::Boundary:
                break;
        }
        return true;  // a boundary, or a chunk that this reader does not know
    }

    bool readOfStream(Tag tag, std::uint32_t id, Bytes& content) {
        if (tag == Tag::StreamHeader) return readHeader(id, *content.take(content.left()));
        const auto known = streams_.find(id);
        if (known == streams_.end()) {
            if (!headless_) warn("stream {} has no header that can be read, and is left out", id);
            headless_ = true;
            return true;
        }
        auto& stream = known->second;
        if (tag == Tag::Samples) return readSamples(stream, content);
        if (tag == Tag::ClockOffset) {
            const auto at = content.number<double>();
            const auto offset = content.number<double>();
            if (!at || !offset || content.left() > 0) return false;
            const auto sound = [](double clock_s) { return std::abs(clock_s) < kMaxClock_s; };  // false for NaN
            if (sound(*at) && sound(*offset)) stream.offsets.push_back({*at, *offset});
            return true;
        }
        pugi::xml_document document;
        if (!parse(document, *content.take(content.left()))) return false;
        const auto count = parseNumber(document.child(kInfo).child_value("sample_count"));
        if (count && *count >= 0 && *count < 1e15) stream.footerCount = static_cast<std::uint64_t>(*count);
        return true;
    }

    static bool parse(pugi::xml_document& document, std::string_view text) {
        return static_cast<bool>(
            document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8));
    }

    bool readFileHeader(std::string_view text) {
        pugi::xml_document document;
        if (!parse(document, text)) return false;
        const auto info = document.child(kInfo);
        file_.ours = std::string_view(info.child_value(kProgram)).starts_with(kProgramName);
        const std::string_view simulated = info.child_value(kSimulated);
        if (file_.ours && simulated == "1") file_.simulated = true;
        return true;
    }

    bool readHeader(std::uint32_t id, std::string_view text) {
        if (streams_.contains(id)) {
            if (!doubled_) warn("stream {} has a second header, which is left aside", id);
            doubled_ = true;
            return true;
        }
        pugi::xml_document document;
        if (!parse(document, text)) return false;
        const auto info = document.child(kInfo);
        const auto count = parseNumber(info.child_value("channel_count"));
        const auto format = valueFor(kFormats, trimmed(info.child_value("channel_format")));
        if (!count || !(*count >= 0 && *count <= std::numeric_limits<std::uint32_t>::max()) ||
            *count != std::floor(*count) || !format)
            return false;
        auto& stream = streams_[id];
        order_.push_back(id);
        stream.format = *format;
        stream.out.id = id;
        stream.out.width = static_cast<std::size_t>(*count);
        stream.out.texts = *format == Format::String;
        stream.out.name = textOf(info, "name");
        stream.out.type = textOf(info, "type");
        stream.out.serial = textOf(info.child("desc"), kSerial);
        const auto rate = parseNumber(info.child_value("nominal_srate"));
        if (rate && *rate > 0 && std::isfinite(*rate)) stream.out.rate_hz = *rate;
        for (const auto& channel : info.child("desc").child("channels").children("channel")) {
            if (stream.out.channels.size() == stream.out.width) break;
            stream.out.channels.push_back(
                {textOf(channel, "label"), textOf(channel, "unit"), stream.out.channels.size() + 1});
        }
        return true;
    }

    /// Checks all samples of a chunk and keeps where they stand.
    bool readSamples(ReadStream& stream, Bytes& content) {
        const auto count = content.length();
        if (!count) return false;
        const auto samples = *content.take(content.left());
        Bytes left(samples);
        for (std::uint64_t i = 0; i < *count; ++i) {
            const auto mark = left.number<char>();
            if (!mark || (*mark != kStamped && *mark != kDeduced)) return false;
            if (*mark == kStamped && !left.take(sizeof(double))) return false;
            if (!passValues(stream, left)) return false;
        }
        if (left.left() > 0) return false;
        if (*count > 0) stream.chunks.push_back({samples, *count, damages_});
        stream.out.count += static_cast<std::size_t>(*count);
        return true;
    }

    static bool passValues(const ReadStream& stream, Bytes& left) {
        if (stream.format != Format::String)
            return stream.out.width <= left.left() && left.take(stream.out.width * bytesOf(stream.format));
        for (std::uint64_t c = 0; c < stream.out.width; ++c) {
            const auto length = left.length();
            if (!length || !left.take(*length)) return false;
        }
        return true;
    }

    /// Goes on behind the next boundary after a chunk that is damaged.
    void passDamage(std::size_t begin) {
        const auto found = content_.find(kBoundary, begin + 1);
        at_ = found == std::string_view::npos ? content_.size() : found + kBoundary.size();
        if (++damages_ > kShownDamages) return;
        if (found == std::string_view::npos)
            warn("damaged or cut short at byte {}: {} bytes up to its end are left out", begin,
                 content_.size() - begin);
        else
            warn("damaged at byte {}: {} bytes up to the next boundary are left out", begin, found - begin);
    }

    static void finish(ReadStream& stream) {
        auto& out = stream.out;
        const bool tooMany = stream.footerCount && out.count > *stream.footerCount;
        if (tooMany && lastOffsetIsStray(stream.offsets)) {
            stream.offsets.pop_back();
            out.count = static_cast<std::size_t>(*stream.footerCount);
        }
        if (!out.texts) decode(stream);
        if (const auto reset = clockReset(stream.offsets)) {
            const auto& last = stream.offsets[*reset];
            out.obstacle =
                fmt::format("its clock was reset after {:.3f} s (on the recorder's clock; {:.3f} s on its own)",
                            last.at_s + last.offset_s, last.at_s);
        } else {
            const auto line = fitClock(stream.offsets);
            for (auto& t : out.samples.t_s) t = line.onRecorder(t);
        }
    }

    static void decode(ReadStream& stream) {
        auto& samples = stream.out.samples;
        const auto channels = stream.out.width;
        const auto size = bytesOf(stream.format);
        samples.t_s.reserve(stream.out.count);
        samples.values.reserve(stream.out.count * channels);
        const double step = stream.out.rate_hz > 0 ? 1 / stream.out.rate_hz : 0;
        double last = 0;
        bool known = true;  // false while the stamp before was lost
        std::size_t losses = 0;
        for (const auto& chunk : stream.chunks) {
            if (std::exchange(losses, chunk.losses) != chunk.losses) known = false;
            const char* at = chunk.samples.data();
            for (std::uint64_t i = 0; i < chunk.count && samples.t_s.size() < stream.out.count; ++i) {
                if (*at++ == kStamped) {
                    last = littleEndian<double>(at);
                    at += sizeof(double);
                    known = true;
                } else {
                    last += step;
                }
                if (known) {
                    samples.t_s.push_back(last);
                    for (std::size_t c = 0; c < channels; ++c)
                        samples.values.push_back(decoded(at + c * size, stream.format));
                }
                at += channels * size;
            }
        }
        stream.out.count = samples.t_s.size();
    }

    const std::string_view content_;
    std::size_t at_ = 0;
    std::map<std::uint32_t, ReadStream> streams_;
    std::vector<std::uint32_t> order_;  // as their headers stand in the file
    std::size_t damages_ = 0;
    bool headless_ = false, doubled_ = false;  // already warned of
    SignalFile file_;
};

}  // namespace

bool beginsAsXdf(std::string_view head) noexcept { return head.starts_with(kMagic) || gzipHolds(head, kMagic); }

Result<SignalFile> readXdf(const std::filesystem::path& path) {
    auto content = readTextFile(path);
    if (!content) return failure(content);
    bool cut = false;
    if (isGzip(*content)) {
        auto unpacked = gunzip(*content, kMaxUnpacked);
        if (!unpacked) return fail(unpacked.error().code, "{} {}", path.string(), unpacked.error().message);
        *content = std::move(unpacked->content);
        cut = unpacked->cut;
    }
    if (!content->starts_with(kMagic))
        return fail(ErrorCode::ParseError, "{} does not begin with \"{}\", as an XDF file does", path.string(), kMagic);
    auto file = XdfReader(*content).read();
    if (cut)
        file.warnings.insert(file.warnings.begin(), "its gzip data are cut short: what they hold before that is read");
    return file;
}

}  // namespace tacto
