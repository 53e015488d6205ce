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
    kind.checks(
        [fits, accepted](const std::string& text, const RecordPlace& place, std::string_view key) -> Result<void> {
            if (fits(text)) return {};
            return place.refuse(ErrorCode::InvalidArgument, key, shownJson(text), accepted.text());
        });
    return kind;
}

ValueKind<bool> flagKind() {
    return codedKind<bool>(
        "true or false",
        [](const json& value) { return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt; },
        [](bool flag) { return json(flag); });
}

AnyKind numberKindOf(const AcceptedNumbers& accepted, const NumberAccess& access) {
    AnyKind kind{.info = {.accepted = accepted.text(), .numbers = accepted}};
    kind.readInto = [accepted, access](const json& value, void* into, const RecordPlace& place,
                                       std::string_view key) -> Result<void> {
        const auto number = readNumber(value, accepted, place, key);
        if (!number) return failure(number);
        if (access.set(into, value, *number)) return {};
        return place.refuse(ErrorCode::InvalidArgument, key, shownJson(value), accepted.text());
    };
    kind.writeFrom = [access](const void* held) {
        if (access.write != nullptr) return access.write(held);
        const double number = access.get(held);
        return std::isfinite(number) ? json(number) : json();
    };
    kind.checkOf = [accepted, access](const void* held, const RecordPlace& place, std::string_view key) {
        return checkNumber(access.get(held), accepted, place, key);
    };
    return kind;
}

std::string listedWords(const std::vector<std::string_view>& words) {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i)
        all += fmt::format("{}{}", i == 0 ? "" : i + 1 < words.size() ? ", " : " or ", words[i]);
    return all;
}

AnyKind wordKindOf(const std::vector<std::string_view>& words, WordAccess access) {
    const auto accepted = listedWords(words);
    AnyKind kind{.info = {.accepted = accepted, .words = words}};
    kind.readInto = [words, accepted, set = std::move(access.set)](
                        const json& value, void* into, const RecordPlace& place, std::string_view key) -> Result<void> {
        const auto found = std::ranges::find_if(words, [&](std::string_view word) { return value == word; });
        if (found == words.end()) return place.refuse(ErrorCode::ParseError, key, shownJson(value), accepted);
        set(into, static_cast<std::size_t>(found - words.begin()));
        return {};
    };
    kind.writeFrom = [words, find = access.find](const void* held) {
        const auto i = find(held);
        return json(i < words.size() ? words[i] : kNoWord);
    };
    kind.checkOf = [count = words.size(), accepted, find = access.find](const void* held, const RecordPlace& place,
                                                                        std::string_view key) -> Result<void> {
        if (find(held) < count) return {};
        return place.refuse(ErrorCode::InvalidArgument, key, "no known value", accepted);
    };
    return kind;
}

AnyKind listKindOf(AnyKind each, std::size_t least, std::size_t most, const ListAccess& access) {
    const auto nameOf = [](std::string_view list, std::size_t i) { return fmt::format("{}[{}]", list, i); };
    AnyKind kind{.info = {.accepted = fmt::format("a list of {} to {} entries", least, most)}};
    kind.readInto = [=, what = kind.info.accepted, read = std::move(each.readInto)](
                        const json& value, void* into, const RecordPlace& place,
                        std::string_view name) -> Result<void> {
        if (!value.is_array() || value.size() < least || value.size() > most)
            return place.refuse(ErrorCode::ParseError, name, shownJson(value), what);
        access.clear(into);
        for (std::size_t i = 0; i < value.size(); ++i) {
            auto done = read(value[i], access.append(into), place, nameOf(name, i));
            if (!done && !place.lenient) return done;
        }
        return {};
    };
    kind.writeFrom = [access, write = std::move(each.writeFrom)](const void* list) {
        auto out = json::array();
        for (std::size_t i = 0; i < access.size(list); ++i) out.push_back(write(access.at(list, i)));
        return out;
    };
    kind.checkOf = [=, what = kind.info.accepted, check = std::move(each.checkOf)](
                       const void* list, const RecordPlace& place, std::string_view name) -> Result<void> {
        const auto count = access.size(list);
        if (count < least || count > most)
            return place.refuse(ErrorCode::InvalidArgument, name, fmt::format("a list of {}", count), what);
        for (std::size_t i = 0; check && i < count; ++i) {
            if (auto sound = check(access.at(list, i), place, nameOf(name, i)); !sound) return sound;
        }
        return {};
    };
    return kind;
}

}  // namespace tacto
