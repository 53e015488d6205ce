// ResultRecord.h - describes the members of a result record. Each member is described once: its key, the source of its
// value and, if it is shown, its title, unit and related member. The session's JSON and the tables are derived from
// this:
//
//   ResultRecord<PairSummary> describePair() {
//       ResultRecord<PairSummary> all;
//       all.shown(text("Condition", "a"), &PairSummary::a);
//       all.kept("amplitude_jnd_high", [](const PairSummary& pair) { return pair.amplitudeJndBounds.high; });
//       return all;
//   }
//
// Unknown numbers (NaN) and empty std::optional values are written as null.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <iterator>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/results/Describe.h"

namespace tacto {

template <class Value>
[[nodiscard]] nlohmann::json resultJson(const Value& value);

namespace detail {

template <class Value>
constexpr bool kIsOptional = false;
template <class Value>
constexpr bool kIsOptional<std::optional<Value>> = true;

template <class Value>
concept PlainValue =
    std::integral<Value> || std::convertible_to<const Value&, std::string_view> || std::same_as<Value, nlohmann::json>;

}  // namespace detail

/// Converts a value to JSON: words by nameOf(), lists item by item, anything else by its toJson().
template <class Value>
nlohmann::json resultJson(const Value& value) {
    if constexpr (std::floating_point<Value>) {
        return numberOrNull(value);
    } else if constexpr (std::is_enum_v<Value>) {
        return nameOf(value);
    } else if constexpr (detail::PlainValue<Value>) {
        return value;
    } else if constexpr (detail::kIsOptional<Value>) {
        return value ? resultJson(*value) : nlohmann::json();
    } else if constexpr (std::ranges::range<Value>) {
        auto list = nlohmann::json::array();
        for (const auto& each : value) list.push_back(resultJson(each));
        return list;
    } else {
        return toJson(value);
    }
}

/// Makes a getter that returns null for an empty text.
template <class Get>
[[nodiscard]] auto nullIfEmpty(Get get) {
    return [get](const auto& record) {
        const std::string& text = std::invoke(get, record);
        return text.empty() ? nlohmann::json() : nlohmann::json(text);
    };
}

template <class Record>
class ResultRecord {
public:
    /// Adds a member to the session but to no table. `get` is a member or a function of the record. `key` may be "a.b",
    /// a member of a nested record.
    template <class Get>
    void kept(std::string key, Get get) {
        keep(std::move(key), [get](const Record& record) { return resultJson(std::invoke(get, record)); });
    }
    /// Adds a member that `part` describes: one record, a list of such records, or null if absent.
    template <class Get, class Part>
    void kept(std::string key, Get get, ResultRecord<Part> part) {
        keep(std::move(key), [get, part = std::move(part)](const Record& record) -> nlohmann::json {
            const auto& held = std::invoke(get, record);
            if constexpr (detail::kIsOptional<std::remove_cvref_t<decltype(held)>>) {
                return held ? part.write(*held) : nlohmann::json();
            } else if constexpr (std::ranges::range<decltype(held)>) {
                auto list = nlohmann::json::array();
                for (const auto& each : held) list.push_back(part.write(each));
                return list;
            } else {
                return part.write(held);
            }
        });
    }
    /// Adds a member that is left out where `get` returns an empty std::optional.
    template <class Get>
    void keptIfAny(std::string key, Get get) {
        keep(std::move(key), [get](const Record& record) {
            const auto& held = std::invoke(get, record);
            return held ? resultJson(*held) : leftOut();
        });
    }
    /// Adds a member to the session and a column to its tables.
    template <class Get>
    void shown(ResultColumn column, Get get) {
        kept(column.at, std::move(get));
        columns_.push_back(std::move(column));
    }
    /// Adds a column whose value comes from a script or another record.
    void shown(ResultColumn column) { columns_.push_back(std::move(column)); }
    /// Adds both bounds of a figure: "key_low" and "key_high".
    template <class Get>
    void keptBounds(const std::string& key, Get get) {
        kept(key + "_low", [get](const Record& record) { return std::invoke(get, record).low; });
        kept(key + "_high", [get](const Record& record) { return std::invoke(get, record).high; });
    }
    /// Adds the verdict and its reasons.
    void judged() {
        kept("verdict", &Record::verdict);
        kept("reasons", &Record::reasons);
    }
    /// Adds all members of a nested record to this one, left out if it is an empty std::optional. A later member with
    /// the same key replaces the earlier.
    template <class Get, class Part>
    void merge(Get get, const ResultRecord<Part>& part) {
        part.each([&](const nlohmann::json::json_pointer& at, const auto& value) {
            members_.emplace_back(at, [get, value](const Record& record) {
                const auto& held = std::invoke(get, record);
                if constexpr (detail::kIsOptional<std::remove_cvref_t<decltype(held)>>)
                    return held ? value(*held) : leftOut();
                else
                    return value(held);
            });
        });
    }

