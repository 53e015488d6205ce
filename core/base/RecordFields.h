// RecordFields.h - describes each field of a stored record once: its key, unit, accepted values and member.
//
// Reading, writing, checking and the form that edits the record all use this table:
//
//   RecordFields<Contact> contactFields() {
//       RecordFields<Contact> all;
//       all.number("area_cm2", &Contact::area, {.low = 0, .openLow = true, .unit = "cm²"}).required = true;
//       all.word("material", &Contact::material, kMaterials);
//       return all;
//   }
//
// A member keeps its value if its key is missing, unless the key is required. Unknown keys are refused, and so are
// values that a field does not accept (ValueKind.h).
//
// Thread-safety: a table is constant once it is built; reading, writing and checking are pure. No JSON causes an
// exception.
#pragma once

#include <cassert>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/JsonText.h"
#include "core/base/ValueKind.h"

namespace tacto {

// What RecordFields does with a record, for code that does not know the record's type: records are given by address,
// members by their offset in the record.

class RecordTable {
public:
    /// Access to a member that is a std::optional.
    struct OptionalAccess {
        const void* (*get)(const void*);  ///< returns null if there is no value
        void* (*emplace)(void*);
        void (*reset)(void*);
    };
    using Rule = std::function<Result<void>(const void* record)>;

    /// Adds a field whose member lies `offset` bytes into the record. The returned field may be changed until the next
    /// field is added. `optional`: for a std::optional member; must stay valid forever.
    FieldInfo& add(std::string_view key, std::size_t offset, AnyKind kind, const OptionalAccess* optional = nullptr);
    void note(std::string_view key, const AcceptedText& accepted);
    void rule(Rule holds) { rules_.push_back(std::move(holds)); }
    void absentWhere(std::function<bool(const void* record)> absent) { absent_ = std::move(absent); }
    void takeNullAsMissing() { nullIsMissing_ = true; }
    void passOverUnknownKeys() { passOver_ = true; }

    /// These functions do what the same functions of RecordFields do.
    [[nodiscard]] Result<void> read(const nlohmann::json& object, void* into, const RecordPlace& place) const;
    [[nodiscard]] nlohmann::json write(const void* record) const;
    [[nodiscard]] Result<void> check(const void* record, const RecordPlace& place) const;
    [[nodiscard]] std::vector<FieldInfo> infos() const;
    [[nodiscard]] AnyKind kind() const;

private:
    struct Field {
        AnyKind kind;
        std::size_t offset;
        const OptionalAccess* optional;

        [[nodiscard]] void* in(void* record) const noexcept { return static_cast<std::byte*>(record) + offset; }
        /// Does nothing to a member that is not a std::optional.
        void clear(void* record) const;
        /// Returns null if the member is a std::optional without a value.
        [[nodiscard]] const void* held(const void* record) const;
        [[nodiscard]] Result<void> read(const nlohmann::json& value, void* record, const RecordPlace& place) const;
        [[nodiscard]] nlohmann::json write(const void* record) const;
    };
    [[nodiscard]] Result<void> checkRules(const void* record, const RecordPlace& place) const;

    std::vector<Field> fields_;
    std::vector<Rule> rules_;
    std::function<bool(const void*)> absent_;
    bool nullIsMissing_ = false;
    bool passOver_ = false;
};

/// Gives the member `inner` of the member `outer` as the member of a field.
template <class Outer, class Inner>
[[nodiscard]] auto in(Outer outer, Inner inner) {
    return [=](auto& record) -> auto& { return std::invoke(inner, std::invoke(outer, record)); };
}

template <class Record>
class RecordFields {
    template <class T>
    struct Bare {
        using Type = T;
        static constexpr const RecordTable::OptionalAccess* kAccess = nullptr;
    };
    template <class T>
    struct Bare<std::optional<T>> {
        using Type = T;
        static constexpr RecordTable::OptionalAccess kHow{
            [](const void* member) -> const void* {
                const auto& held = *static_cast<const std::optional<T>*>(member);
                return held ? &*held : nullptr;
            },
            [](void* member) -> void* { return &static_cast<std::optional<T>*>(member)->emplace(); },
            [](void* member) { static_cast<std::optional<T>*>(member)->reset(); }};
        static constexpr const RecordTable::OptionalAccess* kAccess = &kHow;
    };
    template <class Member>
    using Held = std::remove_cvref_t<std::invoke_result_t<Member, Record&>>;
    /// The type of a member's value; for a std::optional, the type inside.
    template <class Member>
    using ValueOf = typename Bare<Held<Member>>::Type;

public:
    // `member` is a pointer to a member; or in() for a member of a member; or std::identity for fields of the record
    // itself that are in a JSON object of their own. It must be part of the record, not reached by a pointer. The
    // returned field may be changed until the next field is added.

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
                    std::size_t least, std::size_t most) {
        return add(key, member, listKind<ValueOf<Member>>(each, least, most));
    }
    template <class Member>
    FieldInfo& add(std::string_view key, Member member, ValueKind<ValueOf<Member>> kind) {
        const auto offset = offsetOf(std::addressof(std::invoke(member, example())), sizeof(Held<Member>));
        return table_.add(key, offset, std::move(kind), Bare<Held<Member>>::kAccess);
    }

