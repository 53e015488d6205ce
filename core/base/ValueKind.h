// ValueKind.h - how values of fields are stored in JSON, and which are accepted: numbers, texts, words, flags.
//
// A value that is not accepted, such as NaN or an infinity, is refused with its place and what was expected; no value
// is clamped.
//
// Thread-safety: a kind is constant once it is built; reading, writing and checking are pure. No JSON causes an
// exception.
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

/// The numbers that a field accepts, never NaN or an infinity.
struct AcceptedNumbers {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
    bool openLow = false;   ///< `low` itself is not accepted
    bool openHigh = false;  ///< `high` itself is not accepted
    bool whole = false;     ///< fractions are not accepted
    std::string_view unit{};

    [[nodiscard]] bool contain(double value) const noexcept;
    /// Returns a text such as "a number above 0 to 60 s".
    [[nodiscard]] std::string text() const;
};

struct AcceptedText {
    bool mayBeEmpty = false;
    std::size_t mostBytes = std::numeric_limits<std::size_t>::max();
    [[nodiscard]] std::string text() const;
};

/// The description of a field of any type, for a form.
struct FieldInfo {
    std::string key{};
    std::string accepted{};                    ///< "a number from 0.01 to 500 V", for messages
    std::optional<AcceptedNumbers> numbers{};  ///< set if the field is a number
    std::vector<std::string_view> words{};     ///< the accepted words, if the field is one of several words
    std::vector<FieldInfo> members{};          ///< the fields of the record, if the field is a record
    bool required = false;                     ///< the key must exist
    bool mayBeNull = false;                    ///< null stands for "none"; true for a std::optional
    bool leftOutIfEmpty = false;               ///< an empty value is left out, not written as null

    /// Returns the member with that key; null if there is none.
    [[nodiscard]] const FieldInfo* find(std::string_view memberKey) const noexcept;
};

/// The place of a record, for messages.
struct RecordPlace {
    std::string file{};    ///< begins every message; may be empty
    std::string path{};    ///< the place in the file: "limits[2]", "roughness.references"
    bool lenient = false;  ///< skips what cannot be read, so that damaged files can be read

    [[nodiscard]] std::string text() const;
    [[nodiscard]] RecordPlace in(std::string_view key) const;
    /// Returns the error `lab.json: limits[2]: "max" is -1; a number above 0 was expected`.
    [[nodiscard]] tl::unexpected<Error> refuse(ErrorCode code, std::string_view key, std::string_view shown,
                                               std::string_view accepted) const;
    /// Puts the place in front of the message of `error`.
    [[nodiscard]] tl::unexpected<Error> refuse(Error error) const;
};

/// How the values of a type are stored in JSON, for code that does not know the type: `into` and `held` are addresses
/// of a value. Compiled once: a template took a third of the compile time and code size of layers that store records.
struct AnyKind {
    FieldInfo info{};  ///< the description of the field, without its key
    std::function<Result<void>(const nlohmann::json&, void* into, const RecordPlace&, std::string_view key)> readInto{};
    std::function<nlohmann::json(const void* held)> writeFrom{};
    /// Empty: every value is accepted.
    std::function<Result<void>(const void* held, const RecordPlace&, std::string_view key)> checkOf{};
};

/// The kind of a known type T.
template <class T>
struct ValueKind : AnyKind {
    ValueKind() = default;
    explicit ValueKind(AnyKind kind) : AnyKind(std::move(kind)) {}

    /// Errors: ParseError for another type of value, InvalidArgument for a value that is not accepted.
    [[nodiscard]] Result<void> read(const nlohmann::json& value, T& into, const RecordPlace& place,
                                    std::string_view key) const {
        return readInto(value, &into, place, key);
    }
    [[nodiscard]] nlohmann::json write(const T& held) const { return writeFrom(&held); }
    [[nodiscard]] Result<void> check(const T& held, const RecordPlace& place, std::string_view key) const {
        return checkOf ? checkOf(&held, place, key) : Result<void>();
    }

    /// `how` gets the arguments of read().
    template <class How>
    void reads(How how) {
        readInto = [how = std::move(how)](const nlohmann::json& value, void* into, const RecordPlace& place,
                                          std::string_view key) -> Result<void> {
            return how(value, *static_cast<T*>(into), place, key);
        };
    }
    template <class How>
    void writes(How how) {
        writeFrom = [how = std::move(how)](const void* held) -> nlohmann::json {
            return how(*static_cast<const T*>(held));
        };
    }
    template <class How>
    void checks(How how) {
        checkOf = [how = std::move(how)](const void* held, const RecordPlace& place,
                                         std::string_view key) -> Result<void> {
            return how(*static_cast<const T*>(held), place, key);
        };
    }
};

/// Reads the number in `value`. Errors: as ValueKind::read().
[[nodiscard]] Result<double> readNumber(const nlohmann::json& value, const AcceptedNumbers& accepted,
                                        const RecordPlace& place, std::string_view key);
[[nodiscard]] Result<void> checkNumber(double value, const AcceptedNumbers& accepted, const RecordPlace& place,
                                       std::string_view key);
