#include "core/formats/csv/CsvDraft.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <ranges>

#include "core/base/Text.h"
#include "core/formats/csv/CsvColumns.h"

namespace tacto {

namespace {

/// Any table can be read with these, named columns or not.
bool optionsGiveTheTime(const ReadOptions& options) { return !options.timeColumn.empty() || options.rate.has_value(); }

bool hasTimeAndChannel(const CsvLine& line) {
    return line.fields.size() >= 2 &&
           std::ranges::any_of(line.fields, [](const auto& field) { return isTimeColumn(columnNamed(field)); });
}

/// The line that names the columns: the one nearest to the rows that names a time (keys above it may be called so too,
/// units below it are); with options that give it, the last of the header.
const CsvLine* lineOfNames(const CsvHead& head, const ReadOptions& options) {
    const CsvLine* units = nullptr;
    for (const auto& line : std::views::reverse(head.header)) {
        if (!hasTimeAndChannel(line)) continue;
        if (!isLineOfUnits(line)) return &line;
        units = &line;
    }
    if (units != nullptr) return units;
    if (head.header.empty() || !optionsGiveTheTime(options)) return nullptr;
    const auto* last = &head.header.back();
    return isLineOfUnits(*last) && head.header.size() > 1 ? last - 1 : last;
}

}  // namespace

void CsvDraft::addChannel(std::string name, std::string_view spelled) {
    if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos) {
        name.insert(0, "CH");  // "1" would be the number of a column
    }
    const auto unit = unitField(spelled);
    layout.names.push_back(name);
    columns.push_back({std::move(name), layout.names.size(), unit ? std::string(unit->unit) : "",
                       unit ? unit->factor : 1, unit ? "" : std::string(spelled)});
}

Result<void> CsvDraft::countRows(std::optional<double> interval_s, double start_s, std::string_view stated,
                                 std::string_view file) {
    if (!interval_s || !(*interval_s > 0) || !std::isfinite(*interval_s) || !std::isfinite(start_s)) {
        return fail(ErrorCode::ParseError, "{}: the time between samples is '{}'; a finite one above 0 was expected",
                    file, stated);
    }
    layout.times = RowTimes::Counted;
    layout.interval_s = *interval_s;
    layout.start_s = start_s;
    return {};
}

CsvDraft twoLineDraft(const CsvLine& names, const CsvLine& units, std::size_t width) {
    CsvDraft draft(names, units);
    const auto time = unitField(units.fields.front());
    draft.layout.timeFactor = time ? time->factor : 1;
    draft.addOther(names.fields.front().empty() ? "time" : names.fields.front());
    for (std::size_t c = 1; c < width; ++c) {
        draft.addChannel(names.fields[c], c < units.fields.size() ? units.fields[c] : "");
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
    if (head.header.empty() && !optionsGiveTheTime(options)) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: a header line naming the columns was expected before the numbers; a time column or a "
                    "sampling rate, given as an option, reads a table without one",
                    file, head.firstRow->number);
    }
    std::vector<std::string> names;
    const auto* named = lineOfNames(head, options);
    const auto* last = named;
    if (named != nullptr) {
        auto read = namesIn(*named, file);
        if (!read) return failure(read);
        names = std::move(*read);
        if (named != &head.header.back() && isLineOfUnits(named[1])) last = named + 1;
    } else if (head.header.empty()) {
        for (std::size_t c = 0; c < head.firstRow->fields.size(); ++c) names.push_back(fmt::format("column {}", c + 1));
        while (!names.empty() && head.firstRow->fields[names.size() - 1].empty()) names.pop_back();
    } else {
        const auto read = namesIn(head.header.front(), file);
        if (!read) return failure(read);
        return fail(ErrorCode::ParseError,
                    "{}:{}: columns '{}'; a time column and channels were expected, as in time_s,voltage_v,current_a",
                    file, head.header.front().number, fmt::join(*read, ","));
    }
    CsvDraft draft = named != nullptr ? CsvDraft(*named, *last) : CsvDraft(*head.firstRow, *head.firstRow);
    if (named == nullptr) {
        draft.layout.dataOffset = head.firstRow->offset;
        draft.layout.dataLine = head.firstRow->number;
    }
    if (named != nullptr && named != head.header.data()) {
        draft.layout.warnings.push_back(fmt::format(
            "{}:{}: {} before the names of the columns passed over", file, head.header.front().number,
            named - head.header.data() == 1 ? "a line" : fmt::format("{} lines", named - head.header.data())));
    }
    draft.layout.times = RowTimes::Counted;
    for (std::size_t c = 0; c < names.size(); ++c) {
        auto column = columnNamed(names[c]);
        if (last != named && c < last->fields.size()) {
            if (const auto unit = unitField(last->fields[c])) {
                column.unit = unit->unit;
                column.factor = unit->factor;
                column.unknownUnit.clear();
            }
        }
        const bool chosen = !options.timeColumn.empty() && columnCalled(names, options.timeColumn) == c;
        if (draft.layout.times == RowTimes::Counted && isTimeColumn(column) && (options.timeColumn.empty() || chosen)) {
            draft.layout.times = RowTimes::Column;
            draft.layout.timeColumn = c;
            draft.layout.timeFactor = column.unit == "s" ? column.factor : 1;
        } else {
            draft.columns.push_back({column.name, c + 1, column.unit, column.factor, column.unknownUnit});
        }
    }
    draft.layout.names = std::move(names);
    // The number of a row is not a signal, unless the user asks for it.
    if (draft.layout.times == RowTimes::Column && draft.layout.timeColumn > 0 && options.columns.empty() &&
        !draft.columns.empty() && draft.columns.front().number == 1 &&
        isIndexColumn(columnNamed(draft.layout.names.front()))) {
        draft.layout.warnings.push_back(fmt::format("{}:{}: column '{}' counts the rows and was left out", file,
                                                    draft.layout.headerLine, draft.layout.names.front()));
        draft.columns.erase(draft.columns.begin());
    }
    return draft;
}