    /// A text for people who read the file. No member keeps it.
    void note(std::string_view key, const AcceptedText& accepted = {}) { table_.note(key, accepted); }
    /// A rule between fields, checked after the single fields. `holds(record)` returns a Result<void>.
    template <class Rule>
    void rule(Rule holds) {
        table_.rule([holds = std::move(holds)](const void* record) -> Result<void> {
            return holds(*static_cast<const Record*>(record));
        });
    }
    /// Writes the record as null if `absent(record)` is true.
    template <class Absent>
    void absentWhere(Absent absent) {
        table_.absentWhere([absent = std::move(absent)](const void* record) -> bool {
            return absent(*static_cast<const Record*>(record));
        });
    }
    /// Treats null like a missing key, for data from scripts.
    void takeNullAsMissing() { table_.takeNullAsMissing(); }
    /// Ignores keys that are not in the table, as notes.
    void passOverUnknownKeys() { table_.passOverUnknownKeys(); }

    /// Errors: ParseError naming an unknown or missing key or a value of another type; InvalidArgument naming a value
    /// that is not accepted; the errors of the rules. After an error `into` may be partly changed.
    [[nodiscard]] Result<void> read(const nlohmann::json& object, Record& into, const RecordPlace& place) const {
        return table_.read(object, &into, place);
    }
    /// Reads a new record. Errors: as above.
    [[nodiscard]] Result<Record> read(const nlohmann::json& object, const RecordPlace& place) const {
        Record record{};
        if (auto done = read(object, record, place); !done) return failure(done);
        return record;
    }
    [[nodiscard]] nlohmann::json write(const Record& record) const { return table_.write(&record); }
    /// Errors: InvalidArgument naming the first value that is not accepted; the errors of the rules.
    [[nodiscard]] Result<void> check(const Record& record, const RecordPlace& place) const {
        return table_.check(&record, place);
    }

    [[nodiscard]] std::vector<FieldInfo> infos() const { return table_.infos(); }
    [[nodiscard]] ValueKind<Record> kind() const { return ValueKind<Record>(table_.kind()); }

private:
    /// A record that shows the offsets of its members.
    [[nodiscard]] static Record& example() {
        static Record one{};
        return one;
    }
    /// Asserts by itself: an assertion prints its function, where a lambda has the name of the folder it lies in.
    [[nodiscard]] static std::size_t offsetOf(const void* member, std::size_t size) {
        const auto* const first = reinterpret_cast<const std::byte*>(&example());
        const auto offset = static_cast<std::size_t>(static_cast<const std::byte*>(member) - first);
        assert(offset + size <= sizeof(Record));
        return offset;
    }

    RecordTable table_;
};

/// A record that is stored as a `Stored`: `fromStored(stored)` and `toStored(record)` convert between the two.
template <class Record, class Stored, class From, class To>
[[nodiscard]] ValueKind<Record> storedAs(const RecordFields<Stored>& fields, From fromStored, To toStored) {
    const auto stored = fields.kind();
    ValueKind<Record> kind;
    kind.info = stored.info;
    kind.reads([stored, fromStored](const nlohmann::json& value, Record& into, const RecordPlace& place,
                                    std::string_view key) -> Result<void> {
        Stored read{};
        if (auto done = stored.read(value, read, place, key); !done) return done;
        into = fromStored(read);
        return {};
    });
    kind.writes([stored, toStored](const Record& record) { return stored.write(toStored(record)); });
    kind.checks([stored, toStored](const Record& record, const RecordPlace& place, std::string_view key) {
        return stored.check(toStored(record), place, key);
    });
    return kind;
}

/// Parses a record from `text`. `source` begins every message. Errors: ParseError.
template <class Record>
[[nodiscard]] Result<Record> parseRecord(const RecordFields<Record>& fields, std::string_view text,
                                         std::string_view source, const JsonLimits& limits = {}) {
    const auto document = parseJson(text, source, limits);
    if (!document) return failure(document);
    return fields.read(*document, {.file = std::string(source)}).map_error(asParseError);
}

/// Returns the result of `build`, for example a table, which is built at the first call and kept.
template <auto build>
[[nodiscard]] const auto& builtOnce() {
    static const auto built = build();
    return built;
}

}  // namespace tacto
