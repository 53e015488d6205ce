// RecordFields.h - the fields of a stored record, each described once: its key, its unit, what it accepts, its member.
//
// Reading, writing and checking derive from the table, and so does the form that edits the record:
//
//   RecordFields<Contact> contactFields() {
//       RecordFields<Contact> all;
//       all.number("area_cm2", &Contact::area, {.low = 0, .openLow = true, .unit = "cm²"}).required = true;
//       all.word("material", &Contact::material, kMaterials);
//       return all;
//   }
//
// A key that is missing keeps what the member holds, unless it is required. Keys that the table does not know are
// refused, and so is what a field does not accept (ValueKind.h).
//
// Thread-safety: a table is constant once it is built; reading, writing and checking are pure. No exception whatever
// the JSON.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/ValueKind.h"

namespace tacto {

/// The member `inner` of the member `outer`, as the member of a field.
template <class Outer, class Inner>
[[nodiscard]] auto in(Outer outer, Inner inner) {
    return [=](auto& record) -> auto& { return std::invoke(inner, std::invoke(outer, record)); };
}

template <class Record>
class RecordFields {
    template <class T>
    struct Bare {
        using Type = T;
    };
    template <class T>
    struct Bare<std::optional<T>> {
        using Type = T;
    };
    template <class Member>
    using Held = std::remove_cvref_t<std::invoke_result_t<Member, Record&>>;
    /// What a member holds; where it is a std::optional, what that holds.
    template <class Member>
    using ValueOf = typename Bare<Held<Member>>::Type;

public:
    // `member` is a pointer to a member, in() for a member of a member, or std::identity for fields of the record
    // itself that stand in an object of their own. What is returned may be changed until the next field is added.

    template <class Member>
    FieldInfo& number(std::string_view key, Member member, const AcceptedNumbers& accepted = {}) {
        return add(key, member, numberKind<ValueOf<Member>>(accepted));
    }
    template <class Member>
    FieldInfo& text(std::string_view key, Member member, const AcceptedText& accepted = {}) {
        return add(key, member, textKind(accepted));
    }
    void texts(std::initializer_list<std::pair<std::string_view, std::string Record::*>> all,
               const AcceptedText& accepted = {}) {
        for (const auto& [key, member] : all) text(key, member, accepted);
    }
    template <class Member>
    FieldInfo& flag(std::string_view key, Member member) {
        return add(key, member, flagKind());
    }
    template <class Member>
    FieldInfo& word(std::string_view key, Member member, Words<ValueOf<Member>> words) {
        return add(key, member, wordKind(words));
    }
    template <class Member>
    FieldInfo& record(std::string_view key, Member member, const RecordFields<ValueOf<Member>>& fields) {
        return add(key, member, fields.kind());
    }
    /// A list of `least` to `most` values.
    template <class Member>
    FieldInfo& list(std::string_view key, Member member, const ValueKind<typename ValueOf<Member>::value_type>& each,
                    std::size_t least, std::size_t most);
    template <class Member>
    FieldInfo& add(std::string_view key, Member member, ValueKind<ValueOf<Member>> kind);

    /// A text for people who read the file. It is kept by no member.
    void note(std::string_view key, const AcceptedText& accepted = {});
    /// What must hold between fields; checked after each field by itself.
    void rule(std::function<Result<void>(const Record&)> holds) { rules_.push_back(std::move(holds)); }
    /// The record is written as null where `absent` says so.
    void absentWhere(std::function<bool(const Record&)> absent) { absent_ = std::move(absent); }
    /// Null stands for a missing key: what a script hands on.
    void takeNullAsMissing() { nullIsMissing_ = true; }
    /// Keys that the table does not know are notes.
    void passOverUnknownKeys() { passOver_ = true; }

    /// Errors: ParseError naming an unknown or missing key or a value of another type; InvalidArgument naming a value
    /// that is not accepted; as the rules. `into` may hold a part of it then.
    [[nodiscard]] Result<void> read(const nlohmann::json& object, Record& into, const RecordPlace& place) const;
    /// A new record. Errors: as read().
    [[nodiscard]] Result<Record> read(const nlohmann::json& object, const RecordPlace& place) const {
        Record record{};
        if (auto done = read(object, record, place); !done) return failure(done);
        return record;
    }
    [[nodiscard]] nlohmann::json write(const Record& record) const;
    /// Errors: InvalidArgument naming the first value that is not accepted; as the rules.
    [[nodiscard]] Result<void> check(const Record& record, const RecordPlace& place) const;

