// ValueKind.h - how the values of a field stand in JSON, and which are accepted: numbers, texts, words, flags.
//
// A value that is not accepted is refused with its place and what was expected, NaN and the infinities among it;
// nothing is clamped.
//
// Thread-safety: a kind is constant once it is built; reading, writing and checking are pure. No exception whatever the
// JSON.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/JsonText.h"
#include "core/base/Result.h"
#include "core/base/Words.h"

namespace tacto {

/// The numbers that a field accepts. NaN and the infinities are never among them.
struct AcceptedNumbers {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
    bool openLow = false;   ///< `low` itself is not accepted
    bool openHigh = false;  ///< `high` itself is not accepted
    bool whole = false;     ///< fractions are not accepted
    std::string_view unit{};

    [[nodiscard]] bool contain(double value) const noexcept;
    /// "a number above 0 to 60 s".
    [[nodiscard]] std::string text() const;
};

struct AcceptedText {
    bool mayBeEmpty = false;
    std::size_t mostBytes = std::numeric_limits<std::size_t>::max();
    [[nodiscard]] std::string text() const;
};

/// What is known of a field whatever its type: what a form needs.
struct FieldInfo {
    std::string key{};
    std::string accepted{};                    ///< "a number from 0.01 to 500 V", for messages
    std::optional<AcceptedNumbers> numbers{};  ///< where the field is a number
    std::vector<std::string_view> words{};     ///< where it is one of these
    std::vector<FieldInfo> members{};          ///< where it is a record
    bool required = false;                     ///< the key must be there
    bool mayBeNull = false;                    ///< null stands for none; true for a std::optional
    bool leftOutIfEmpty = false;               ///< not written when there is none, instead of null

    /// The member of that key. Null when there is none.
    [[nodiscard]] const FieldInfo* find(std::string_view memberKey) const noexcept;
};

/// Where a record stands, for messages.
struct RecordPlace {
    std::string file{};    ///< begins every message; may be empty
    std::string path{};    ///< in the file: "limits[2]", "roughness.references"
    bool lenient = false;  ///< passes over what cannot be read: rows of a damaged file are read too

