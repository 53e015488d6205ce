#include "core/analysis/separability/TrialFile.h"

#include <cmath>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/Text.h"

namespace tacto {

Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseSeparabilityTrials(*text, path.string());
}

Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text, std::string_view name) {
    NamedRows rows(text, name, "columns condition, amplitude and interval were expected", "a row per trial");
    const auto condition = rows.column({"condition"});
    if (!condition) return failure(condition);
    const auto amplitude = rows.column({"amplitude", "amplitude_v", "amplitude_ma"});
    if (!amplitude) return failure(amplitude);
    const auto interval = rows.column({"interval", "interval_s"});
    if (!interval) return failure(interval);

    std::vector<SeparabilityTrial> trials;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        SeparabilityTrial trial;
        trial.condition = std::string(rows[*condition]);
        if (trial.condition.empty()) return rows.refuse("the condition is empty; a name was expected");
        struct Value {
            std::string_view column;
            std::string_view field;
            double* target;
        };
        for (const auto& [column, field, target] : {Value{"amplitude", rows[*amplitude], &trial.amplitude},
                                                    Value{"interval", rows[*interval], &trial.interval_s}}) {
            if (field.empty()) {
                *target = std::numeric_limits<double>::quiet_NaN();
                continue;
            }
            const auto number = parseNumber(field);
            if (!number || !(std::isnan(*number) || (*number > 0 && std::isfinite(*number)))) {
                return rows.refuse(
                    "{} '{}'; a finite number above 0 was expected, or nothing where it was not measured", column,
                    field.substr(0, 40));
            }
            *target = *number;
        }
        trials.push_back(std::move(trial));
    }
    if (!more) return failure(more);
    return trials;
}

}  // namespace tacto
