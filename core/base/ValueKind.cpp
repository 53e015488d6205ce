#include "core/base/ValueKind.h"

namespace tacto {

using nlohmann::json;

bool AcceptedNumbers::contain(double value) const noexcept {
    return (openLow ? value > low : value >= low) && (openHigh ? value < high : value <= high) &&
           (!whole || value == std::floor(value));
}

std::string AcceptedNumbers::text() const {
    const bool hasLow = low > std::numeric_limits<double>::lowest();
    const bool hasHigh = high < std::numeric_limits<double>::max();
    const std::string what = whole ? "a whole number" : "a number";
    const std::string ending = unit.empty() ? "" : fmt::format(" {}", unit);
    if (hasLow && hasHigh) {
        return fmt::format("{} {} {} to {}{}{}", what, openLow ? "above" : "from", low, openHigh ? "below " : "", high,
                           ending);
    }
    if (hasLow)
        return fmt::format("{} {} {}{}{}", what, openLow ? "above" : "of", low, ending, openLow ? "" : " or more");
    if (hasHigh)
        return fmt::format("{} {} {}{}{}", what, openHigh ? "below" : "of", high, ending, openHigh ? "" : " or less");
    return what;
}

std::string AcceptedText::text() const {
    std::string text = mayBeEmpty ? "a text" : "a text that is not empty";
    return mostBytes == AcceptedText{}.mostBytes ? text : fmt::format("{}, of at most {} bytes,", text, mostBytes);
}

const FieldInfo* FieldInfo::find(std::string_view memberKey) const noexcept {
    const auto found = std::ranges::find(members, memberKey, &FieldInfo::key);
    return found == members.end() ? nullptr : &*found;
}

std::string RecordPlace::text() const {
    return file.empty() ? path : path.empty() ? file : fmt::format("{}: {}", file, path);
}

RecordPlace RecordPlace::in(std::string_view key) const {
    return {file, path.empty() ? std::string(key) : fmt::format("{}.{}", path, key), lenient};
}

tl::unexpected<Error> RecordPlace::refuse(ErrorCode code, std::string_view key, std::string_view shown,
                                          std::string_view accepted) const {
    return refuse(Error{code, fmt::format("\"{}\" is {}; {} was expected", key, shown, accepted)});
}

tl::unexpected<Error> RecordPlace::refuse(Error error) const {
    if (const auto where = text(); !where.empty()) error.message = fmt::format("{}: {}", where, error.message);
    return tl::unexpected<Error>(std::move(error));
}

namespace {

tl::unexpected<Error> refuseNumber(const std::string& shown, const AcceptedNumbers& accepted, const RecordPlace& place,
                                   std::string_view key) {
    return place.refuse(ErrorCode::InvalidArgument, key,
                        accepted.unit.empty() ? shown : fmt::format("{} {}", shown, accepted.unit), accepted.text());
}

}  // namespace

Result<double> readNumber(const json& value, const AcceptedNumbers& accepted, const RecordPlace& place,
                          std::string_view key) {
    const double number = value.is_number() ? value.get<double>() : 0;
    if (!value.is_number() || (accepted.whole && number != std::floor(number)))
        return place.refuse(ErrorCode::ParseError, key, shownJson(value), accepted.text());
    if (accepted.contain(number)) return number;
    return refuseNumber(value.is_number_integer() ? dumpJson(value) : fmt::format("{}", number), accepted, place, key);
}

Result<void> checkNumber(double value, const AcceptedNumbers& accepted, const RecordPlace& place,
                         std::string_view key) {
    if (accepted.contain(value)) return {};
    return refuseNumber(fmt::format("{}", value), accepted, place, key);
}

ValueKind<std::string> textKind(const AcceptedText& accepted) {
    const auto fits = [accepted](const std::string& text) {
        return (accepted.mayBeEmpty || !text.empty()) && text.size() <= accepted.mostBytes;
    };
    auto kind = codedKind<std::string>(
        accepted.text(),
        [fits](const json& value) {
            const auto* text = value.get_ptr<const std::string*>();
            return text != nullptr && fits(*text) ? std::optional(*text) : std::nullopt;
        },
        [](const std::string& text) { return json(text); });
    kind.check = [fits, accepted](const std::string& text, const RecordPlace& place,
                                  std::string_view key) -> Result<void> {
        if (fits(text)) return {};
        return place.refuse(ErrorCode::InvalidArgument, key, shownJson(text), accepted.text());
    };
    return kind;
}

ValueKind<bool> flagKind() {
    return codedKind<bool>(
        "true or false",
        [](const json& value) { return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt; },
        [](const bool& flag) { return json(flag); });
}

std::string listedWords(const std::vector<std::string_view>& words) {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i)
        all += fmt::format("{}{}", i == 0 ? "" : i + 1 < words.size() ? ", " : " or ", words[i]);
    return all;
}

}  // namespace tacto
