// ResultRecord.h - what a record of results holds. Each member is described once: its key, the value that it comes from
// and, where it is shown, its title, its unit and what stands beside it. The session's JSON and the tables derive from
// that:
//
//   ResultRecord<PairSummary> describePair() {
//       ResultRecord<PairSummary> all;
//       all.shown(text("Condition", "a"), &PairSummary::a);
//       all.kept("amplitude_jnd_high", [](const PairSummary& pair) { return pair.amplitudeJndBounds.high; });
//       return all;
//   }
//
// Numbers that are not known, NaN, are null; so is what a std::optional does not hold.
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

/// How a value stands in a session: words by nameOf(), lists one by one, anything else by its toJson().
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

/// A text that is null where it is empty.
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
    /// In the session, and in no table. `get` is a member or a function of the record; `key` may be "a.b", a member of
    /// a record that stands in this one.
    template <class Get>
    void kept(std::string key, Get get) {
        keep(std::move(key), [get](const Record& record) { return resultJson(std::invoke(get, record)); });
    }
    /// In the session as the record that `part` describes, as a list of such records, or as null where there is none.
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
    /// In the session, and a column of its tables.
    template <class Get>
    void shown(ResultColumn column, Get get) {
        kept(column.at, std::move(get));
        columns_.push_back(std::move(column));
    }
    /// A column that a script or another record fills.
    void shown(ResultColumn column) { columns_.push_back(std::move(column)); }
    /// Both bounds of what the member `key` is: "key_low" and "key_high".
    template <class Get>
    void keptBounds(const std::string& key, Get get) {
        kept(key + "_low", [get](const Record& record) { return std::invoke(get, record).low; });
        kept(key + "_high", [get](const Record& record) { return std::invoke(get, record).high; });
    }
    /// Its verdict and the reasons for that.
    void judged() {
        kept("verdict", &Record::verdict);
        kept("reasons", &Record::reasons);
    }
    /// All members of a record that this one holds, beside its own; a member that is kept later replaces one.
    template <class Get, class Part>
    void merge(Get get, const ResultRecord<Part>& part) {
        part.each([&](const nlohmann::json::json_pointer& at, const auto& value) {
            members_.emplace_back(at, [get, value](const Record& record) { return value(std::invoke(get, record)); });
        });
    }

    // The tables, in the order in which they are read. What is returned may be changed until the next is added.

    /// Of the columns that were shown since the last table.
    ResultTable& facts(const char* title, ResultTable::Else where = ResultTable::Else::Nowhere) {
        return table(describe::facts(title, "", std::exchange(columns_, {}), where));
    }
    /// Of a list of records, which is a member.
    template <class Get, class Part>
    ResultTable& rows(const char* title, const char* key, Get get, const ResultRecord<Part>& part,
                      ResultTable::Else where = ResultTable::Else::Nowhere) {
        kept(key, std::move(get), part);
        return table(describe::rows(title, key, part.columns(), where));
    }
    /// Of a member that is kept, or of what a script adds.
    ResultTable& table(ResultTable of) { return tables_.emplace_back(std::move(of)); }

    [[nodiscard]] nlohmann::json write(const Record& record) const {
        auto out = nlohmann::json::object();
        for (const auto& [at, value] : members_) out[at] = value(record);
        return out;
    }
    [[nodiscard]] const std::vector<ResultColumn>& columns() const& noexcept { return columns_; }
    [[nodiscard]] std::vector<ResultColumn> columns() && { return std::move(columns_); }
    /// The column of that key under another title, for another table.
    [[nodiscard]] ResultColumn column(std::string_view key, std::string title) const {
        auto found = *std::ranges::find(columns_, key, &ResultColumn::at);
        found.title = std::move(title);
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
    using Value = std::function<nlohmann::json(const Record&)>;

    void keep(std::string key, Value value) { members_.emplace_back(placeOf(std::move(key)), std::move(value)); }
    static nlohmann::json::json_pointer placeOf(std::string key) {
        for (std::size_t dot = 0; (dot = key.find('.', dot)) != key.npos;) key[dot] = '/';
        return nlohmann::json::json_pointer('/' + key);
    }

    std::vector<std::pair<nlohmann::json::json_pointer, Value>> members_;
    std::vector<ResultColumn> columns_;
    std::vector<ResultTable> tables_;
};

}  // namespace tacto
