#include "core/formats/csv/CsvColumns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/CsvHead.h"
#include "core/base/CsvStamp.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

/// Returns whether `text` means "time" in one of the languages in which such programs exist.
bool isTimeWord(std::string_view text) {
    constexpr std::array<std::string_view, 18> kWords{"time",  "t",     "zeit", "temps", "tiempo", "tempo",
                                                      "tijd",  "tid",   "czas", "čas",   "aika",   "idő",
                                                      "zaman", "время", "时间", "時間",  "시간",   "χρόνος"};
    return std::ranges::find(kWords, folded(text)) != kWords.end();
}

/// Returns whether `text` is a unit of another quantity (not voltage, current or time), as after a slash or a name.
bool isOtherUnit(std::string_view text) {
    constexpr std::array<std::string_view, 54> kOthers{
        "°c",  "°f",  "℃",   "degc", "k",    "hz",  "khz",  "mhz",  "ghz",  "%",  "n",    "mn",   "kn", "pa",
        "hpa", "kpa", "mpa", "bar",  "mbar", "ohm", "ohms", "kohm", "Ω",    "Ω",  "kΩ",   "kΩ",   "mΩ", "mΩ",
        "w",   "mw",  "kw",  "db",   "dbm",  "dbv", "rpm",  "m",    "mm",   "cm", "µm",   "um",   "g",  "kg",
        "deg", "°",   "rad", "mt",   "nf",   "j",   "lbf",  "m/s",  "km/h", "va", "m/s²", "m/s^2"};
    return std::ranges::find(kOthers, folded(text)) != kOthers.end();
}

/// Removes the word before a unit: "Unit: mV" in DSView's brackets.
std::string_view withoutWord(std::string_view spelled) {
    const auto mark = spelled.find_first_of(":=");
    if (mark == std::string_view::npos) return spelled;
    const auto word = folded(spelled.substr(0, mark));
    return word == "unit" || word == "units" || word == "einheit" ? spelled.substr(mark + 1) : spelled;
}

/// Returns the column called `name` with the unit that `spelled` stands for.
CsvColumn withUnit(std::string_view name, std::string_view spelled) {
    spelled = trimmed(withoutWord(spelled));
    name = trimmed(name);
    while (name.ends_with('/')) name = trimmed(name.substr(0, name.size() - 1));
    if (const auto unit = spelledUnit(spelled)) {
        return {std::string(name), std::string(unit->unit), unit->factor, ""};
    }
    return {std::string(name), "", 1, std::string(spelled)};
}

/// Splits `text` at `mark` into name and unit: "C1 in V", "t / s", "t/ms"; DIN 1313 writes quantity/unit.
std::optional<CsvColumn> withUnitBehind(std::string_view text, std::string_view mark) {
    for (auto at = text.find(mark, 1); at != std::string_view::npos; at = text.find(mark, at + 1)) {
        const auto spelled = trimmed(text.substr(at + mark.size()));
        const auto unit = spelledUnit(spelled);
        if ((unit && !unit->unit.empty()) || isOtherUnit(spelled)) return withUnit(text.substr(0, at), spelled);
    }
    return std::nullopt;
}

/// Splits "Time ms", "CH1 mV", "Spannung V". A letter is a unit only after a digit or a quantity, not in "Channel A".
std::optional<CsvColumn> withUnitBehindBlank(std::string_view text) {
    const auto at = text.rfind(' ');
    if (at == std::string_view::npos) return std::nullopt;
    const auto name = trimmed(text.substr(0, at));
    const auto unit = spelledUnit(text.substr(at + 1));
    if (!unit || unit->unit.empty() || name.empty()) return std::nullopt;
    if (text.size() - at == 2) {
        constexpr std::array<std::string_view, 8> kQuantities{"voltage", "current", "spannung", "strom",
                                                              "tension", "courant", "u",        "i"};
        const bool isQuantity = std::ranges::find(kQuantities, folded(name)) != kQuantities.end();
        const bool isOfTime = unit->unit == "s" && isTimeWord(name);
        const bool isNumbered = unit->unit != "s" && name.back() >= '0' && name.back() <= '9';
        if (!isOfTime && (unit->unit == "s" || (!isQuantity && !isNumbered))) return std::nullopt;
    }
    return withUnit(name, text.substr(at + 1));
}

/// Reads a number and returns it with the text after it.
std::optional<std::pair<double, std::string_view>> numberAndRest(std::string_view text, char point) {
    text = trimmed(text);
    double value = 0;
    const char* const behind = takeNumber(text.data(), text.data() + text.size(), point, value);
    if (behind == nullptr) return std::nullopt;
    return std::pair(value, trimmed(text.substr(static_cast<std::size_t>(behind - text.data()))));
}

}  // namespace

