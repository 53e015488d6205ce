#include "core/formats/csv/CsvDraft.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <ranges>

#include "core/base/CsvStamp.h"
#include "core/base/LocaleFreeText.h"
#include "core/formats/csv/CsvColumns.h"

namespace tacto {

namespace {

/// With these options any table can be read, with or without column names.
bool optionsGiveTheTime(const ReadOptions& options) { return !options.timeColumn.empty() || options.rate.has_value(); }

bool hasTimeAndChannel(const CsvLine& line) {
    return line.fields.size() >= 2 &&
           std::ranges::any_of(line.fields, [](const auto& field) { return isTimeColumn(columnNamed(field)); });
}

bool hasStamps(const CsvHead& head) {
    return head.firstRow && std::ranges::any_of(head.firstRow->fields, [&](const auto& field) {
               return fieldStamp(field, head.point).has_value();
           });
}

/// Returns the line that names the columns: the line nearest to the rows that names a time (earlier lines may be keys
/// with such names, later lines are units). If the time is known without one, the last header line.
const CsvLine* lineOfNames(const CsvHead& head, const std::optional<StatedInterval>& stated, bool timeIsKnown) {
    const CsvLine* units = nullptr;
    for (const auto& line : std::views::reverse(head.header)) {
        if (stated && line.number == stated->line) continue;
        if (!hasTimeAndChannel(line) && !isLineOfUnits(line)) continue;
        if (!isLineOfUnits(line)) return &line;
        units = &line;
    }
    if (head.header.empty() || (units == nullptr && !timeIsKnown)) return nullptr;
    const auto* last = &head.header.back();
    if (isLineOfUnits(*last) && head.header.size() > 1 && filled(last[-1]) == filled(*last)) return last - 1;
    return units != nullptr ? units : last;
}

/// Returns whether `is` holds for the cells of a column in the rows of the head.
template <class Predicate>
bool cellsAre(const CsvHead& head, const CsvLayout& layout, std::size_t column, Predicate&& is) {
    bool any = false;
    for (const auto* lines : {&head.header, &head.body}) {
        for (const auto& line : *lines) {
            if (line.number < layout.dataLine || column >= line.fields.size() || line.fields[column].empty()) continue;
            if (!is(line.fields[column])) return false;
            any = true;
        }
    }
    return any;
}

/// Returns the seconds of the first stamp in a column that begins with one.
std::optional<std::int64_t> firstStampIn(const CsvHead& head, const CsvLayout& layout, std::size_t column) {
    std::optional<std::int64_t> first;
    cellsAre(head, layout, column, [&](const std::string& cell) {
        if (const auto stamp = fieldStamp(cell, head.point)) first = stamp->seconds;
        return false;
    });
    return first;
}

bool isColumnOfText(const CsvHead& head, const CsvLayout& layout, std::size_t column) {
    return cellsAre(head, layout, column, [&](const std::string& cell) { return !fieldNumber(cell, head.point); });
}

bool countsRows(const CsvHead& head, const CsvLayout& layout, std::size_t column) {
    std::optional<double> last;
    return cellsAre(head, layout, column, [&](const std::string& cell) {
        const auto number = fieldNumber(cell, head.point);
        const bool next = number && (last ? *number == *last + 1 : *number == 0 || *number == 1);
        last = number;
        return next;
    });
}

}  // namespace

void CsvDraft::addChannel(std::string name, std::string_view spelled) {
    if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos) {
        name.insert(0, "CH");  // "1" would be read as a column number
    }
    const auto unit = unitField(spelled);
    layout.names.push_back(name);
    columns.push_back({std::move(name), layout.names.size(), unit ? std::string(unit->unit) : "",
                       unit ? unit->factor : 1, unit ? "" : std::string(unitTextOf(spelled))});
}

