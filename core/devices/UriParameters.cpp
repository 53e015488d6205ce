#include "core/devices/UriParameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/GivenOnce.h"
#include "core/base/QuantityText.h"
#include "core/base/Text.h"

namespace tacto {

std::vector<std::string_view> UriParameters::each(std::string_view key) {
    known_.push_back(key);
    std::vector<std::string_view> values;
    for (const auto& [name, value] : uri_.parameters) {
        if (name == key) values.push_back(value);
    }
    return values;
}

std::optional<std::string_view> UriParameters::take(std::string_view key) {
    const auto values = each(key);
    if (values.size() > 1) refuse(givenTwice("{}", key));
    return values.empty() ? std::nullopt : std::optional(values.back());
}

void UriParameters::refuse(std::string_view key, std::string_view value, std::string_view accepted) {
    refuse(fmt::format("{}={} is not accepted: {}", key, value, accepted));
}

void UriParameters::refuse(std::string_view sentence) {
    if (!problem_) problem_ = uri_.refuse(ErrorCode::InvalidArgument, "{}", sentence).value();
}

std::optional<double> UriParameters::quantity(std::string_view key, std::string_view unit, double low, double high) {
    const auto text = take(key);
    if (!text) return std::nullopt;
    const auto value = parseQuantity(*text, unit);
    if (value && *value >= low && *value <= high) return value;
    refuse(key, *text, fmt::format("{} to {}", low == 0 ? "0" : exactText(low, unit), exactText(high, unit)));
    return std::nullopt;
}

std::optional<int> UriParameters::integer(std::string_view key, int low, int high) {
    const auto text = take(key);
    if (!text) return std::nullopt;
    const auto value = parseQuantity(*text, "");
    if (value && *value >= low && *value <= high && *value == std::floor(*value)) return static_cast<int>(*value);
    refuse(key, *text, fmt::format("a whole number from {} to {}", low, high));
    return std::nullopt;
}

std::optional<std::string> UriParameters::text(std::string_view key) {
    const auto found = take(key);
    return found ? std::optional(std::string(*found)) : std::nullopt;
}

std::string UriParameters::choice(std::string_view key, std::string_view otherwise,
                                  std::initializer_list<std::string_view> accepted) {
    const auto text = take(key);
    if (!text) return std::string(otherwise);
    if (std::ranges::find(accepted, *text) != accepted.end()) return std::string(*text);
    const auto last = accepted.end() - 1;
    refuse(key, *text, fmt::format("{} or {}", fmt::join(accepted.begin(), last, ", "), *last));
    return std::string(otherwise);
}

Result<void> UriParameters::finish() const {
    if (problem_) return tl::unexpected<Error>(*problem_);
    for (const auto& [name, value] : uri_.parameters) {
        if (std::ranges::find(known_, name) != known_.end()) continue;
        return uri_.refuse(ErrorCode::InvalidArgument, "there is no parameter \"{}\" (={}): it takes {}", name, value,
                           fmt::join(known_, ", "));
    }
    return {};
}

}  // namespace tacto