[[nodiscard]] ValueKind<std::string> textKind(const AcceptedText& accepted = {});
[[nodiscard]] ValueKind<bool> flagKind();

/// `from(json)` returns a std::optional<T>, empty for JSON that is not accepted; `to(value)` returns JSON.
template <class T, class From, class To>
[[nodiscard]] ValueKind<T> codedKind(const std::string& accepted, From from, To to) {
    ValueKind<T> kind;
    kind.info.accepted = accepted;
    kind.reads([what = kind.info.accepted, from](const nlohmann::json& value, T& into, const RecordPlace& place,
                                                 std::string_view key) -> Result<void> {
        std::optional<T> found = from(value);
        if (!found) return place.refuse(ErrorCode::ParseError, key, shownJson(value), what);
        into = *std::move(found);
        return {};
    });
    kind.writes(std::move(to));
    return kind;
}

/// Converts a bare number, a unit type or a duration to double.
template <class T>
[[nodiscard]] double plainNumber(const T& value) noexcept {
    if constexpr (requires { value.count(); })
        return value.count();
    else if constexpr (requires { value.value(); })
        return value.value();
    else
        return static_cast<double>(value);
}

/// Whether T can hold this whole number: scripts pass every number as a double, and files may have more digits.
template <class T>
[[nodiscard]] bool holdsWhole(const nlohmann::json& value) {
    if (value.is_number_unsigned()) return std::in_range<T>(value.get<std::uint64_t>());
    if (value.is_number_integer()) return std::in_range<T>(value.get<std::int64_t>());
    return value.get<double>() < std::ldexp(1.0, std::numeric_limits<T>::digits);
}

/// Access to a number of some type.
struct NumberAccess {
    double (*get)(const void*);
    /// Returns false if the type cannot hold the whole number `value`; `number` is the same as a double.
    bool (*set)(void*, const nlohmann::json& value, double number);
    nlohmann::json (*write)(const void*);  ///< exact to the last digit; null: writes the result of get()
};
[[nodiscard]] AnyKind numberKindOf(const AcceptedNumbers& accepted, const NumberAccess& access);

/// Writes a value that is not finite as null.
template <class T>
[[nodiscard]] ValueKind<T> numberKind(AcceptedNumbers accepted) {
    NumberAccess access{[](const void* held) { return plainNumber(*static_cast<const T*>(held)); },
                        [](void* into, const nlohmann::json&, double number) {
                            *static_cast<T*>(into) = T(number);
                            return true;
                        },
                        nullptr};
    if constexpr (std::is_integral_v<T>) {
        accepted.whole = true;
        accepted.low = std::max(accepted.low, static_cast<double>(std::numeric_limits<T>::lowest()));
        accepted.high = std::min(accepted.high, static_cast<double>(std::numeric_limits<T>::max()));
        access.set = [](void* into, const nlohmann::json& value, double number) {
            if (!holdsWhole<T>(value)) return false;
            *static_cast<T*>(into) = value.is_number_integer() ? value.get<T>() : static_cast<T>(number);
            return true;
        };
        access.write = [](const void* held) { return nlohmann::json(*static_cast<const T*>(held)); };
    }
    return ValueKind<T>(numberKindOf(accepted, access));
}

/// Returns "a, b or c".
[[nodiscard]] std::string listedWords(const std::vector<std::string_view>& words);

/// Access to a value that is one of several words.
struct WordAccess {
    std::function<std::size_t(const void*)> find;  ///< index of the value's word; beyond the last: no word
    std::function<void(void*, std::size_t)> set;
};
[[nodiscard]] AnyKind wordKindOf(const std::vector<std::string_view>& words, WordAccess access);

/// `words` must outlive the kind.
template <class T>
[[nodiscard]] ValueKind<T> wordKind(Words<T> words) {
    std::vector<std::string_view> texts;
    for (const auto& word : words) texts.push_back(word.text);
    const auto find = [words](const void* held) {
        std::size_t i = 0;
        while (i < words.size() && words[i].value != *static_cast<const T*>(held)) ++i;
        return i;
    };
    const auto set = [words](void* into, std::size_t i) { *static_cast<T*>(into) = words[i].value; };
    return ValueKind<T>(wordKindOf(texts, {find, set}));
}

/// Access to a list of some type.
struct ListAccess {
    std::size_t (*size)(const void*);
    const void* (*at)(const void*, std::size_t);
    void (*clear)(void*);
    void* (*append)(void*);  ///< appends an empty entry and returns its address
};
[[nodiscard]] AnyKind listKindOf(AnyKind each, std::size_t least, std::size_t most, const ListAccess& access);

/// A list with `least` to `most` values.
template <class List>
[[nodiscard]] ValueKind<List> listKind(const ValueKind<typename List::value_type>& each, std::size_t least,
                                       std::size_t most) {
    return ValueKind<List>(listKindOf(
        each, least, most,
        {[](const void* list) { return static_cast<const List*>(list)->size(); },
         [](const void* list, std::size_t i) -> const void* { return &(*static_cast<const List*>(list))[i]; },
         [](void* list) { static_cast<List*>(list)->clear(); },
         [](void* list) -> void* { return &static_cast<List*>(list)->emplace_back(); }}));
}

}  // namespace tacto