void CsvDraft::countRows(std::optional<double> interval_s, double start_s, std::string_view stated,
                         std::string_view file) {
    layout.times = RowTimes::Counted;
    layout.start_s = std::isfinite(start_s) ? start_s : 0;
    layout.interval_s = interval_s;
    if (interval_s && *interval_s > 0 && std::isfinite(*interval_s) && std::isfinite(start_s)) return;
    layout.interval_s.reset();
    layout.noInterval =
        fmt::format("{}: the time between samples is '{}'; a finite one above 0 was expected", file, stated);
}

void CsvDraft::addNamed(const std::string& named) {
    const auto column = columnNamed(named);
    layout.names.push_back(named);
    columns.push_back({column.name, layout.names.size(), column.unit, column.factor, column.unknownUnit});
}

CsvDraft twoLineDraft(const CsvLine& names, const CsvLine& units, std::size_t width) {
    CsvDraft draft(names, units);
    const auto time = unitField(units.fields.front());
    draft.layout.timeFactor = time ? time->factor : 1;
    draft.addOther(names.fields.front().empty() ? "time" : names.fields.front());
    for (std::size_t c = 1; c < width; ++c) {
        // "CH1 [mV]" with "(mV)" below
        const auto named = columnNamed(names.fields[c]);
        draft.addChannel(named.unit.empty() ? names.fields[c] : named.name, fieldIn(&units, c));
    }
    return draft;
}

std::optional<std::size_t> columnCalled(const std::vector<std::string>& names, std::string_view wanted) {
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (folded(names[c]) == folded(wanted) || folded(columnNamed(names[c]).name) == folded(wanted)) return c;
    }
    const auto number = parseNumber(wanted);
    for (std::size_t c = 0; c < names.size() && number; ++c) {
        if (static_cast<double>(c + 1) == *number) return c;
    }
    return std::nullopt;
}

Result<CsvDraft> plainDraft(const CsvHead& head, const ReadOptions& options, std::string_view file) {
    const auto stated = intervalStated(head);
    if (head.header.empty() && !stated && !hasStamps(head) && !optionsGiveTheTime(options)) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: a header line naming the columns, time among them, was expected before the numbers", file,
                    head.firstRow->number);
    }
    const auto* named = lineOfNames(head, stated, stated || hasStamps(head) || optionsGiveTheTime(options));
    if (named == nullptr && !head.header.empty()) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: columns '{}'; a time column and channels were expected, as in time_s,voltage_v,current_a",
                    file, head.header.front().number, fmt::join(namesIn(head.header.front()), ","));
    }
    if (named != nullptr && stated && named->number == stated->line) named = nullptr;  // the line holds only keys
    std::vector<std::string> names;
    const auto* units = named != nullptr && isLineOfUnits(*named) ? named : nullptr;
    if (named != nullptr) {
        names = namesIn(*named);
        if (named != &head.header.back() && isLineOfUnits(named[1])) units = named + 1;
    } else {
        for (std::size_t c = 0; head.firstRow && c < filled(*head.firstRow); ++c) {
            names.push_back(fmt::format("column {}", c + 1));
        }
    }
    const auto* last = units != nullptr ? units : named;
    if (last == nullptr) last = head.firstRow ? &*head.firstRow : &head.header.back();
    const auto hasNumber = [&](const CsvLine& line) {
        return std::ranges::any_of(line.fields, [&](const auto& field) {
            return fieldNumber(field, head.point) || fieldStamp(field, head.point);
        });
    };
    std::size_t remarks = 0;  // remarks below the names, as Origin writes them
    for (; named != nullptr && last != &head.header.back() && !hasNumber(last[1]); ++last) ++remarks;
    CsvDraft draft(named != nullptr ? *named : *last, *last);
    if (named == nullptr && head.firstRow) draft.startAt(*head.firstRow);
    if (named != nullptr && named != head.header.data()) {
        draft.layout.warnings.push_back(fmt::format(
            "{}:{}: {} before the names of the columns passed over", file, head.header.front().number,
            named - head.header.data() == 1 ? "a line" : fmt::format("{} lines", named - head.header.data())));
    }
    if (remarks > 0) {
        draft.layout.warnings.push_back(
            fmt::format("{}:{}: {} without numbers below the names of the columns passed over", file, last->number,
                        remarks == 1 ? "a line" : fmt::format("{} lines", remarks)));
    }
    draft.layout.times = RowTimes::Counted;
    if (stated) draft.layout.interval_s = stated->interval_s;
    std::optional<std::size_t> stamps;
    for (std::size_t c = 0; c < names.size(); ++c) {
        auto column = columnNamed(names[c]);
        if (units != nullptr && c < units->fields.size()) {
            const auto unit = unitField(units->fields[c]);
            column.unit = unit ? unit->unit : "";
            column.factor = unit ? unit->factor : 1;
            column.unknownUnit = unit ? "" : std::string(unitTextOf(units->fields[c]));
        }
        const bool chosen = !options.timeColumn.empty() && columnCalled(names, options.timeColumn) == c;
        if (draft.layout.times == RowTimes::Counted && isTimeColumn(column) && (options.timeColumn.empty() || chosen)) {
            draft.layout.times = RowTimes::Column;
            draft.layout.timeColumn = c;
            draft.layout.timeFactor = column.unit == "s" ? column.factor : 1;
            continue;
        }
        if (!stamps && firstStampIn(head, draft.layout, c)) stamps = c;
        draft.columns.push_back({column.name, c + 1, column.unit, column.factor, column.unknownUnit});
    }
    draft.layout.names = std::move(names);
    if (draft.layout.times == RowTimes::Counted && stamps && options.timeColumn.empty() && !options.rate) {
        draft.layout.times = RowTimes::Column;
        draft.layout.timeColumn = *stamps;
        std::erase_if(draft.columns, [&](const ChannelPlan& plan) { return plan.number == *stamps + 1; });
    }
    // A row number is not a signal, unless the user asks for it.
    if (draft.layout.times == RowTimes::Column && draft.layout.timeColumn > 0 && options.columns.empty() &&
        !draft.columns.empty() && draft.columns.front().number == 1) {
        const auto& first = draft.layout.names.front();
        if (isIndexColumn(columnNamed(first)) || (first.empty() && countsRows(head, draft.layout, 0))) {
            draft.layout.warnings.push_back(fmt::format("{}:{}: column '{}' counts the rows and was left out", file,
                                                        draft.layout.headerLine, first));
            draft.columns.erase(draft.columns.begin());
        }
    }
    return draft;
}