    [[nodiscard]] std::vector<FieldInfo> infos() const { return {fields_.begin(), fields_.end()}; }
    [[nodiscard]] ValueKind<Record> kind() const;

private:
    struct Field : FieldInfo {
        std::function<Result<void>(const nlohmann::json&, Record&, const RecordPlace&)> read;
        std::function<void(Record&)> clear;
        std::function<nlohmann::json(const Record&)> write;
        std::function<Result<void>(const Record&, const RecordPlace&)> check;
    };
    [[nodiscard]] Result<void> checkRules(const Record& record, const RecordPlace& place) const;

    std::vector<Field> fields_;
    std::vector<std::function<Result<void>(const Record&)>> rules_;
    std::function<bool(const Record&)> absent_;
    bool nullIsMissing_ = false;
    bool passOver_ = false;
};

template <class Record>
template <class Member>
FieldInfo& RecordFields<Record>::add(std::string_view key, Member member, ValueKind<ValueOf<Member>> kind) {
    constexpr bool kOptional = !std::is_same_v<Held<Member>, ValueOf<Member>>;
    Field field{std::move(kind.info), {}, {}, {}, {}};
    field.key = key;
    field.mayBeNull = kOptional;
    field.read = [member, read = std::move(kind.read), name = field.key](const nlohmann::json& value, Record& into,
                                                                         const RecordPlace& place) -> Result<void> {
        auto& held = std::invoke(member, into);
        if constexpr (kOptional)
            return read(value, held.emplace(), place, name);
        else
            return read(value, held, place, name);
    };
    field.clear = [member](Record& into) {
        if constexpr (kOptional) std::invoke(member, into).reset();
    };
    field.write = [member, write = std::move(kind.write)](const Record& record) -> nlohmann::json {
        const auto& held = std::invoke(member, record);
        if constexpr (kOptional)
            return held ? write(*held) : nlohmann::json();
        else
            return write(held);
    };
    if (kind.check) {
        field.check = [member, check = std::move(kind.check), name = field.key](
                          const Record& record, const RecordPlace& place) -> Result<void> {
            const auto& held = std::invoke(member, record);
            if constexpr (kOptional)
                return held ? check(*held, place, name) : Result<void>();
            else
                return check(held, place, name);
        };
    }
    return fields_.emplace_back(std::move(field));
}

template <class Record>
template <class Member>
FieldInfo& RecordFields<Record>::list(std::string_view key, Member member,
                                      const ValueKind<typename ValueOf<Member>::value_type>& each, std::size_t least,
                                      std::size_t most) {
    using List = ValueOf<Member>;
    const auto nameOf = [](std::string_view list, std::size_t i) { return fmt::format("{}[{}]", list, i); };
    ValueKind<List> kind;
    kind.info.accepted = fmt::format("a list of {} to {} entries", least, most);
    kind.read = [=, what = kind.info.accepted](const nlohmann::json& value, List& into, const RecordPlace& place,
                                               std::string_view name) -> Result<void> {
        if (!value.is_array() || value.size() < least || value.size() > most)
            return place.refuse(ErrorCode::ParseError, name, shownJson(value), what);
        into.clear();
        for (std::size_t i = 0; i < value.size(); ++i) {
            auto& entry = into.emplace_back();
            if (auto done = each.read(value[i], entry, place, nameOf(name, i)); !done && !place.lenient) return done;
        }
        return {};
    };
    kind.write = [each](const List& values) {
        auto out = nlohmann::json::array();
        for (const auto& value : values) out.push_back(each.write(value));
        return out;
    };
    kind.check = [=, what = kind.info.accepted](const List& values, const RecordPlace& place,
                                                std::string_view name) -> Result<void> {
        if (values.size() < least || values.size() > most)
            return place.refuse(ErrorCode::InvalidArgument, name, fmt::format("a list of {}", values.size()), what);
        for (std::size_t i = 0; each.check && i < values.size(); ++i) {
            if (auto sound = each.check(values[i], place, nameOf(name, i)); !sound) return sound;
        }
        return {};
    };
    return add(key, member, std::move(kind));
}

template <class Record>
void RecordFields<Record>::note(std::string_view key, const AcceptedText& accepted) {
    ValueKind<Record> kind;
    kind.read = [text = textKind(accepted)](const nlohmann::json& value, Record&, const RecordPlace& place,
                                            std::string_view name) {
        std::string read;
        return text.read(value, read, place, name);
    };
    kind.write = [](const Record&) { return nlohmann::json(); };
    add(key, std::identity{}, std::move(kind)).leftOutIfEmpty = true;
}

template <class Record>
Result<void> RecordFields<Record>::read(const nlohmann::json& object, Record& into, const RecordPlace& place) const {
    std::vector<std::string_view> keys;
    for (const auto& field : fields_) keys.push_back(field.key);
    const auto known = passOver_ ? expectObject(object, place.text()) : onlyKeys(object, keys, place.text());
    if (!known && !place.lenient) return known;
    for (const auto& field : fields_) {
        const auto found = object.find(field.key);
        Result<void> done;
        const bool isNull = found != object.end() && found->is_null();
        const bool isThere = found != object.end() && !(isNull && nullIsMissing_);
        if (isNull && field.mayBeNull && !field.leftOutIfEmpty)
            field.clear(into);
        else if (field.required && (!isThere || isNull))
            done = place.refuse(ErrorCode::ParseError, field.key, "missing", field.accepted);
        else if (isThere)
            done = field.read(*found, into, place);
        if (!done && !place.lenient) return done;
    }
    return place.lenient ? Result<void>() : checkRules(into, place);
}

template <class Record>
nlohmann::json RecordFields<Record>::write(const Record& record) const {
    if (absent_ && absent_(record)) return nullptr;
    auto out = nlohmann::json::object();
    for (const auto& field : fields_) {
        auto value = field.write(record);
        if (!field.leftOutIfEmpty || !value.empty()) out[field.key] = std::move(value);
    }
    return out;
}

template <class Record>
Result<void> RecordFields<Record>::check(const Record& record, const RecordPlace& place) const {
    for (const auto& field : fields_) {
        if (!field.check) continue;
        if (auto sound = field.check(record, place); !sound) return sound;
    }
    return checkRules(record, place);
}

template <class Record>
Result<void> RecordFields<Record>::checkRules(const Record& record, const RecordPlace& place) const {
    for (const auto& holds : rules_) {
        if (auto sound = holds(record); !sound) return place.refuse(std::move(sound.error()));
    }
    return {};
}

template <class Record>
ValueKind<Record> RecordFields<Record>::kind() const {
    ValueKind<Record> kind;
    kind.info = {.key = {}, .accepted = "an object", .members = infos()};
    kind.read = [fields = *this](const nlohmann::json& value, Record& into, const RecordPlace& place,
                                 std::string_view key) { return fields.read(value, into, place.in(key)); };
    kind.write = [fields = *this](const Record& record) { return fields.write(record); };
    kind.check = [fields = *this](const Record& record, const RecordPlace& place, std::string_view key) {
        return fields.check(record, place.in(key));
    };
    return kind;
}

/// A record that stands in the file as a `Stored`.
template <class Record, class Stored>
[[nodiscard]] ValueKind<Record> storedAs(const RecordFields<Stored>& fields,
                                         std::function<Record(const Stored&)> fromStored,
                                         std::function<Stored(const Record&)> toStored) {
    const auto stored = fields.kind();
    ValueKind<Record> kind{.info = stored.info};
    kind.read = [stored, fromStored](const nlohmann::json& value, Record& into, const RecordPlace& place,
                                     std::string_view key) -> Result<void> {
        Stored read{};
        if (auto done = stored.read(value, read, place, key); !done) return done;
        into = fromStored(read);
        return {};
    };
    kind.write = [stored, toStored](const Record& record) { return stored.write(toStored(record)); };
    kind.check = [stored, toStored](const Record& record, const RecordPlace& place, std::string_view key) {
        return stored.check(toStored(record), place, key);
    };
    return kind;
}

}  // namespace tacto
