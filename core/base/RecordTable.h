// RecordTable.h - what RecordFields (RecordFields.h) does with a record, for code that does not know its type: records
// by their address, members by where they stand in them.
//
// Thread-safety: a table is constant once it is built; reading, writing and checking are pure. No exception whatever
// the JSON.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/ValueKind.h"

namespace tacto {

class RecordTable {
public:
    /// How a member is reached that is a std::optional.
    struct OptionalAccess {
        const void* (*get)(const void*);  ///< null: none
        void* (*emplace)(void*);
        void (*reset)(void*);
    };
    using Rule = std::function<Result<void>(const void* record)>;

    /// A field whose member stands `offset` bytes into the record. What is returned may be changed until the next field
    /// is added. `optional`: for a member that is one; must live forever.
    FieldInfo& add(std::string_view key, std::size_t offset, AnyKind kind, const OptionalAccess* optional = nullptr);
    void note(std::string_view key, const AcceptedText& accepted);
    void rule(Rule holds) { rules_.push_back(std::move(holds)); }
    void absentWhere(std::function<bool(const void* record)> absent) { absent_ = std::move(absent); }
    void takeNullAsMissing() { nullIsMissing_ = true; }
    void passOverUnknownKeys() { passOver_ = true; }

    /// As of RecordFields.
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
        /// What is not a std::optional keeps what it holds.
        void clear(void* record) const;
        /// Null where the member is a std::optional that holds nothing.
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

}  // namespace tacto
