#include "app/cli/CaptureOptions.h"

#include <cmath>

#include "app/cli/Command.h"
#include "app/cli/ProgressBar.h"
#include "app/run/CaptureFormatsList.h"
#include "app/run/Shipped.h"
#include "core/base/LocaleFreeText.h"

namespace tacto::cli {

namespace {

/// Splits "CH1=mV" at the last '='.
Result<std::pair<std::string, std::string>> pairOf(const QString& text, const char* option, const char* example) {
    const auto both = text.toStdString();
    // A channel's name may contain '='; a unit or a number cannot.
    const auto equals = both.rfind('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == both.size()) {
        return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; CHANNEL={} is expected", option, both, example);
    }
    return std::pair(std::string(trimmed(both.substr(0, equals))), std::string(trimmed(both.substr(equals + 1))));
}

/// Adds what an option says about a channel. Errors: InvalidArgument if the option was given twice for a channel.
template <class Map, class Entry>
Result<void> addOnce(Map& all, const Entry& entry, const char* option) {
    if (all.emplace(entry.first, entry.second).second) return {};
    return fail(ErrorCode::InvalidArgument, "{}", givenTwice("--{} of {}", option, entry.first));
}

}  // namespace

void declareCaptureOptions(QCommandLineParser& parser) {
    parser.addOption({"format", "Reads the file as this format, without detection (csv-rigol, isf, …).", "ID"});
    parser.addOption({"skip-rows", "Lines at the beginning of a table that are passed over.", "N"});
    parser.addOption(
        {"columns", "The channels to read, by name or number of the column, with commas between.", "LIST"});
    parser.addOption({"time-column", "The column of times, by name or number.", "COLUMN"});
    parser.addOption({"unit", "The unit of a channel's numbers, as in CH1=mV; may be repeated.", "CH=UNIT"});
    parser.addOption(
        {"probe", "Factor that a channel's numbers are multiplied by, as in CH1=10; may be repeated.", "CH=FACTOR"});
    parser.addOption(
        {"range",
         "The input range of a channel in V or A, as in CH1=-5:5, for a file that does not state it: a sample "
         "at or beyond an end is clipped; may be repeated.",
         "CH=LOW:HIGH"});
    parser.addOption({"sample-rate", "Samples per second, for a file without times or with wrong ones.", "HZ"});
}

Result<ReadOptions> captureOptions(const QCommandLineParser& parser) {
    ReadOptions options;
    options.format = parser.value("format").toStdString();
    options.timeColumn = parser.value("time-column").toStdString();
    if (parser.isSet("skip-rows")) {
        const auto rows = numberOption(parser, "skip-rows");
        if (!rows) return failure(rows);
        if (!(*rows >= 0 && *rows <= 1e6) || *rows != std::floor(*rows)) {
            return fail(ErrorCode::InvalidArgument, "--skip-rows is {}; a whole number from 0 to a million is expected",
                        *rows);
        }
        options.skipRows = static_cast<std::size_t>(*rows);
    }
    if (parser.isSet("columns")) {
        const auto list = parser.value("columns").toStdString();
        for (const auto name : split(list, ',')) {
            if (trimmed(name).empty()) {
                return fail(ErrorCode::InvalidArgument,
                            "--columns is \"{}\"; names or numbers with commas between are expected", list);
            }
            options.columns.emplace_back(trimmed(name));
        }
    }
    for (const auto& text : parser.values("unit")) {
        const auto unit = pairOf(text, "unit", "mV");
        if (!unit) return failure(unit);
        if (const auto once = addOnce(options.units, *unit, "unit"); !once) return failure(once);
    }
    for (const auto& text : parser.values("probe")) {
        const auto probe = pairOf(text, "probe", "10");
        if (!probe) return failure(probe);
        const auto factor = parseNumber(probe->second);
        if (!factor) {
            return fail(ErrorCode::InvalidArgument, "--probe is \"{}\"; CHANNEL=10, a number, is expected",
                        text.toStdString());
        }
        const auto once = addOnce(options.probeFactors, std::pair(probe->first, *factor), "probe");
        if (!once) return failure(once);
    }
    for (const auto& text : parser.values("range")) {
        const auto range = pairOf(text, "range", "-5:5");
        if (!range) return failure(range);
        const auto ends = split(range->second, ':');
        const auto low = ends.size() == 2 ? parseNumber(ends[0]) : std::nullopt;
        const auto high = low ? parseNumber(ends[1]) : std::nullopt;
        if (!high) {
            return fail(ErrorCode::InvalidArgument, "--range is \"{}\"; CHANNEL=-5:5, two numbers, is expected",
                        text.toStdString());
        }
        const auto once = addOnce(options.ranges, std::pair(range->first, std::pair(*low, *high)), "range");
        if (!once) return failure(once);
    }
    if (parser.isSet("sample-rate")) {
        const auto rate = numberOption(parser, "sample-rate");
        if (!rate) return failure(rate);
        if (!(*rate > 0)) {
            return fail(ErrorCode::InvalidArgument, "--sample-rate is {}; a number above 0 is expected", *rate);
        }
        options.rate = Hertz(*rate);
    }
    return options;
}

Result<CaptureReading> readCaptureFile(const std::string& path, const ReadOptions& options) {
    ProgressBar bar("reading");
    return captureFormats()->read(path, options, {[&](double fraction) { bar.show(fraction); }, {}});
}

Result<Profile> profileOption(const QCommandLineParser& parser) {
    return parser.isSet("profile") ? loadProfile(parser.value("profile").toStdString()) : shippedProfile();
}

}  // namespace tacto::cli