Result<CsvLayout> finished(CsvDraft draft, const ReadOptions& options, std::string_view file) {
    auto& layout = draft.layout;
    layout.width = layout.names.size();
    if (!options.timeColumn.empty()) {
        const auto column = columnCalled(layout.names, options.timeColumn);
        if (!column) {
            return fail(ErrorCode::InvalidArgument, "{}:{}: there is no time column '{}'; the columns are {}", file,
                        layout.headerLine, options.timeColumn, fmt::join(layout.names, ", "));
        }
        if (layout.times != RowTimes::Column || layout.timeColumn != *column) {
            const auto named = columnNamed(layout.names[*column]);
            layout.times = RowTimes::Column;
            layout.timeColumn = *column;
            layout.timeFactor = named.unit == "s" ? named.factor : 1;
            layout.interval_s.reset();
            std::erase_if(draft.columns, [&](const ChannelPlan& plan) { return plan.number == *column + 1; });
        }
    }
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        layout.givenRate_hz = *rate;
    }
    if (layout.times == RowTimes::Counted && !layout.interval_s && !layout.givenRate_hz) {
        return fail(ErrorCode::ParseError, "{}:{}: no column of times; one, or a sampling rate, was expected", file,
                    layout.headerLine);
    }
    auto planned = planChannels(std::move(draft.columns), options, file);
    if (!planned) return failure(planned);
    if (planned->empty()) {
        return fail(ErrorCode::ParseError, "{}:{}: no channel beside the time; at least one was expected", file,
                    layout.headerLine);
    }
    for (const auto& channel : *planned) {
        const auto& name = layout.names[channel.number - 1];
        if (!channel.unknownUnit.empty()) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: the unit of column '{}' is unknown; s, V or A with m, u, n or k were expected", file,
                        layout.headerLine, name);
        }
        // A second column of times is not a signal; it was the seconds that mattered.
        if (channel.unit == "s") {
            layout.warnings.push_back(
                fmt::format("{}:{}: column '{}' is a time and was left out", file, layout.headerLine, name));
        }
    }
    std::erase_if(*planned, [](const ChannelPlan& plan) { return plan.unit == "s"; });
    if (planned->empty()) {
        return fail(ErrorCode::ParseError, "{}:{}: only times; at least one channel was expected", file,
                    layout.headerLine);
    }
    layout.channels = std::move(*planned);
    return layout;
}

}  // namespace tacto