namespace {

/// Uses the time column that the options choose, with its unit. Errors: InvalidArgument if it does not exist or its
/// unit is not a unit of time.
Result<void> chooseTimeColumn(CsvDraft& draft, const CsvHead& head, ReadOptions& options, std::string_view file) {
    auto& layout = draft.layout;
    if (!options.timeColumn.empty()) {
        const auto column = columnCalled(layout.names, options.timeColumn);
        if (!column) {
            return invalid("{}:{}: there is no time column '{}'; the columns are {}", file, layout.headerLine,
                           options.timeColumn, fmt::join(layout.names, ", "));
        }
        if (layout.times != RowTimes::Column || layout.timeColumn != *column) {
            const auto plan = std::ranges::find(draft.columns, *column + 1, &ChannelPlan::number);
            const auto own = columnNamed(layout.names[*column]);
            const auto alone = spelledUnit(layout.names[*column]);  // "ms", with no name
            layout.times = RowTimes::Column;
            layout.timeColumn = *column;
            layout.timeFactor = 1;
            layout.interval_s.reset();
            std::string wrong = own.unit == "s" ? "" : own.unknownUnit + own.unit;
            if (own.unit == "s") layout.timeFactor = own.factor;
            if (own.unit.empty() && alone && alone->unit == "s") layout.timeFactor = alone->factor;
            if (plan != draft.columns.end() && (!plan->unit.empty() || !plan->unknownUnit.empty())) {
                wrong = plan->unit == "s" ? "" : plan->unknownUnit + plan->unit;
                if (plan->unit == "s") layout.timeFactor = plan->factor;
            }
            if (plan != draft.columns.end()) draft.columns.erase(plan);
            const bool said = std::ranges::any_of(
                options.units, [&](const auto& unit) { return columnCalled(layout.names, unit.first) == *column; });
            if (!wrong.empty() && !said && !firstStampIn(head, layout, *column)) {
                return invalid("{}:{}: column '{}' is in '{}'; a column of times, in s, ms, us or ns, was expected",
                               file, layout.headerLine, layout.names[*column], wrong);
            }
        }
    }
    if (layout.times != RowTimes::Column) return {};
    for (auto unit = options.units.begin(); unit != options.units.end(); ++unit) {
        if (columnCalled(layout.names, unit->first) != layout.timeColumn) continue;
        const auto spelled = spelledUnit(unit->second);
        if (!spelled || spelled->unit != "s") {
            return invalid("the unit '{}' of the time column '{}' is unknown; s, ms, us or ns was expected",
                           unit->second, unit->first);
        }
        layout.timeFactor = spelled->factor;
        options.units.erase(unit);
        break;
    }
    layout.stampOrigin = firstStampIn(head, layout, layout.timeColumn);
    if (layout.stampOrigin) {
        layout.timeFactor = 1;
        layout.warnings.push_back(fmt::format(
            "{}: times are dates or times of day; they are counted from the first row's whole second", file));
    }
    return {};
}

/// Returns the time columns that each stand before channels of their own, with number and factor.
std::vector<CsvLayout::OtherTime> timesOfChannels(const CsvDraft& draft) {
    std::vector<CsvLayout::OtherTime> times{{draft.layout.timeColumn, draft.layout.timeFactor}};
    for (const auto& plan : draft.columns) {
        if (isTimeColumn({plan.name, plan.unit, plan.factor, plan.unknownUnit})) {
            times.push_back({plan.number - 1, plan.unit == "s" ? plan.factor : 1});
        }
    }
    std::ranges::sort(times, {}, &CsvLayout::OtherTime::column);
    const auto isChannel = [&](std::size_t column) {
        return std::ranges::find(times, column, &CsvLayout::OtherTime::column) == times.end() &&
               std::ranges::find(draft.columns, column + 1, &ChannelPlan::number) != draft.columns.end();
    };
    const bool apart = std::ranges::all_of(times, [&](const auto& time) { return isChannel(time.column + 1); });
    if (!apart || draft.layout.timeColumn != times.front().column) times.clear();
    return times;
}

/// Takes the times from the columns before the chosen channels. Times of further channels must agree.
void pairTimes(CsvLayout& layout, const std::vector<CsvLayout::OtherTime>& times,
               const std::vector<ChannelPlan>& channels) {
    std::vector<CsvLayout::OtherTime> used;
    for (const auto& channel : channels) {
        const auto behind = std::ranges::upper_bound(times, channel.number - 1, {}, &CsvLayout::OtherTime::column);
        const auto& own = behind == times.begin() ? times.front() : *std::prev(behind);
        if (std::ranges::find(used, own.column, &CsvLayout::OtherTime::column) == used.end()) used.push_back(own);
    }
    if (used.empty()) return;
    std::ranges::sort(used, {}, &CsvLayout::OtherTime::column);
    layout.timeColumn = used.front().column;
    layout.timeFactor = used.front().factor;
    if (!layout.givenRate_hz) layout.otherTimes.assign(used.begin() + 1, used.end());
}

/// Drops texts, times and other quantities, and names them. A column that the user chose stays and is refused.
Result<void> keepChannels(CsvLayout& layout, std::vector<ChannelPlan>& channels, const CsvHead& head, bool chosen,
                          bool paired, std::string_view file) {
    const auto leaveOut = [&](const auto& is, std::string_view what) {
        std::erase_if(channels, [&](const ChannelPlan& plan) {
            if (!is(plan)) return false;
            layout.warnings.push_back(fmt::format("{}:{}: column {} {} and was left out", file, layout.headerLine,
                                                  layout.names[plan.number - 1].empty()
                                                      ? fmt::to_string(plan.number)
                                                      : "'" + layout.names[plan.number - 1] + "'",
                                                  fmt::format(fmt::runtime(what), plan.unknownUnit)));
            return true;
        });
    };
    if (paired) {
        std::erase_if(channels, [](const ChannelPlan& plan) {
            return isTimeColumn({plan.name, plan.unit, plan.factor, plan.unknownUnit});
        });
    }
    // Columns in seconds are times, not channels.
    leaveOut([](const ChannelPlan& plan) { return plan.unit == "s"; }, "is a time");
    if (channels.empty()) {
        return fail(ErrorCode::ParseError, "{}:{}: only times; at least one channel was expected", file,
                    layout.headerLine);
    }
    if (chosen) return {};
    const auto isText = [&](const ChannelPlan& plan) { return isColumnOfText(head, layout, plan.number - 1); };
    if (std::ranges::all_of(channels, isText)) return {};  // the first row of the text column is refused
    leaveOut(isText, "holds text");
    const auto isOther = [](const ChannelPlan& plan) { return !plan.unknownUnit.empty(); };
    if (!std::ranges::all_of(channels, isOther)) leaveOut(isOther, "is in '{}', neither a voltage nor a current,");
    return {};
}

/// Errors: ParseError for a channel with an unknown unit, without a name, or with the name of another channel.
Result<void> checkChannels(CsvLayout& layout, std::vector<ChannelPlan>& channels, bool chosen, std::string_view file) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
        auto& channel = channels[i];
        const auto& name = layout.names[channel.number - 1];
        if (!channel.unknownUnit.empty()) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: the unit of column '{}' is unknown; s, V or A with m, u, n or k were expected", file,
                        layout.headerLine, name);
        }
        if (name.empty() && !chosen) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: column {} has no name; a header line naming every column was expected", file,
                        layout.headerLine, channel.number);
        }
        if (name.empty()) channel.name = fmt::format("column {}", channel.number);
        const auto isSame = [&](const ChannelPlan& other) { return layout.names[other.number - 1] == name; };
        if (name.empty() || std::find_if(channels.begin(), channels.begin() + static_cast<std::ptrdiff_t>(i), isSame) ==
                                channels.begin() + static_cast<std::ptrdiff_t>(i)) {
            continue;
        }
        if (!chosen) {
            return fail(ErrorCode::ParseError, "{}:{}: {}", file, layout.headerLine, givenTwice("column '{}'", name));
        }
        channel.name += fmt::format(" ({})", channel.number);
    }
    return {};
}

}  // namespace