CsvColumn columnNamed(std::string_view text) {
    if (text.ends_with(')') || text.ends_with(']')) {
        for (const auto bracket : {text.find_last_of("(["), text.find_first_of("([")}) {
            if (bracket == std::string_view::npos) break;
            const auto spelled = text.substr(bracket + 1, text.size() - bracket - 2);
            auto column = withUnit(text.substr(0, bracket), spelled);
            if (bracket == 0) {  // a unit without a name: this is the time column
                if (column.unit != "s") break;
                column.name = "time";
            }
            if (column.unknownUnit.empty() || bracket == text.find_first_of("([")) return column;
        }
    }
    const auto mark = text.rfind('_');
    if (mark != std::string_view::npos && mark > 0 && mark + 1 < text.size()) {
        const auto unit = spelledUnit(text.substr(mark + 1));
        // With such names, a letter is part of the name and not a unit.
        constexpr std::array<std::string_view, 7> kLettered{"channel", "ch",    "kanal", "phase",
                                                            "input",   "probe", "line"};
        const bool isLettered =
            mark + 2 == text.size() && std::ranges::find(kLettered, folded(text.substr(0, mark))) != kLettered.end();
        if (unit && !unit->unit.empty() && (unit->unit != "s" || unit->factor <= 1) && !isLettered) {
            return withUnit(text.substr(0, mark), text.substr(mark + 1));
        }
    }
    for (const std::string_view between : {" in ", " en ", "/", ", "}) {
        if (auto column = withUnitBehind(text, between)) return *std::move(column);
    }
    for (const std::string_view before : {"in ", "en "}) {  // a unit of time alone
        if (!text.starts_with(before)) continue;
        if (const auto unit = spelledUnit(text.substr(3)); unit && unit->unit == "s")
            return withUnit("time", text.substr(3));
    }
    if (auto column = withUnitBehindBlank(text)) return *std::move(column);
    if (folded(text).starts_with("ch")) {  // "CH1V"
        const auto behind = text.find_first_not_of("0123456789", 2);
        if (behind != std::string_view::npos && behind > 2) {
            const auto unit = channelUnit(text.substr(behind));
            if (unit && !unit->unit.empty()) return withUnit(text.substr(0, behind), text.substr(behind));
        }
    }
    return {std::string(text), "", 1, ""};
}

bool isTimeColumn(const CsvColumn& column) {
    if (column.unit == "s") return true;
    const auto name = folded(column.name);
    return column.unit.empty() && column.unknownUnit.empty() &&
           (isTimeWord(name) || name == "seconds" || name == "second");
}

bool isIndexColumn(const CsvColumn& column) {
    const auto name = folded(column.name);
    return column.unit.empty() && column.unknownUnit.empty() &&
           (name == "index" || name == "sample" || name == "samples" || name == "sequence" || name == "nr");
}

std::string_view unitTextOf(std::string_view field) { return trimmed(withoutWord(withoutBrackets(field))); }

std::optional<SpelledUnit> unitField(std::string_view field) { return spelledUnit(unitTextOf(field)); }

bool isLineOfUnits(const CsvLine& line) {
    bool any = false;
    for (const std::string_view field : line.fields) {
        const auto unit = unitField(field);
        if (!unit && unitTextOf(field).size() == field.size() && !isOtherUnit(field)) return false;
        // "a" and "s" are channel names as well as units, so a line of units must contain a unit of time.
        any = any || (unit && unit->unit == "s");
    }
    return any;
}

const CsvLine* lineCalled(const CsvHead& head, std::string_view key) {
    for (const auto* lines : {&head.header, &head.beside}) {
        const auto found = std::ranges::find_if(*lines, [&](const CsvLine& line) {
            auto name = folded(line.fields.front());
            if (name.ends_with(':') || name.ends_with('=')) name.pop_back();
            return trimmed(name) == folded(key);
        });
        if (found != lines->end()) return &*found;
    }
    return nullptr;
}

std::string_view fieldIn(const CsvLine* line, std::size_t index) {
    return line != nullptr && index < line->fields.size() ? std::string_view(line->fields[index]) : std::string_view();
}

std::string_view wordCalled(const CsvHead& head, std::string_view key) { return fieldIn(lineCalled(head, key), 1); }

std::optional<double> numberCalled(const CsvHead& head, std::string_view key) {
    auto text = wordCalled(head, key);
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) text.remove_prefix(colon + 1);
    const auto number = numberAndRest(text, head.point);
    return number && number->second.empty() ? std::optional(number->first) : std::nullopt;
}

