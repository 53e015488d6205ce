#include "core/measure/CaptureDescription.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/base/WholeFile.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr std::string_view kMark = "# tactoscope {";
constexpr std::string_view kComment = "# tactoscope ";

constexpr AcceptedText kAnyText{.mayBeEmpty = true};
constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

/// Accepts a stated tolerance that is not below zero; otherwise gives NaN.
ValueKind<double> toleranceKind() {
    return codedKind<double>(
        "a number of 0 or more, or null",
        [](const json& value) {
            const double stated = numberOr(value);
            return std::optional(stated >= 0 ? stated : kNaN);
        },
        numberOrNull);
}

RecordFields<Capture> buildCaptureFields() {
    using H = CaptureChannel;
    RecordFields<H> channel;
    channel.texts({{"name", &H::name}, {"unit", &H::unit}, {"stated_by", &H::statedBy}}, kAnyText);
    channel.number("low", &H::low);
    channel.number("high", &H::high);
    channel.number("lsb", &H::lsb);
    channel.add("gain_tolerance", &H::gainTolerance, toleranceKind());
    channel.add("offset_tolerance", &H::offsetTolerance, toleranceKind());
    channel.add("linearity_tolerance", &H::linearityTolerance, toleranceKind());
    channel.add("probe_tolerance", &H::probeTolerance, toleranceKind());
    channel.passOverUnknownKeys();

    using C = Capture;
    RecordFields<C> all;
    all.number("rate_hz", &C::rate_hz);
    all.number("start_s", &C::start_s);
    all.number("trigger_s", &C::trigger_s);
    all.flag("simulated", &C::simulated);
    all.flag("gain_shared", &C::gainShared);
    all.add("timebase_tolerance", &C::timeBaseTolerance, toleranceKind());
    all.add("stamp_tolerance_s", &C::stampTolerance_s, toleranceKind());
    all.list("channels", &C::channels, channel.kind(), 0, kAnyNumber);
    all.passOverUnknownKeys();
    return all;
}

const RecordFields<Capture>& captureFields() { return builtOnce<buildCaptureFields>(); }

}  // namespace

json describeCapture(const Capture& capture) { return captureFields().write(capture); }

std::optional<Capture> captureDescribed(const json& description) {
    const auto channels = valueOr(description, "channels");
    const auto isObject = [](const json& value) { return value.is_object(); };
    if (!channels.is_array() || !std::all_of(channels.begin(), channels.end(), isObject)) return std::nullopt;
    Capture capture;
    capture.rate_hz = capture.start_s = capture.trigger_s = kNaN;
    static_cast<void>(captureFields().read(description, capture, {.lenient = true}));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        // Older files contain 0 if the instrument did not state a tolerance.
        if (channels[i].contains("stated_by")) continue;
        for (double* stated : {&capture.channels[i].gainTolerance, &capture.channels[i].offsetTolerance}) {
            if (*stated == 0) *stated = kNaN;
        }
    }
    return capture;
}

std::string captureHeader(const Capture& capture) {
    const bool stated = std::any_of(capture.channels.begin(), capture.channels.end(), [](const auto& channel) {
        return !channel.statedBy.empty() || std::isfinite(channel.gainTolerance);
    });
    if (!capture.simulated && !stated) return {};
    return std::string(kComment) + dumpJson(describeCapture(capture), -1, true) + "\n";
}

std::optional<Capture> headerIn(std::string_view text) {
    const auto begin = text.find(kMark);
    if (begin == std::string_view::npos || (begin > 0 && text[begin - 1] != '\n')) return std::nullopt;
    auto line = text.substr(begin + kComment.size());
    line = line.substr(0, line.find('\n'));
    const auto description = parseJson(line, "header", {.bytes = 100'000, .depth = 4});
    return description ? captureDescribed(*description) : std::nullopt;
}

void takeHeader(Capture& capture, const Capture& header) {
    capture.simulated = header.simulated;
    if (capture.channels.size() != header.channels.size()) return;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        if (capture.channels[c].unit != header.channels[c].unit) return;  // the channel was read with another unit
    }
    capture.trigger_s = header.trigger_s;
    capture.timeBaseTolerance = header.timeBaseTolerance;
    capture.stampTolerance_s = header.stampTolerance_s;
    capture.gainShared = header.gainShared;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        auto& channel = capture.channels[c];
        auto samples = std::move(channel.samples);
        auto name = std::move(channel.name);
        channel = header.channels[c];
        channel.samples = std::move(samples);
        channel.name = std::move(name);
        if (!(channel.high > channel.low)) channel.low = channel.high = 0;
        if (!(channel.lsb > 0)) channel.lsb = 0;
    }
}

namespace {

constexpr const char* kFile = "origin.json";
constexpr std::size_t kMaxBytes = 4096;
constexpr std::size_t kMaxHeader = 16'384;

std::optional<bool> readOrigin(const std::filesystem::path& folder) {
    std::ifstream stream(folder / kFile, std::ios::binary);
    std::string text(kMaxBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto origin = parseJson(text, kFile, {.bytes = kMaxBytes, .depth = 1});
    if (!origin || !origin->is_object()) return std::nullopt;
    const auto said = origin->find("simulated");
    return said != origin->end() && said->is_boolean() ? std::optional(said->get<bool>()) : std::nullopt;
}

}  // namespace

Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated) {
    const auto said = readOrigin(folder);
    if (said && (*said || *said == simulated)) return {};
    const auto file = folder / kFile;
    return namedAs(file, writeWholeFile(file, dumpJson(nlohmann::json{{"simulated", simulated}}) + "\n"));
}

std::optional<bool> statedSimulated(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(kMaxHeader, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto header = headerIn(text);
    const auto folder = readOrigin(file.parent_path());
    // Either of them may say that the capture is simulated; the other cannot overrule this. An origin.json that cannot
    // be read leaves the origin in doubt.
    if ((header && header->simulated) || folder == true) return true;
    std::error_code ignored;
    const bool unreadable = !folder && std::filesystem::exists(file.parent_path() / kFile, ignored);
    if (unreadable) return std::nullopt;
    return header ? std::optional(false) : folder;
}

}  // namespace tacto