    [[nodiscard]] std::string text() const;
    [[nodiscard]] RecordPlace in(std::string_view key) const;
    /// `lab.json: limits[2]: "max" is -1; a number above 0 was expected`.
    [[nodiscard]] tl::unexpected<Error> refuse(ErrorCode code, std::string_view key, std::string_view shown,
                                               std::string_view accepted) const;
    /// `error`, with the place in front of its message.
    [[nodiscard]] tl::unexpected<Error> refuse(Error error) const;
};

/// How the values of a type stand in JSON.
template <class T>
struct ValueKind {
    FieldInfo info{};  ///< all but the key
    /// Errors: ParseError for another type of value, InvalidArgument for one that is not accepted.
    std::function<Result<void>(const nlohmann::json&, T& into, const RecordPlace&, std::string_view key)> read{};
    std::function<nlohmann::json(const T&)> write{};
    std::function<Result<void>(const T&, const RecordPlace&, std::string_view key)> check{};  ///< empty: any value
};

/// The number in `value`. Errors: as of ValueKind::read().
[[nodiscard]] Result<double> readNumber(const nlohmann::json& value, const AcceptedNumbers& accepted,
                                        const RecordPlace& place, std::string_view key);
[[nodiscard]] Result<void> checkNumber(double value, const AcceptedNumbers& accepted, const RecordPlace& place,
                                       std::string_view key);
[[nodiscard]] ValueKind<std::string> textKind(const AcceptedText& accepted = {});
[[nodiscard]] ValueKind<bool> flagKind();

/// `from` gives nothing for JSON that is not accepted.
template <class T>
[[nodiscard]] ValueKind<T> codedKind(std::string accepted, std::function<std::optional<T>(const nlohmann::json&)> from,
                                     std::function<nlohmann::json(const T&)> to) {
    ValueKind<T> kind{.info = {.accepted = std::move(accepted)}, .write = std::move(to)};
    kind.read = [what = kind.info.accepted, from](const nlohmann::json& value, T& into, const RecordPlace& place,
                                                  std::string_view key) -> Result<void> {
        auto found = from(value);
        if (!found) return place.refuse(ErrorCode::ParseError, key, shownJson(value), what);
        into = *std::move(found);
        return {};
    };
    return kind;
}

/// A bare number, a unit type or a duration.
template <class T>
[[nodiscard]] double plainNumber(const T& value) noexcept {
    if constexpr (requires { value.count(); })
        return value.count();
    else if constexpr (requires { value.value(); })
        return value.value();
    else
        return static_cast<double>(value);
}

/// Whether T holds this whole number: a script hands on every number as a double, a file may have more digits than one.
template <class T>
[[nodiscard]] bool holdsWhole(const nlohmann::json& value) {
    if (value.is_number_unsigned()) return std::in_range<T>(value.get<std::uint64_t>());
    if (value.is_number_integer()) return std::in_range<T>(value.get<std::int64_t>());
    return value.get<double>() < std::ldexp(1.0, std::numeric_limits<T>::digits);
}

/// What is not finite is written as null.
template <class T>
[[nodiscard]] ValueKind<T> numberKind(AcceptedNumbers accepted) {
    if constexpr (std::is_integral_v<T>) {
        accepted.whole = true;
        accepted.low = std::max(accepted.low, static_cast<double>(std::numeric_limits<T>::lowest()));
        accepted.high = std::min(accepted.high, static_cast<double>(std::numeric_limits<T>::max()));
    }
    ValueKind<T> kind{.info = {.accepted = accepted.text(), .numbers = accepted}};
    kind.read = [accepted](const nlohmann::json& value, T& into, const RecordPlace& place,
                           std::string_view key) -> Result<void> {
        const auto number = readNumber(value, accepted, place, key);
        if (!number) return failure(number);
        if constexpr (std::is_integral_v<T>) {
            if (!holdsWhole<T>(value))
                return place.refuse(ErrorCode::InvalidArgument, key, shownJson(value), accepted.text());
            into = value.is_number_integer() ? value.get<T>() : static_cast<T>(*number);
        } else {
            into = T(*number);
        }
        return {};
    };
    kind.write = [](const T& value) -> nlohmann::json {
        if constexpr (std::is_integral_v<T>)
            return value;
        else
            return std::isfinite(plainNumber(value)) ? nlohmann::json(plainNumber(value)) : nlohmann::json();
    };
    kind.check = [accepted](const T& value, const RecordPlace& place, std::string_view key) {
        return checkNumber(plainNumber(value), accepted, place, key);
    };
    return kind;
}

/// "a, b or c".
[[nodiscard]] std::string listedWords(const std::vector<std::string_view>& words);

/// `words` must outlive the kind.
template <class T>
[[nodiscard]] ValueKind<T> wordKind(Words<T> words) {
    FieldInfo info;
    for (const auto& word : words) info.words.push_back(word.text);
    info.accepted = listedWords(info.words);
    ValueKind<T> kind = codedKind<T>(
        info.accepted,
        [words](const nlohmann::json& value) -> std::optional<T> {
            for (const auto& word : words) {
                if (value == word.text) return word.value;
            }
            return std::nullopt;
        },
        [words](const T& value) -> nlohmann::json { return wordFor(words, value); });
    kind.check = [words, what = info.accepted](const T& value, const RecordPlace& place,
                                               std::string_view key) -> Result<void> {
        for (const auto& word : words) {
            if (word.value == value) return {};
        }
        return place.refuse(ErrorCode::InvalidArgument, key, "no known value", what);
    };
    kind.info = std::move(info);
    return kind;
}

}  // namespace tacto