std::optional<std::string_view> remarkCalled(const CsvHead& head, std::string_view key) {
    for (const std::string_view remark : head.remarks) {
        const auto mark = remark.find_first_of(":=");
        if (mark != std::string_view::npos && folded(remark.substr(0, mark)) == folded(key)) {
            return trimmed(remark.substr(mark + 1));
        }
    }
    return std::nullopt;
}

std::optional<double> secondsIn(std::string_view text, char point) {
    const auto number = numberAndRest(text, point);
    if (!number) return std::nullopt;
    const auto unit = spelledUnit(number->second);
    if (!unit || (unit->unit != "s" && !number->second.empty())) return std::nullopt;
    return number->first * unit->factor;
}

std::optional<double> hertzIn(std::string_view text, char point) {
    const auto number = numberAndRest(text, point);
    if (!number) return std::nullopt;
    auto unit = folded(number->second);
    double factor = 1;
    if (!unit.empty()) {
        constexpr std::string_view kPrefixes = "kmg";
        if (const auto prefix = kPrefixes.find(unit.front()); prefix != std::string_view::npos) {
            factor = std::pow(1000.0, static_cast<double>(prefix + 1));
            unit.erase(0, 1);
        }
        if (unit != "hz" && unit != "sa/s" && unit != "s/s") return std::nullopt;
    }
    return number->first * factor;
}

std::optional<StatedInterval> intervalStated(const CsvHead& head) {
    constexpr std::array<std::string_view, 6> kRates{"sample rate",   "samplerate",         "sampling rate",
                                                     "sampling_rate", "sampling frequency", "sample_rate"};
    constexpr std::array<std::string_view, 5> kIntervals{"sample interval", "sampling interval", "sampling period",
                                                         "sample period", "time interval"};
    const auto read = [&](std::string_view key, std::string_view value,
                          std::size_t line) -> std::optional<StatedInterval> {
        if (!value.empty() && (value.front() == ':' || value.front() == '=')) value.remove_prefix(1);
        auto column = columnNamed(trimmed(key));  // "Sample Rate (Hz)"
        const auto name = folded(column.name);
        if (std::ranges::find(kRates, name) != kRates.end()) {
            std::string text(value);
            if (!column.unknownUnit.empty()) text += " " + column.unknownUnit;
            const auto rate = hertzIn(text, head.point);
            if (rate && *rate > 0 && std::isfinite(*rate)) return StatedInterval{1 / *rate, line};
        }
        if (std::ranges::find(kIntervals, name) != kIntervals.end()) {
            const auto interval = secondsIn(value, head.point);
            if (interval && *interval > 0 && std::isfinite(*interval)) {
                return StatedInterval{*interval * (column.unit == "s" ? column.factor : 1), line};
            }
        }
        return std::nullopt;
    };
    for (const std::string_view remark : head.remarks) {
        const auto mark = remark.find_first_of(":=,");
        if (mark == std::string_view::npos) continue;
        if (auto stated = read(remark.substr(0, mark), remark.substr(mark), 0)) return stated;
    }
    for (const auto& line : head.header) {
        const std::string_view first = line.fields.front();
        const auto mark = first.find_first_of(":=");
        if (auto stated = read(first.substr(0, mark),
                               mark + 1 < first.size() && mark != std::string_view::npos ? first.substr(mark)
                               : line.fields.size() > 1 ? std::string_view(line.fields[1])
                                                        : "",
                               line.number)) {
            return stated;
        }
    }
    return std::nullopt;
}

std::string unitNotStated(std::string_view file, const CsvLine& line, std::string_view column) {
    return fmt::format("{}:{}: the file does not state the unit of column '{}'; the option --unit does, as in {}=V",
                       file, line.number, column, column);
}

std::size_t filled(const CsvLine& line) {
    auto width = line.fields.size();
    while (width > 0 && line.fields[width - 1].empty()) --width;
    return width;
}

std::vector<std::string> namesIn(const CsvLine& line) {
    std::vector<std::string> names = line.fields;
    names.resize(filled(line));
    return names;
}

CsvHead readCaptureHead(std::string_view text, std::size_t skipRows) {
    auto head = readCsvHead(text, skipRows);
    if (!head.firstRow || !head.header.empty() || head.remarks.empty()) return head;
    const auto& row = *head.firstRow;
    std::vector<std::string_view> names;
    cutRow(head.remarks.back(), head.separator, names);
    if (head.separator == ' ') names = namesApartByBlanks(head.remarks.back(), row.fields.size());
    const auto isTime = [](std::string_view name) { return isTimeColumn(columnNamed(name)); };
    if (names.size() < 2 || names.size() != row.fields.size() || std::ranges::none_of(names, isTime)) return head;
    head.header.push_back({row.number - 1, row.offset, row.offset, {names.begin(), names.end()}});
    head.remarks.pop_back();
    return head;
}

}  // namespace tacto
