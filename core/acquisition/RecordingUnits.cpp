#include "core/acquisition/RecordingUnits.h"

#include <algorithm>
#include <array>

#include "core/base/CsvHead.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr double kStandardGravity = 9.80665;

using enum StreamKind;
using enum StreamUnit;
// Volts have no meaning as such until a sensitivity gives it: they are counts of a microvolt.
constexpr std::array kRecordedUnits{RecordedUnit{Acceleration, MetrePerSecondSquared, 1, "m/s2"},
                                    RecordedUnit{Acceleration, MetrePerSecondSquared, 1e-3, "mm/s2"},
                                    RecordedUnit{Acceleration, MetrePerSecondSquared, kStandardGravity, "g"},
                                    RecordedUnit{Acceleration, MetrePerSecondSquared, 1e-3 * kStandardGravity, "mg"},
                                    RecordedUnit{Acceleration, Count, 1, "count"},
                                    RecordedUnit{Acceleration, Count, 1, "uV"},
                                    RecordedUnit{Acceleration, Count, 1e3, "mV"},
                                    RecordedUnit{Acceleration, Count, 1e6, "V"},
                                    RecordedUnit{Force, Newton, 1, "N"},
                                    RecordedUnit{Force, Newton, 1e-3, "mN"},
                                    RecordedUnit{Force, Newton, 1e3, "kN"},
                                    RecordedUnit{Force, Count, 1, "count"},
                                    RecordedUnit{Force, Count, 1, "uV"},
                                    RecordedUnit{Force, Count, 1e3, "mV"},
                                    RecordedUnit{Force, Count, 1e6, "V"},
                                    RecordedUnit{Taxels, Pascal, 1, "Pa"},
                                    RecordedUnit{Taxels, Pascal, 1e2, "hPa"},
                                    RecordedUnit{Taxels, Pascal, 1e3, "kPa"},
                                    RecordedUnit{Taxels, Pascal, 1e6, "MPa"},
                                    RecordedUnit{Taxels, Count, 1, "count"},
                                    RecordedUnit{Taxels, Count, 1, "uV"},
                                    RecordedUnit{Taxels, Count, 1e3, "mV"},
                                    RecordedUnit{Taxels, Count, 1e6, "V"}};
constexpr std::array kRecordedTimes{RecordedTimeUnit{1, "s"}, RecordedTimeUnit{1e3, "ms"}, RecordedTimeUnit{1e6, "us"},
                                    RecordedTimeUnit{1e9, "ns"}};

/// Unifies spellings: powers and minus signs become digits and '-', multiplication signs are removed, and both micro
/// signs become 'u'.
std::string plainlyTyped(std::string_view text) {
    constexpr std::pair<std::string_view, std::string_view> kTyped[] = {{"²", "2"}, {"⁻", "-"}, {"−", "-"}, {"µ", "u"},
                                                                        {"μ", "u"}, {"·", ""},  {"⋅", ""},  {"^", ""},
                                                                        {"*", ""},  {" ", ""}};
    std::string out(trimmed(text));
    for (const auto& [from, to] : kTyped) {
        for (auto at = out.find(from); at != std::string::npos; at = out.find(from, at + to.size()))
            out.replace(at, from.size(), to);
    }
    // Spelled out, as streams of LSL have it
    for (const auto& [from, to] : {std::pair{"microvolts", "uV"},
                                   {"millivolts", "mV"},
                                   {"volts", "V"},
                                   {"newtons", "N"},
                                   {"pascals", "Pa"},
                                   {"counts", "count"}})
        if (sameLetters(out, from)) return to;
    // Other spellings: m·s⁻² and m/s/s
    for (const std::string_view otherwise : {"s-2", "/s/s"}) {
        if (out.ends_with(otherwise)) out.replace(out.size() - otherwise.size(), otherwise.size(), "/s2");
    }
    return out;
}

/// Returns whether `name` is `stem` followed by digits: "c12".
bool isNumbered(std::string_view name, std::string_view stem) {
    if (!name.starts_with(stem) || name.size() == stem.size()) return false;
    return name.find_first_not_of("0123456789 _-", stem.size()) == std::string_view::npos;
}

bool isUnit(std::string_view text) {
    return recordedTimeUnit(text).has_value() || std::ranges::any_of(kStreamKinds, [&](const auto& kind) {
               return recordedUnit(kind.value, text).has_value();
           });
}

}  // namespace

std::optional<RecordedUnit> recordedUnit(StreamKind kind, std::string_view text) {
    const auto typed = plainlyTyped(text);
    const auto found = std::ranges::find_if(
        kRecordedUnits, [&](const RecordedUnit& unit) { return unit.kind == kind && unit.spelled == typed; });
    return found == kRecordedUnits.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::string_view> unitsOf(StreamKind kind) {
    std::vector<std::string_view> all;
    for (const auto& unit : kRecordedUnits) {
        if (unit.kind == kind) all.emplace_back(unit.spelled);
    }
    return all;
}

std::optional<StreamKind> kindByName(std::string_view name) {
    for (const std::string_view word : {"acc", "vibration", "beschleunigung"}) {
        if (name.find(word) != std::string_view::npos) return StreamKind::Acceleration;
    }
    for (const std::string_view word : {"x", "y", "z", "ax", "ay", "az", "a_x", "a_y", "a_z"}) {
        if (name == word) return StreamKind::Acceleration;
    }
    for (const std::string_view word : {"force", "kraft", "load"}) {
        if (name.find(word) != std::string_view::npos) return StreamKind::Force;
    }
    for (const std::string_view word : {"f", "fz", "fn", "f_z", "f_n", "normal"}) {
        if (name == word) return StreamKind::Force;
    }
    for (const std::string_view stem : {"taxel", "channel", "ch", "c", "e", "electrode", "sensor", "p", "pressure"}) {
        if (isNumbered(name, stem)) return StreamKind::Taxels;
    }
    return std::nullopt;
}

std::optional<StreamKind> kindByUnit(std::string_view text) {
    for (const auto& kind : kStreamKinds) {
        const auto unit = recordedUnit(kind.value, text);
        if (unit && unit->unit != StreamUnit::Count) return kind.value;
    }
    return std::nullopt;
}

std::optional<RecordedTimeUnit> recordedTimeUnit(std::string_view text) {
    const auto typed = plainlyTyped(text);
    const auto found = std::ranges::find_if(kRecordedTimes, [&](const auto& unit) { return unit.spelled == typed; });
    return found == kRecordedTimes.end() ? std::nullopt : std::optional(*found);
}

HeaderName headerName(std::string_view text) {
    text = trimmed(text);
    const auto bracket = text.find_last_of("([");
    if (bracket != std::string_view::npos && (text.ends_with(')') || text.ends_with(']'))) {
        const auto unit = withoutBrackets(text.substr(bracket));
        if (isUnit(unit)) return {trimmed(text.substr(0, bracket)), unit};
    }
    for (const std::string_view mark : {" in ", "/", "_", " "}) {
        const auto at = text.find(mark);
        if (at == std::string_view::npos || at == 0) continue;
        const auto last = mark == "/" ? at : text.rfind(mark);  // "a/m/s2"
        const auto unit = trimmed(text.substr(last + mark.size()));
        if (isUnit(unit)) return {trimmed(text.substr(0, last)), unit};
    }
    return {text, {}};
}

}  // namespace tacto
