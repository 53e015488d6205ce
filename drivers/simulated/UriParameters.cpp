#include "drivers/simulated/UriParameters.h"

#include <algorithm>
#include <cmath>

#include "core/base/Text.h"

namespace tacto::sim {

std::optional<std::string_view> UriParameters::take(std::string_view key) {
    known_.emplace_back(key);
    std::optional<std::string_view> found;
    for (const auto& [name, value] : uri_.parameters) {
        if (name != key) continue;
        if (found && !problem_) {
            problem_ =
                Error{ErrorCode::InvalidArgument, fmt::format("device \"{}\": {} is given twice", uri_.text(), key)};
        }
        found = value;
    }
    return found;
}

void UriParameters::refuse(std::string_view key, std::string_view value, std::string_view accepted) {
    if (problem_) return;
    problem_ = Error{ErrorCode::InvalidArgument,
                     fmt::format("device \"{}\": {}={} is not accepted: {}", uri_.text(), key, value, accepted)};
}

double UriParameters::quantity(std::string_view key, std::string_view unit, double otherwise, double low, double high) {
    const auto text = take(key);
    if (!text) return otherwise;
    const auto value = parseQuantity(*text, unit);
    if (value && *value >= low && *value <= high) return *value;
    refuse(key, *text, fmt::format("a number from {:g} to {:g}{}{}", low, high, unit.empty() ? "" : " ", unit));
    return otherwise;
}

int UriParameters::integer(std::string_view key, int otherwise, int low, int high) {
    const auto text = take(key);
    if (!text) return otherwise;
    const auto value = parseQuantity(*text, "");
    if (value && *value >= low && *value <= high && *value == std::floor(*value)) return static_cast<int>(*value);
    refuse(key, *text, fmt::format("a whole number from {} to {}", low, high));
    return otherwise;
}

std::optional<std::string> UriParameters::text(std::string_view key) {
    const auto found = take(key);
    if (!found) return std::nullopt;
    return std::string(*found);
}

std::string UriParameters::choice(std::string_view key, std::string_view otherwise,
                                  std::initializer_list<std::string_view> accepted) {
    const auto text = take(key);
    if (!text) return std::string(otherwise);
    std::string names;
    for (const auto name : accepted) {
        if (name == *text) return std::string(name);
        names += (names.empty() ? "" : ", ");
        names += name;
    }
    refuse(key, *text, "one of " + names);
    return std::string(otherwise);
}

FaultSchedule UriParameters::faults(std::initializer_list<Fault> accepted) {
    known_.emplace_back("fault");
    FaultSchedule schedule;
    for (const auto& [name, value] : uri_.parameters) {
        if (name != "fault") continue;
        if (const auto added = schedule.add(value, accepted); !added && !problem_) {
            problem_ = Error{added.error().code, fmt::format("device \"{}\": {}", uri_.text(), added.error().message)};
        }
    }
    return schedule;
}

Result<void> UriParameters::finish() const {
    if (problem_) return tl::unexpected<Error>(*problem_);
    for (const auto& [name, value] : uri_.parameters) {
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        std::string names;
        for (const auto& known : known_) names += (names.empty() ? "" : ", ") + known;
        return fail(ErrorCode::InvalidArgument, "device \"{}\": there is no parameter \"{}\" (={}): it takes {}",
                    uri_.text(), name, value, names);
    }
    return {};
}

}  // namespace tacto::sim
