#include "core/analysis/TrialFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/Csv.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

std::optional<std::size_t> columnCalled(const std::vector<std::string_view>& header,
                                        std::initializer_list<std::string_view> names) {
    for (const auto name : names) {
        const auto found = std::find(header.begin(), header.end(), name);
        if (found != header.end()) return static_cast<std::size_t>(found - header.begin());
    }
    return std::nullopt;
}

}  // namespace

Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseSeparabilityTrials(*text, path.string());
}

Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text, std::string_view name) {
    constexpr std::string_view kExpected = "columns condition, amplitude and interval were expected";
    CsvReader reader(text);
    if (!reader.next()) return fail(ErrorCode::ParseError, "{}: the file is empty; {}", name, kExpected);
    const auto& header = reader.fields();
    const auto condition = columnCalled(header, {"condition"});
    const auto amplitude = columnCalled(header, {"amplitude", "amplitude_v", "amplitude_ma"});
    const auto interval = columnCalled(header, {"interval", "interval_s"});
    if (!condition || !amplitude || !interval) {
        return fail(ErrorCode::ParseError, "{}:{}: no column '{}'; {}", name, reader.line(),
                    !condition   ? "condition"
                    : !amplitude ? "amplitude"
                                 : "interval",
                    kExpected);
    }
    const std::size_t needed = std::max({*condition, *amplitude, *interval}) + 1;

    std::vector<SeparabilityTrial> trials;
    while (reader.next()) {
        const auto& fields = reader.fields();
        if (fields.size() < needed) {
            return fail(ErrorCode::ParseError, "{}:{}: {} fields; at least {} were expected, as in the header", name,
                        reader.line(), fields.size(), needed);
        }
        SeparabilityTrial trial;
        trial.condition = std::string(fields[*condition]);
        if (trial.condition.empty()) {
            return fail(ErrorCode::ParseError, "{}:{}: the condition is empty; a name was expected", name,
                        reader.line());
        }
        struct Value {
            std::string_view column;
            std::string_view field;
            double* target;
        };
        for (const auto& [column, field, target] : {Value{"amplitude", fields[*amplitude], &trial.amplitude},
                                                    Value{"interval", fields[*interval], &trial.interval_s}}) {
            if (field.empty()) {
                *target = std::numeric_limits<double>::quiet_NaN();
                continue;
            }
            const auto number = parseNumber(field);
            if (!number || !(std::isnan(*number) || (*number > 0 && std::isfinite(*number)))) {
                return fail(
                    ErrorCode::ParseError,
                    "{}:{}: {} '{}'; a finite number above 0 was expected, or nothing where it was not measured", name,
                    reader.line(), column, field.substr(0, 40));
            }
            *target = *number;
        }
        trials.push_back(std::move(trial));
    }
    if (trials.empty()) {
        return fail(ErrorCode::ParseError, "{}: nothing after the header line; a row per trial was expected", name);
    }
    return trials;
}

}  // namespace tacto
