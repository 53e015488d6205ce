#include "core/safety/LimitSet.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/safety/FixedText.h"

namespace tacto {

namespace {
using Json = nlohmann::json;

constexpr std::size_t kLargestFile = 1'000'000;
constexpr std::size_t kMaxRows = 1000;
constexpr std::array<std::string_view, 2> kJudged{"load_range", "500_ohm"};
constexpr std::array<std::string_view, 3> kActions{"refuse", "warn", "disclose"};
constexpr std::array<std::string_view, 4> kConfidences{"high", "medium", "medium-low", "low"};

/// Where in the file a message points.
struct Place {
    std::string_view file;
    std::string part;  // "limits[2]"

    template <class... Args>
    tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}: {}", name(), fmt::format(text, std::forward<Args>(args)...));
    }
    [[nodiscard]] std::string name() const { return fmt::format("{}{}{}", file, part.empty() ? "" : ": ", part); }
};

Result<void> onlyKeys(const Json& object, std::initializer_list<std::string_view> known, const Place& place) {
    return tacto::onlyKeys(object, known, place.name());
}

Result<std::string> textOf(const Json& object, const char* key, bool required, const Place& place) {
    const auto found = object.find(key);
    if (found == object.end() && !required) return std::string{};
    const auto* text = found == object.end() ? nullptr : found->get_ptr<const std::string*>();
    if (text == nullptr || (required && text->empty())) return place.refuse("\"{}\" must be a text", key);
    if (text->size() > 2000) return place.refuse("\"{}\" is longer than 2000 bytes", key);
    return *text;
}

Result<double> numberOf(const Json& object, const char* key, double absent, const Place& place) {
    const auto found = object.find(key);
    if (found == object.end()) return absent;
    if (!found->is_number()) return place.refuse("\"{}\" must be a number", key);
    const double value = found->get<double>();
    if (!std::isfinite(value) || value < 0)
        return place.refuse("\"{}\" is {}; a finite number of 0 or more is accepted", key, value);
    return value;
}

/// The index of `key`'s text in `names`.
template <std::size_t N>
Result<std::size_t> choiceOf(const Json& object, const char* key, const std::array<std::string_view, N>& names,
                             const Place& place) {
    const auto text = textOf(object, key, true, place);
    if (!text) return failure(text);
    const auto found = std::find(names.begin(), names.end(), *text);
    if (found == names.end()) {
        return place.refuse("\"{}\" is \"{}\"; accepted are {}", key, *text, fmt::join(names, ", "));
    }
    return static_cast<std::size_t>(found - names.begin());
}

/// The two keys that every figure must have: where it is from, and how sure we are of it.
template <class Row>
Result<void> readSource(const Json& object, Row& row, const Place& place) {
    auto source = textOf(object, "source", true, place);
    if (!source) return failure(source);
    const auto confidence = choiceOf(object, "confidence", kConfidences, place);
    if (!confidence) return failure(confidence);
    row.source = std::move(*source);
    row.confidence = static_cast<Confidence>(*confidence);
    return {};
}

Result<LimitRow> readLimit(const Json& object, const Place& place) {
    if (auto keys = onlyKeys(object,
                             {"quantity", "max", "unit", "compare", "judged", "action", "above_hz", "up_to_hz",
                              "window_s", "source", "confidence", "note"},
                             place);
        !keys) {
        return failure(keys);
    }
    LimitRow row;
    const auto key = textOf(object, "quantity", true, place);
    if (!key) return failure(key);
    const auto quantity = quantityOf(*key);
    if (!quantity) return place.refuse("\"{}\" is not a known quantity", *key);
    row.quantity = *quantity;

    const auto max = numberOf(object, "max", 0, place);
    if (!max) return failure(max);
    if (!(*max > 0)) return place.refuse("\"max\" is {}; a number above 0 is accepted", *max);
    row.max = *max;
    const auto unit = textOf(object, "unit", true, place);
    if (!unit) return failure(unit);
    if (*unit != unitOf(row.quantity)) {
        return place.refuse("{} is given in {}; {} is accepted", *key, *unit, unitOf(row.quantity));
    }
    const auto window = numberOf(object, "window_s", windowOf(row.quantity), place);
    if (!window) return failure(window);
    if (*window != windowOf(row.quantity)) {
        return place.refuse("{} is given over {} s; {} s is its window", *key, *window, windowOf(row.quantity));
    }
    const auto compare = choiceOf(object, "compare", std::array<std::string_view, 2>{"<=", "<"}, place);
    if (!compare) return failure(compare);
    row.strict = *compare == 1;
    const auto judged = choiceOf(object, "judged", kJudged, place);
    if (!judged) return failure(judged);
    row.judged = static_cast<JudgedAt>(*judged);
    if (row.quantity == Quantity::CommandVoltage && row.judged == JudgedAt::Ohm500) {
        return place.refuse("command_voltage is judged at the nominal load; \"judged\": \"load_range\" is accepted");
    }
    const auto action = choiceOf(object, "action", kActions, place);
    if (!action) return failure(action);
    row.action = static_cast<LimitAction>(*action);
    const auto above = numberOf(object, "above_hz", 0, place);
    if (!above) return failure(above);
    const auto upTo = numberOf(object, "up_to_hz", 0, place);
    if (!upTo) return failure(upTo);
    if (*upTo != 0 && !(*upTo > *above)) return place.refuse("the frequency band {} to {} Hz is empty", *above, *upTo);
    row.aboveHz = *above;
    row.upToHz = *upTo;
    if (auto sourced = readSource(object, row, place); !sourced) return failure(sourced);
    auto note = textOf(object, "note", false, place);
    if (!note) return failure(note);
    row.note = std::move(*note);
    return row;
}