Result<CsvLayout> finished(CsvDraft draft, const CsvHead& head, const ReadOptions& given, std::string_view file) {
    auto& layout = draft.layout;
    auto options = given;
    layout.width = layout.names.size();
    if (auto timed = chooseTimeColumn(draft, head, options, file); !timed) return failure(timed);
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        layout.givenRate_hz = *rate;
    }
    if (layout.times != RowTimes::Column && !layout.interval_s && !layout.givenRate_hz) {
        if (!layout.noInterval.empty()) return fail(ErrorCode::ParseError, "{}", layout.noInterval);
        return fail(ErrorCode::ParseError, "{}:{}: no column of times; one, or a sampling rate, was expected", file,
                    layout.headerLine);
    }
    const bool ownTimes = layout.times == RowTimes::Column && options.timeColumn.empty() && !layout.stampOrigin;
    const auto times = ownTimes ? timesOfChannels(draft) : std::vector<CsvLayout::OtherTime>();
    const bool paired = times.size() > 1;
    auto planned = planChannels(std::move(draft.columns), options, file);
    if (!planned) return failure(planned);
    if (planned->empty()) {
        return fail(ErrorCode::ParseError, "{}:{}: no channel beside the time; at least one was expected", file,
                    layout.headerLine);
    }
    const bool chosen = !options.columns.empty();
    if (auto kept = keepChannels(layout, *planned, head, chosen, paired, file); !kept) return failure(kept);
    if (auto checked = checkChannels(layout, *planned, chosen, file); !checked) return failure(checked);
    if (paired) pairTimes(layout, times, *planned);
    layout.channels = std::move(*planned);
    return layout;
}

}  // namespace tacto