    /// Adds all members of a nested record and their columns.
    template <class Get, class Part>
    void mergeShown(Get get, const ResultRecord<Part>& part) {
        merge(std::move(get), part);
        columns_.insert(columns_.end(), part.columns().begin(), part.columns().end());
    }

    // The following functions add tables in reading order. A returned reference is valid until the next table is added.

    /// Adds a table of one record from the columns added since the last table.
    ResultTable& facts(const char* title, ResultTable::Else where = ResultTable::Else::Nowhere) {
        return table(describe::facts(title, "", std::exchange(columns_, {}), where));
    }
    /// Adds a member that is a list of records, and its table.
    template <class Get, class Part>
    ResultTable& rows(const char* title, const char* key, Get get, const ResultRecord<Part>& part,
                      ResultTable::Else where = ResultTable::Else::Nowhere) {
        kept(key, std::move(get), part);
        return table(describe::rows(title, key, part.columns(), where));
    }
    /// Adds a table of a member added by kept() or by a script.
    ResultTable& table(ResultTable of) { return tables_.emplace_back(std::move(of)); }

    [[nodiscard]] nlohmann::json write(const Record& record) const {
        auto out = nlohmann::json::object();
        for (const auto& [at, value] : members_) {
            if (auto member = value(record); !member.is_discarded()) out[at] = std::move(member);
        }
        return out;
    }
    /// Returns a record with only these members, and without columns and tables.
    [[nodiscard]] ResultRecord only(const std::vector<std::string>& keys) const {
        ResultRecord some;
        for (const auto& key : keys)
            some.members_.push_back(*std::ranges::find(members_, placeOf(key), &std::pair<Place, Value>::first));
        return some;
    }
    /// Returns the keys of the members in the order added, those of nested records as "a.b", each once.
    [[nodiscard]] std::vector<std::string> keys() const {
        std::vector<std::string> all;
        for (const auto& [at, value] : members_) {
            auto key = at.to_string().substr(1);
            std::ranges::replace(key, '/', '.');
            if (std::ranges::find(all, key) == all.end()) all.push_back(std::move(key));
        }
        return all;
    }
    [[nodiscard]] const std::vector<ResultColumn>& columns() const& noexcept { return columns_; }
    [[nodiscard]] std::vector<ResultColumn> columns() && { return std::move(columns_); }
    /// Returns the column with that key for another table, perhaps under another title.
    [[nodiscard]] ResultColumn column(std::string_view key, std::string title = {}) const {
        auto found = *std::ranges::find(columns_, key, &ResultColumn::at);
        if (!title.empty()) found.title = std::move(title);
        return found;
    }
    /// Calls `visit(key, value)` for each member.
    template <class Visit>
    void each(Visit visit) const {
        for (const auto& [at, value] : members_) visit(at, value);
    }
    [[nodiscard]] const std::vector<ResultTable>& tables() const& noexcept { return tables_; }
    [[nodiscard]] std::vector<ResultTable> tables() && { return std::move(tables_); }

private:
    using Place = nlohmann::json::json_pointer;
    using Value = std::function<nlohmann::json(const Record&)>;

    static nlohmann::json leftOut() { return nlohmann::json::value_t::discarded; }
    void keep(std::string key, Value value) { members_.emplace_back(placeOf(std::move(key)), std::move(value)); }
    static Place placeOf(std::string key) {
        for (std::size_t dot = 0; (dot = key.find('.', dot)) != key.npos;) key[dot] = '/';
        return Place('/' + key);
    }

    std::vector<std::pair<Place, Value>> members_;
    std::vector<ResultColumn> columns_;
    std::vector<ResultTable> tables_;
};

}  // namespace tacto