Result<AccuracyRow> readAccuracy(const Json& object, const Place& place) {
    if (auto keys = onlyKeys(object, {"parameter", "tolerance_pct", "source", "confidence"}, place); !keys)
        return failure(keys);
    AccuracyRow row;
    auto parameter = textOf(object, "parameter", true, place);
    if (!parameter) return failure(parameter);
    row.parameter = std::move(*parameter);
    const auto tolerance = numberOf(object, "tolerance_pct", 0, place);
    if (!tolerance) return failure(tolerance);
    row.tolerance_pct = *tolerance;
    if (auto sourced = readSource(object, row, place); !sourced) return failure(sourced);
    return row;
}

Result<DisclosureRow> readDisclosure(const Json& object, const Place& place) {
    if (auto keys = onlyKeys(object, {"output", "source", "confidence"}, place); !keys) return failure(keys);
    DisclosureRow row;
    auto output = textOf(object, "output", true, place);
    if (!output) return failure(output);
    row.output = std::move(*output);
    if (auto sourced = readSource(object, row, place); !sourced) return failure(sourced);
    return row;
}

template <class Row, class Read>
Result<void> readRows(const Json& document, const char* key, std::string_view file, std::vector<Row>& rows, Read read) {
    const auto found = document.find(key);
    if (found == document.end()) return {};
    if (!found->is_array() || found->size() > kMaxRows) {
        return Place{file, {}}.refuse("\"{}\" must be a list of at most {} rows", key, kMaxRows);
    }
    for (std::size_t i = 0; i < found->size(); ++i) {
        auto row = read((*found)[i], Place{file, fmt::format("{}[{}]", key, i)});
        if (!row) return failure(row);
        rows.push_back(std::move(*row));
    }
    return {};
}

}  // namespace

std::string_view nameOf(JudgedAt judged) noexcept { return kJudged[static_cast<std::size_t>(judged)]; }
std::string_view nameOf(LimitAction action) noexcept { return kActions[static_cast<std::size_t>(action)]; }
std::string_view nameOf(Confidence confidence) noexcept { return kConfidences[static_cast<std::size_t>(confidence)]; }

Result<LimitSet> parseLimitSet(std::string_view json, std::string_view name) {
    const Place place{name, {}};
    const auto document = parseJson(json, name, {.bytes = kLargestFile});
    if (!document) return failure(document);
    if (auto keys = onlyKeys(*document, {"id", "title", "about", "limits", "accuracy", "disclosures"}, place); !keys) {
        return failure(keys);
    }
    LimitSet set;
    auto id = textOf(*document, "id", true, place);
    if (!id) return failure(id);
    const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.'; };
    if (id->size() > 31 || !std::all_of(id->begin(), id->end(), plain) || *id == "profile") {
        return place.refuse("the id \"{}\" is not accepted: up to 31 of a-z, 0-9, '-' and '.', and not \"profile\"",
                            *id);
    }
    set.id = std::move(*id);
    auto title = textOf(*document, "title", true, place);
    if (!title) return failure(title);
    set.title = std::move(*title);
    if (auto about = textOf(*document, "about", false, place); !about) return failure(about);
    if (auto rows = readRows(*document, "limits", name, set.rows, readLimit); !rows) return failure(rows);
    if (auto rows = readRows(*document, "accuracy", name, set.accuracy, readAccuracy); !rows) return failure(rows);
    if (auto rows = readRows(*document, "disclosures", name, set.disclosures, readDisclosure); !rows)
        return failure(rows);
    if (set.rows.empty()) return place.refuse("\"limits\" must hold at least one row");
    return set;
}

Result<LimitSet> loadLimitSet(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) return fail(ErrorCode::NotFound, "no limit set at {}", file.string());
    if (size > kLargestFile)
        return fail(ErrorCode::ParseError, "{}: {} bytes; a limit set of at most 1 MB is accepted", file.string(),
                    size);
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream || text.size() != size) return fail(ErrorCode::Io, "cannot read {}", file.string());
    return parseLimitSet(text, file.filename().string());
}

Result<std::vector<LimitSet>> loadLimitSets(const std::filesystem::path& folder) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    if (error || files.empty()) return fail(ErrorCode::NotFound, "no limit sets (*.json) in {}", folder.string());
    std::sort(files.begin(), files.end());
    std::vector<LimitSet> sets;
    for (const auto& file : files) {
        auto set = loadLimitSet(file);
        if (!set) return failure(set);
        const bool twice = std::any_of(sets.begin(), sets.end(), [&](const LimitSet& s) { return s.id == set->id; });
        if (twice)
            return fail(ErrorCode::ParseError, "{}: a limit set with the id {} is loaded already",
                        file.filename().string(), set->id);
        sets.push_back(std::move(*set));
    }
    return sets;
}

}  // namespace tacto
